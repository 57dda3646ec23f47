#include "engine/tasks/Introduction.h"

#include <array>

#include "engine/tasks/TaskRules.h"

namespace heft {

namespace {
constexpr std::array offered{ActionKind::select};

bool ends_trial(const TaskState& state, const Action& action) {
  return is_heaviest(state.plan, action.slot.value());
}

std::optional<Outcome> act(TaskState& state, const Action& action) {
  if (!ends_trial(state, action)) {
    ++state.n_wrong;
    return std::nullopt;
  }
  choose(state, *action.slot);
  return Outcome::correct;
}
}  // namespace

const TaskRules introduction_rules{
    Task::introduction,
    offered,
    [](const TaskState&, const Action&) -> std::optional<std::string> { return std::nullopt; },
    ends_trial,
    act,
    [](const TaskState& state, ScreenState& screen) { screen.try_again = state.n_wrong > 0; }};

TrialPlan IntroductionRun::arranged(const TrialKey& key, int n_shuffles) const {
  TrialPlan plan = key.plan(block_.name, Task::introduction, block_.condition);
  plan.masses_g = block_.masses_g;
  plan.n_reshuffles = n_shuffles;
  RandomStream stream = key.slots();
  for (int i = 0; i <= n_shuffles; ++i) stream.shuffle(std::span(plan.masses_g));
  return plan;
}

std::optional<TrialPlan> IntroductionRun::rearranged(const TrialKey& key, int n_wrong) const {
  if (block_.wrong_answer != WrongAnswer::reshuffle) return std::nullopt;
  return arranged(key, n_wrong);
}

}  // namespace heft
