#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>

#include "responders/Recording.h"
#include "responders/Responder.h"
#include "tasks/Task.h"

namespace heft {

namespace {
// Steps recorded just before the completing one take a frame or two to be displayed.
constexpr double waits_for_steps_s = 1;

void check(const std::vector<RecordedAction>& actions, const TrialView& trial) {
  const TaskDeclaration& task = task_named(trial.task);
  std::vector<Mistake> mistakes;
  for (const auto& [action, place] : actions) {
    if (!task.action(action.kind))
      mistakes.push_back(
          {place, fmt::format("a {} trial has no action \"{}\"", trial.task, action.kind)});
    if (action.slot && *action.slot > trial.stage.n_slots())
      mistakes.push_back({place, fmt::format("slot {}, but trial {} has {} cubes", *action.slot,
                                             trial.trial_number, trial.stage.n_slots())});
  }
  if (!mistakes.empty()) throw InvalidFile(std::move(mistakes));
}

class Scripted : public Responder {
 public:
  explicit Scripted(Recording recording) : recording_(std::move(recording)) {}

  void begin_trial(const TrialView& trial) override {
    const auto trajectory = recording_.trajectories.find(trial.trial_number);
    if (trajectory == recording_.trajectories.end())
      throw Error(fmt::format("the recording {} lacks trial {}: expected the file trial_{}.csv",
                              recording_.folder, trial.trial_number, trial.trial_number));
    trajectory_ = &trajectory->second;
    const auto& actions = recording_.actions[trial.trial_number];
    check(actions, trial);
    task_ = &task_named(trial.task);
    to_do_.clear();
    for (const RecordedAction& recorded : actions) to_do_.push_back(recorded.action);
    end_s_ = trajectory_->end_s();
    if (!to_do_.empty()) end_s_ = std::max(end_s_, to_do_.back().t_s);
    frame_interval_s_ = 1 / trial.stage.display_rate_hz;
    last_pose_ = trajectory_->rows().front().pose.value_or(Pose{});
  }

  HandSample hand(double t_s) override {
    const auto pose = trajectory_->at(t_s);
    if (pose) last_pose_ = *pose;
    return {last_pose_, pose.has_value()};
  }

  std::vector<TimedAction> see(const DisplayedFrame& frame, const ScreenState& screen) override {
    // Taps are postponed during a pause.
    paused_ = screen.screen != Screen::trial;
    std::vector<TimedAction> actions;
    if (paused_) return actions;
    const double earliest_s = std::max(frame.t_s, screen.answers_from_s.value_or(frame.t_s));
    if (earliest_s >= frame.t_s + frame_interval_s_) return actions;
    while (!to_do_.empty() && to_do_.front().t_s < frame.t_s + frame_interval_s_) {
      if (needs_steps(to_do_.front()) && !screen.can_validate) break;
      actions.push_back(to_do_.front());
      actions.back().t_s = std::max(actions.back().t_s, earliest_s);
      to_do_.pop_front();
    }
    if (!actions.empty()) end_s_ = std::max(end_s_, actions.back().t_s);
    return actions;
  }

  bool has_more(double t_s) const override {
    return paused_ || t_s <= end_s_ + (to_do_.empty() ? 0 : waits_for_steps_s);
  }

  std::optional<Answer> judge(const TrialView& trial, std::span<const DisplayedFrame>,
                              std::span<const int>) const override {
    const auto actions = recording_.actions.find(trial.trial_number);
    if (actions == recording_.actions.end()) return std::nullopt;
    check(actions->second, trial);
    const TaskDeclaration& task = task_named(trial.task);
    Answer answer;
    for (const RecordedAction& recorded : actions->second) {
      answer.actions.push_back(recorded.action);
      if (!task.action(recorded.action.kind)->is_step) return answer;
    }
    return std::nullopt;  // the trial is still open after them
  }

 private:
  bool needs_steps(const Action& action) const { return task_->action(action.kind)->after_steps; }

  Recording recording_;
  const TaskDeclaration* task_ = nullptr;
  const Trajectory* trajectory_ = nullptr;
  std::deque<TimedAction> to_do_;
  Pose last_pose_;
  double end_s_ = 0;
  double frame_interval_s_ = 0;
  bool paused_ = false;
};
}  // namespace

std::unique_ptr<Responder> make_scripted(const ResponderOptions& options) {
  return std::make_unique<Scripted>(load_recording(options.folder));
}

}  // namespace heft
