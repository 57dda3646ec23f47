#include "engine/RunningAttempt.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/Error.h"

namespace heft {

namespace {

// Which actions a task offers.
bool offers(Task task, ActionKind kind) {
  switch (task) {
    case Task::introduction:
      return kind == ActionKind::select;
    case Task::comparison:
      return kind == ActionKind::select || kind == ActionKind::no_difference;
    case Task::sorting:
      return kind != ActionKind::select && kind != ActionKind::no_difference;
  }
  return false;
}

bool needs_slot(ActionKind kind) {
  return kind == ActionKind::select || kind == ActionKind::label || kind == ActionKind::unlabel;
}

bool is_final(Task task, ActionKind kind) {
  return kind == ActionKind::validate || kind == ActionKind::dont_know ||
         kind == ActionKind::no_difference || (task != Task::sorting && kind == ActionKind::select);
}

std::vector<CubeRow> fresh_cubes(int attempt_index, const TrialPlan& plan) {
  std::vector<CubeRow> cubes;
  for (int slot = 1; slot <= plan.n_slots(); ++slot) {
    CubeRow cube;
    cube.attempt_index = attempt_index;
    cube.slot = slot;
    cube.mass_g = plan.masses_g[static_cast<std::size_t>(slot - 1)];
    cubes.push_back(cube);
  }
  return cubes;
}

}  // namespace

ActionKind action_of(const Event& event) {
  if (const auto kind = named<ActionKind>(event.detail)) return *kind;
  throw Error(fmt::format("\"{}\" is no action, expected {}", event.detail,
                          quoted_list(EnumNames<ActionKind>::names)));
}

RunningAttempt::RunningAttempt(int attempt_index, const TrialPlan& plan, double t_s,
                               bool require_contact)
    : require_contact_(require_contact),
      accounted_s_(t_s),
      cubes_(fresh_cubes(attempt_index, plan)),
      contact_since_s_(plan.masses_g.size()),
      labels_(plan.masses_g.size()) {
  row_.attempt_index = attempt_index;
  row_.plan = plan;
  row_.started_s = t_s;
}

ScreenState RunningAttempt::screen() const {
  ScreenState screen;
  screen.screen = Screen::trial;
  screen.task = plan().task;
  screen.n_slots = plan().n_slots();
  if (plan().task == Task::sorting) screen.labels = labels_;
  screen.can_answer = cubes_shown_ && (!require_contact_ || all_touched());
  screen.can_validate = plan().task == Task::sorting && all_labeled() && screen.can_answer;
  screen.try_again = n_wrong_ > 0;
  screen.n_choices = n_choices_;
  return screen;
}

std::optional<std::string> RunningAttempt::refusal(const Event& event) const {
  switch (event.kind) {
    case EventKind::action:
      return action_refusal(event);
    case EventKind::cube_contact:
      return contact_refusal(event);
    case EventKind::cubes_shown:
      if (cubes_shown_) return "the cubes are shown already";
      return std::nullopt;
    case EventKind::effector_lost:
      if (effector_lost_) return "the effector is out of view already";
      return std::nullopt;
    case EventKind::effector_found:
      if (!effector_lost_) return "the effector is in view already";
      return std::nullopt;
    case EventKind::cubes_reset:
      if (!cubes_shown_) return "the cubes have not appeared yet";
      if (event.slot && (*event.slot < 1 || *event.slot > plan().n_slots()))
        return fmt::format("there is no cube {}", *event.slot);
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

std::optional<std::string> RunningAttempt::action_refusal(const Event& event) const {
  const auto kind = named<ActionKind>(event.detail);
  if (!kind) return fmt::format("\"{}\" is no action", event.detail);
  if (!offers(plan().task, *kind))
    return fmt::format("a {} trial has no \"{}\"", name_of(plan().task), event.detail);
  if (!cubes_shown_) return "the cubes have not appeared yet";
  if (needs_slot(*kind) != event.slot.has_value())
    return needs_slot(*kind) ? "it names no cube" : "it takes no cube";
  if (event.slot && (*event.slot < 1 || *event.slot > plan().n_slots()))
    return fmt::format("there is no cube {}", *event.slot);
  if ((*kind == ActionKind::label) != event.label.has_value())
    return event.label ? "it takes no label" : "it names no label";
  if (*kind == ActionKind::unlabel && !labels_[static_cast<std::size_t>(*event.slot - 1)])
    return fmt::format("cube {} has no label", *event.slot);
  if (*kind == ActionKind::validate && !all_labeled()) return "not all cubes have a label yet";
  if (is_final(plan().task, *kind) && require_contact_ && !all_touched())
    return "not every cube was touched yet";
  return std::nullopt;
}

std::optional<std::string> RunningAttempt::contact_refusal(const Event& event) const {
  if (!cubes_shown_) return "the cubes have not appeared yet";
  if (!event.slot || *event.slot < 1 || *event.slot > plan().n_slots())
    return "it names no cube of this trial";
  const bool touching = contact_since_s_[static_cast<std::size_t>(*event.slot - 1)].has_value();
  if (event.detail == "began") {
    if (touching) return fmt::format("cube {} is touched already", *event.slot);
    return std::nullopt;
  }
  if (event.detail != "ended")
    return fmt::format("\"{}\" is neither \"began\" nor \"ended\"", event.detail);
  if (!touching) return fmt::format("cube {} is not touched", *event.slot);
  if (!event.value || !(*event.value >= 0)) return "it has no duration";
  return std::nullopt;
}

void RunningAttempt::account(double t_s, bool paused) {
  const double elapsed_s = t_s - accounted_s_;
  accounted_s_ = t_s;
  if (!row_.shown_s || row_.validated_s) return;
  if (paused)
    row_.paused_s += elapsed_s;
  else if (effector_lost_)
    row_.lost_s += elapsed_s;
}

void RunningAttempt::show(const Event& event) {
  cubes_shown_ = true;
  if (!row_.shown_s) row_.shown_s = event.t_s;  // newly shuffled cubes appear a second time
}

void RunningAttempt::touch(const Event& event) {
  const auto index = static_cast<std::size_t>(event.slot.value() - 1);
  CubeRow& cube = cubes_[index];
  if (event.detail == "began") {
    contact_since_s_[index] = event.t_s;
    ++cube.n_pushes;
    if (!cube.first_contact_s) cube.first_contact_s = event.t_s;
    if (!row_.first_contact_s) row_.first_contact_s = event.t_s;
    cube.last_contact_s = event.t_s;
  } else {
    cube.contact_s += event.value.value();
    cube.last_contact_s = *contact_since_s_[index] + *event.value;
    contact_since_s_[index].reset();
  }
}

bool RunningAttempt::ends_trial(const Event& action) const {
  return is_final(plan().task, action_of(action)) &&
         (plan().task != Task::introduction || is_heaviest(action.slot.value()));
}

std::optional<Outcome> RunningAttempt::act(const Event& event) {
  const ActionKind kind = action_of(event);
  const auto slot_label = [&]() -> std::optional<Label>& {
    return labels_[static_cast<std::size_t>(event.slot.value() - 1)];
  };
  if (!row_.first_choice_s) row_.first_choice_s = event.t_s;
  if (ends_trial(event)) row_.validated_s = event.t_s;
  if (needs_slot(kind)) ++n_choices_;
  switch (kind) {
    case ActionKind::label:
      // A label belongs to one cube: giving a used one moves it.
      std::ranges::replace(labels_, event.label, std::optional<Label>());
      slot_label() = event.label;
      return std::nullopt;
    case ActionKind::unlabel:
      slot_label().reset();
      return std::nullopt;
    case ActionKind::validate:
      return labels_are_right() ? Outcome::correct : Outcome::incorrect;
    case ActionKind::dont_know:
      return Outcome::dont_know;
    case ActionKind::no_difference:
      return Outcome::no_difference;
    case ActionKind::select:
      return choose(*event.slot);
  }
  return std::nullopt;
}

std::optional<Outcome> RunningAttempt::choose(int slot) {
  const bool heaviest = is_heaviest(slot);
  if (plan().task == Task::introduction && !heaviest) {
    ++n_wrong_;
    return std::nullopt;
  }
  row_.chosen_slot = slot;
  const bool one_is_heavier = std::ranges::min(plan().masses_g) < std::ranges::max(plan().masses_g);
  if (one_is_heavier) row_.choice_correct = heaviest;
  return plan().task == Task::introduction ? Outcome::correct : Outcome::difference;
}

void RunningAttempt::rearrange(const TrialPlan& plan) {
  row_.plan = plan;
  cubes_shown_ = false;
  cubes_ = fresh_cubes(row_.attempt_index, plan);
  std::ranges::fill(contact_since_s_, std::nullopt);
}

void RunningAttempt::close(const Event& event, TrialStatus status) {
  row_.status = status;
  row_.ended_s = event.t_s;
  if (status == TrialStatus::voided) row_.void_reason = event.detail;
}

bool RunningAttempt::is_heaviest(int slot) const {
  return plan().masses_g[static_cast<std::size_t>(slot - 1)] == std::ranges::max(plan().masses_g);
}

bool RunningAttempt::all_touched() const {
  return std::ranges::all_of(cubes_, [](const CubeRow& cube) { return cube.n_pushes > 0; });
}

bool RunningAttempt::all_labeled() const {
  return std::ranges::all_of(labels_, [](const auto& label) { return label.has_value(); });
}

bool RunningAttempt::labels_are_right() const {
  std::vector<double> sorted = plan().masses_g;
  std::ranges::sort(sorted);
  for (std::size_t i = 0; i < labels_.size(); ++i)
    if (plan().masses_g[i] != sorted.at(static_cast<std::size_t>(labels_[i].value()))) return false;
  return true;
}

}  // namespace heft
