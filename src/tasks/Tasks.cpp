#include "tasks/Tasks.h"

#include <algorithm>

#include "base/Names.h"

namespace heft {

namespace {
constexpr bool agree(const ActionSpec& a, const ActionSpec& b) {
  return a.kind != b.kind || (a.slot == b.slot && a.label == b.label && a.value == b.value);
}

constexpr bool columns_agree() {
  for (const TaskDeclaration* task : Tasks::declarations)
    for (const TaskDeclaration* other : Tasks::declarations)
      for (const ActionSpec& action : task->actions)
        for (const ActionSpec& same : other->actions)
          if (!agree(action, same)) return false;
  return true;
}
static_assert(columns_agree(), "two tasks use one action with different columns");

// Without duplicates, in order.
template <typename WordsOf>
std::vector<std::string_view> all_words(const WordsOf& words_of) {
  std::vector<std::string_view> all;
  for (const TaskDeclaration* task : Tasks::declarations)
    for (const std::string_view word : words_of(*task))
      if (std::ranges::find(all, word) == all.end()) all.push_back(word);
  return all;
}
}  // namespace

const TaskDeclaration* find_task(std::string_view name) {
  for (const TaskDeclaration* task : Tasks::declarations)
    if (task->name == name) return task;
  return nullptr;
}

const TaskDeclaration& task_named(std::string_view name) {
  if (const TaskDeclaration* task = find_task(name)) return *task;
  throw unknown_name("task", name, words_of<Task>());
}

template <>
std::vector<std::string_view> words_of<Task>() {
  return all_words([](const TaskDeclaration& task) { return std::array{task.name}; });
}
template <>
std::vector<std::string_view> words_of<ActionKind>() {
  return all_words([](const TaskDeclaration& task) {
    std::vector<std::string_view> kinds;
    for (const ActionSpec& action : task.actions) kinds.push_back(action.kind);
    return kinds;
  });
}
template <>
std::vector<std::string_view> words_of<Label>() {
  return all_words([](const TaskDeclaration& task) { return task.labels; });
}
template <>
std::vector<std::string_view> words_of<Outcome>() {
  return all_words([](const TaskDeclaration& task) { return task.outcomes; });
}

const ActionSpec* action_named(std::string_view kind) {
  for (const TaskDeclaration* task : Tasks::declarations)
    if (const ActionSpec* action = task->action(kind)) return action;
  return nullptr;
}

std::size_t task_index(std::string_view name) {
  const auto& all = Tasks::declarations;
  return static_cast<std::size_t>(std::ranges::find(all, name, &TaskDeclaration::name) -
                                  all.begin());
}

Answer simulated_answer(std::string_view task, const std::any& offer, const Percepts& percepts,
                        RandomStream& stream) {
  Answer answer;
  Tasks::call(task, [&]<typename Kind>() {
    answer = Kind::simulated(offer_of<Kind>(offer), percepts, stream);
  });
  return answer;
}

Answer blind_answer(std::string_view task, const std::any& offer, const WithoutPercepts& unseen,
                    RandomStream& stream) {
  Answer answer;
  Tasks::call(
      task, [&]<typename Kind>() { answer = Kind::blind(offer_of<Kind>(offer), unseen, stream); });
  return answer;
}

std::vector<ScreenState> fullest_screens(std::string_view task) {
  std::vector<ScreenState> screens;
  Tasks::call(task, [&]<typename Kind>() { screens = Kind::fullest_screens(); });
  return screens;
}

}  // namespace heft
