// One running attempt at a trial, folded from its events: answers as its task takes them, contacts,
// and where the time went. Knows nothing of blocks and staircases; that is the engine's.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/Event.h"
#include "experiment/Rows.h"
#include "experiment/ScreenState.h"
#include "tasks/TaskRun.h"

namespace heft {

/// The screen of a trial whose cubes are not there yet.
ScreenState screen_of(const TaskTrial& trial);

class RunningAttempt {
 public:
  /// @param row attempt and setup index and the start's time are taken from it
  /// @param require_contact refuse final answers until every cube was touched
  /// @param min_answer_s refuse all answers until the cubes were there for so long
  RunningAttempt(const TrialRow& row, std::unique_ptr<TaskTrial> trial, bool require_contact,
                 double min_answer_s = 0);

  const TrialPlan& plan() const { return trial_->plan(); }
  TrialRow row() const;
  const std::vector<CubeRow>& cubes() const { return cubes_; }
  ScreenState screen() const { return screen(cubes_shown_); }
  /// The same, with its cubes there or not.
  ScreenState screen(bool cubes_shown) const;

  /// Why an event of this attempt can't come now; events of other kinds always can.
  std::optional<std::string> refusal(const Event& event) const;

  /// Accounts for the time since the last event, which was spent paused, with the effector lost, or
  /// at the task. Call before folding each event.
  void account(double t_s, bool paused);

  void show(double t_s);
  void touch(const CubeTouch& contact, double t_s);
  void reset(const CubesReset& reset);
  void lose_effector() { effector_lost_ = true; }
  void find_effector() { effector_lost_ = false; }

  /// Whether an action that is not refused would end the trial.
  bool ends_trial(const Action& action) const { return trial_->ends(action); }

  /// Folds an action. Where the task puts new cubes in the slots, their contacts count from here.
  void act(const Action& action, double t_s);
  /// An action has ended the trial.
  bool has_ended() const { return trial_->result().outcome.has_value(); }

  void complete(double t_s);
  void make_void(const std::string& reason, double t_s);

 private:
  std::optional<std::string> action_refusal(const Action& action, double t_s) const;
  std::optional<std::string> contact_refusal(const CubeTouch& contact) const;
  std::optional<std::string> reset_refusal(const CubesReset& reset) const;
  bool has_cube(int slot) const { return slot >= 1 && slot <= plan().n_slots(); }
  bool all_touched() const;

  void rearrange();

  std::unique_ptr<TaskTrial> trial_;
  TrialRow row_;  // but for the plan and the result
  bool require_contact_;
  double min_answer_s_;
  double accounted_s_;
  bool cubes_shown_ = false;
  double answers_from_s_ = 0;  // session time, once the cubes are shown
  bool effector_lost_ = false;
  std::vector<CubeRow> cubes_;
  std::vector<std::optional<double>> contact_since_s_;  // by slot
  int n_choices_ = 0;
};

}  // namespace heft
