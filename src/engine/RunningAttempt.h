// One running attempt at a trial, folded from its events: labels and choices as the screen shows
// them, contacts, and where the time went. Knows nothing of blocks and staircases; that is the
// engine's.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/Event.h"
#include "experiment/Rows.h"
#include "experiment/ScreenState.h"

namespace heft {

class RunningAttempt {
 public:
  /// @param require_contact refuse final answers until every cube was touched
  RunningAttempt(int attempt_index, const TrialPlan& plan, double t_s, bool require_contact);

  const TrialPlan& plan() const { return row_.plan; }
  const TrialRow& row() const { return row_; }
  const std::vector<CubeRow>& cubes() const { return cubes_; }
  const CubeRow& cube(int slot) const { return cubes_.at(static_cast<std::size_t>(slot - 1)); }
  ScreenState screen() const;

  /// Why an event of this attempt (action, cubes_shown, cube_contact, effector_lost...) can't come
  /// now.
  std::optional<std::string> refusal(const Event& event) const;

  /// Accounts for the time since the last event, which was spent paused, with the effector lost, or
  /// at the task. Call before folding each event.
  void account(double t_s, bool paused);

  void show(const Event& event);
  void touch(const Event& event);
  void lose_effector() { effector_lost_ = true; }
  void find_effector() { effector_lost_ = false; }

  /// Whether an action that is not refused would end the trial.
  bool ends_trial(const Event& action) const;

  /// Folds an action. @return the outcome where it ends the trial
  std::optional<Outcome> act(const Event& event);

  /// New cubes in the slots after a wrong introduction answer; their contacts count from here.
  void rearrange(const TrialPlan& plan);

  void close(const Event& event, TrialStatus status);

  int n_wrong() const { return n_wrong_; }

 private:
  std::optional<std::string> action_refusal(const Event& event) const;
  std::optional<std::string> contact_refusal(const Event& event) const;
  bool all_touched() const;
  bool all_labeled() const;
  bool labels_are_right() const;
  bool is_heaviest(int slot) const;
  std::optional<Outcome> choose(int slot);

  TrialRow row_;
  bool require_contact_;
  double accounted_s_;
  bool cubes_shown_ = false;
  bool effector_lost_ = false;
  std::vector<CubeRow> cubes_;
  std::vector<std::optional<double>> contact_since_s_;  // by slot
  std::vector<std::optional<Label>> labels_;            // by slot
  int n_wrong_ = 0, n_choices_ = 0;
};

/// The action that an event of kind `action` stands for.
/// @throws Error when its detail is no action
ActionKind action_of(const Event& event);

}  // namespace heft
