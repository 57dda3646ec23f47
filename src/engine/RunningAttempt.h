// A running attempt at a trial, folded from its events: answers, contacts, and paused and lost
// time. Blocks and staircases belong to the engine.
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

/// The screen of a trial before its cubes are shown.
ScreenState screen_of(const TaskTrial& trial);

class RunningAttempt {
 public:
  /// @param row attempt index, setup index and start time
  /// @param require_contact refuse final answers before every cube was touched
  /// @param min_answer_s refuse answers earlier than this after the cubes' onset
  RunningAttempt(const TrialRow& row, std::unique_ptr<TaskTrial> trial, bool require_contact,
                 double min_answer_s = 0);

  const TrialPlan& plan() const { return trial_->plan(); }
  TrialRow row() const;
  const std::vector<CubeRow>& cubes() const { return cubes_; }
  ScreenState screen() const { return screen(cubes_shown_); }
  ScreenState screen(bool cubes_shown) const;

  /// Why an event of an attempt is refused; none: it is accepted.
  std::optional<std::string> refusal(const Event& event) const;

  /// Adds the time since the last event to paused or lost time, if it was either. Call it before
  /// folding each event.
  void account(double t_s, bool paused);

  void show(double t_s);
  void touch(const CubeTouch& contact, double t_s);
  void reset(const CubesReset& reset);
  void lose_effector() { effector_lost_ = true; }
  void find_effector() { effector_lost_ = false; }

  /// Whether an accepted action would end the trial.
  bool ends_trial(const Action& action) const { return trial_->ends(action); }

  /// Folds an action. If the task shuffles the cubes, their contact counts start again.
  void act(const Action& action, double t_s);
  bool has_ended() const { return trial_->result().outcome.has_value(); }
  std::optional<bool> answered_different() const { return trial_->answered_different(); }

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
  TrialRow row_;  // without plan and result
  bool require_contact_;
  double min_answer_s_;
  double accounted_s_;
  bool cubes_shown_ = false;
  double answers_from_s_ = 0;  // session time; set when the cubes are shown
  bool effector_lost_ = false;
  std::vector<CubeRow> cubes_;
  std::vector<std::optional<double>> contact_since_s_;  // by slot
  int n_choices_ = 0;
};

}  // namespace heft
