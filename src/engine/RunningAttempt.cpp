#include "engine/RunningAttempt.h"

#include <fmt/format.h>

#include <algorithm>

namespace heft {

namespace {

using Refusal = std::optional<std::string>;

// Whether an action has exactly the columns of its kind.
Refusal column_refusal(const ActionSpec& spec, const Action& action) {
  if (spec.slot != action.slot.has_value())
    return action.slot ? "it has a cube, expected none" : "it has no cube";
  if (spec.label != action.label.has_value())
    return action.label ? "it has a label, expected none" : "it has no label";
  if (spec.value != action.value.has_value())
    return action.value ? "it has a value, expected none" : "it has no value";
  return std::nullopt;
}

}  // namespace

ScreenState screen_of(const TaskTrial& trial) {
  const TrialPlan& plan = trial.plan();
  ScreenState screen;
  screen.screen = Screen::trial;
  screen.task = plan.task;
  screen.n_slots = plan.n_slots();
  screen.trial_number = plan.trial_number;
  screen.attempt = plan.attempt;
  screen.n_reshuffles = plan.n_reshuffles;
  screen.can_answer = false;
  trial.show(screen);
  return screen;
}

RunningAttempt::RunningAttempt(const TrialRow& row, std::unique_ptr<TaskTrial> trial,
                               bool require_contact, double min_answer_s)
    : trial_(std::move(trial)),
      row_(row),
      require_contact_(require_contact),
      min_answer_s_(min_answer_s),
      accounted_s_(row.started_s),
      cubes_(fresh_cubes(row.attempt_index, plan())),
      contact_since_s_(plan().masses_g.size()) {}

TrialRow RunningAttempt::row() const {
  TrialRow row = row_;
  row.plan = plan();
  static_cast<TrialResult&>(row) = trial_->result();
  return row;
}

ScreenState RunningAttempt::screen(bool cubes_shown) const {
  ScreenState screen = screen_of(*trial_);
  screen.touch_first = require_contact_ && !all_touched();
  screen.can_answer = cubes_shown && !screen.touch_first;
  if (cubes_shown_ && min_answer_s_ > 0) screen.answers_from_s = answers_from_s_ - row_.started_s;
  screen.n_choices = n_choices_;
  trial_->show(screen);
  return screen;
}

Refusal RunningAttempt::refusal(const Event& event) const {
  if (const auto* action = event.as<Action>()) return action_refusal(*action, event.t_s);
  if (const auto* contact = event.as<CubeTouch>()) return contact_refusal(*contact);
  if (const auto* reset = event.as<CubesReset>()) return reset_refusal(*reset);
  if (event.as<CubesShown>() && cubes_shown_) return "the cubes are already shown";
  if (event.as<EffectorLost>() && effector_lost_) return "the effector is already out of view";
  if (event.as<EffectorFound>() && !effector_lost_) return "the effector is already in view";
  return std::nullopt;
}

Refusal RunningAttempt::action_refusal(const Action& action, double t_s) const {
  const ActionSpec* spec = trial_->declaration().action(action.kind);
  if (!spec) return fmt::format("a {} trial has no action \"{}\"", plan().task, action.kind);
  if (!cubes_shown_) return "the cubes are not shown yet";
  if (t_s < answers_from_s_)
    return fmt::format("it is earlier than {:g} s after the cubes' onset", min_answer_s_);
  if (Refusal refusal = column_refusal(*spec, action)) return refusal;
  if (action.slot && !has_cube(*action.slot))
    return fmt::format("there is no cube {}", *action.slot);
  if (Refusal refusal = trial_->refusal(action)) return refusal;
  if (!spec->is_step && require_contact_ && !all_touched()) return "not every cube was touched";
  return std::nullopt;
}

Refusal RunningAttempt::contact_refusal(const CubeTouch& contact) const {
  if (!cubes_shown_) return "the cubes are not shown yet";
  if (!has_cube(contact.slot)) return "the trial has no such cube";
  const bool touching = contact_since_s_[static_cast<std::size_t>(contact.slot - 1)].has_value();
  if (!contact.ended_after_s && touching)
    return fmt::format("cube {} is already touched", contact.slot);
  if (contact.ended_after_s && !touching)
    return fmt::format("cube {} is not touched", contact.slot);
  if (contact.ended_after_s && !(*contact.ended_after_s >= 0)) return "it has no duration";
  return std::nullopt;
}

Refusal RunningAttempt::reset_refusal(const CubesReset& reset) const {
  if (!cubes_shown_) return "the cubes are not shown yet";
  if (reset.slot && !has_cube(*reset.slot)) return fmt::format("there is no cube {}", *reset.slot);
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

void RunningAttempt::show(double t_s) {
  cubes_shown_ = true;
  if (min_answer_s_ > 0) answers_from_s_ = log_time(t_s + min_answer_s_);
  if (!row_.shown_s) row_.shown_s = t_s;  // shuffled cubes appear a second time
}

void RunningAttempt::touch(const CubeTouch& contact, double t_s) {
  const auto index = static_cast<std::size_t>(contact.slot - 1);
  CubeRow& cube = cubes_[index];
  if (contact.ended_after_s) {
    cube.contact_s += *contact.ended_after_s;
    cube.last_contact_s = *contact_since_s_[index] + *contact.ended_after_s;
    // An empty optional is less than any value.
    cube.max_push_displacement_m =
        std::max(cube.max_push_displacement_m, contact.max_push_displacement_m);
    cube.peak_lag_m = std::max(cube.peak_lag_m, contact.peak_lag_m);
    contact_since_s_[index].reset();
    return;
  }
  contact_since_s_[index] = t_s;
  ++cube.n_pushes;
  if (!cube.first_contact_s) cube.first_contact_s = t_s;
  if (!row_.first_contact_s) row_.first_contact_s = t_s;
  cube.last_contact_s = t_s;
}

void RunningAttempt::reset(const CubesReset& reset) {
  for (CubeRow& cube : cubes_)
    if (!reset.slot || *reset.slot == cube.slot) ++cube.n_resets;
}

void RunningAttempt::act(const Action& action, double t_s) {
  if (!row_.first_choice_s) row_.first_choice_s = t_s;
  if (ends_trial(action)) row_.validated_s = t_s;
  if (action.slot) ++n_choices_;
  const int n_reshuffles = plan().n_reshuffles;
  trial_->take(action);
  if (plan().n_reshuffles != n_reshuffles) rearrange();
}

void RunningAttempt::rearrange() {
  std::vector<CubeRow> fresh = fresh_cubes(row_.attempt_index, plan());
  for (std::size_t i = 0; i < fresh.size(); ++i) fresh[i].n_resets = cubes_[i].n_resets;
  cubes_ = std::move(fresh);
  contact_since_s_.assign(cubes_.size(), std::nullopt);
  cubes_shown_ = false;
}

void RunningAttempt::complete(double t_s) {
  row_.status = TrialStatus::completed;
  row_.ended_s = t_s;
}

void RunningAttempt::make_void(const std::string& reason, double t_s) {
  row_.status = TrialStatus::voided;
  row_.void_reason = reason;
  row_.ended_s = t_s;
}

bool RunningAttempt::all_touched() const {
  return std::ranges::all_of(cubes_, [](const CubeRow& cube) { return cube.n_pushes > 0; });
}

}  // namespace heft
