#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>

#include "responders/Recording.h"
#include "responders/Responder.h"

namespace heft {

namespace {
// Labels recorded just before "validate" take a frame or two to be on the screen.
constexpr double waits_for_validate_s = 1;

bool offered(Task task, ActionKind kind) {
  switch (kind) {
    case ActionKind::select:
      return task != Task::sorting;
    case ActionKind::no_difference:
      return task == Task::comparison;
    case ActionKind::label:
    case ActionKind::unlabel:
    case ActionKind::validate:
    case ActionKind::dont_know:
      break;
  }
  return task == Task::sorting;
}

void check(const std::vector<RecordedAction>& actions, const TrialView& trial) {
  std::vector<Mistake> mistakes;
  for (const auto& [action, place] : actions) {
    if (!offered(trial.task, action.kind))
      mistakes.push_back({place, fmt::format("a {} trial has no action \"{}\"", name_of(trial.task),
                                             name_of(action.kind))});
    if (action.slot && *action.slot > trial.stage.n_slots())
      mistakes.push_back({place, fmt::format("slot {}, but trial {} has {} cubes", *action.slot,
                                             trial.trial_number, trial.stage.n_slots())});
  }
  if (!mistakes.empty()) throw InvalidFile(std::move(mistakes));
}

// What recorded actions come to; none: the trial is still open after them.
std::optional<Answer> answer_of(const std::vector<RecordedAction>& actions,
                                const TrialView& trial) {
  std::vector<std::optional<Label>> labels(trial.stage.slots_m.size());
  for (const auto& [action, place] : actions) {
    switch (action.kind) {
      case ActionKind::select:
        return Answer{.slot = action.slot, .labels = {}};
      case ActionKind::no_difference:
      case ActionKind::dont_know:
        return Answer{};
      case ActionKind::label:
        std::ranges::replace(labels, action.label, std::optional<Label>());
        [[fallthrough]];
      case ActionKind::unlabel:
        labels.at(static_cast<std::size_t>(action.slot.value() - 1)) = action.label;
        break;
      case ActionKind::validate:
        Answer sorted;
        for (const auto& label : labels)
          if (label) sorted.labels.push_back(*label);
        if (sorted.labels.size() == labels.size()) return sorted;
    }
  }
  return std::nullopt;
}

class Scripted : public Responder {
 public:
  explicit Scripted(Recording recording) : recording_(std::move(recording)) {}

  void begin_trial(const TrialView& trial) override {
    const auto trajectory = recording_.trajectories.find(trial.trial_number);
    if (trajectory == recording_.trajectories.end())
      throw Error(fmt::format("the recording {} has no trial {}: expected the file trial_{}.csv",
                              recording_.folder, trial.trial_number, trial.trial_number));
    trajectory_ = &trajectory->second;
    const auto& actions = recording_.actions[trial.trial_number];
    check(actions, trial);
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
    // A pause takes no taps; those that fell into it come after it.
    paused_ = screen.screen != Screen::trial;
    std::vector<TimedAction> actions;
    if (paused_) return actions;
    const double earliest_s = std::max(frame.t_s, screen.answers_from_s.value_or(frame.t_s));
    if (earliest_s >= frame.t_s + frame_interval_s_) return actions;
    while (!to_do_.empty() && to_do_.front().t_s < frame.t_s + frame_interval_s_) {
      if (to_do_.front().kind == ActionKind::validate && !screen.can_validate) break;
      actions.push_back(to_do_.front());
      actions.back().t_s = std::max(actions.back().t_s, earliest_s);
      to_do_.pop_front();
    }
    if (!actions.empty()) end_s_ = std::max(end_s_, actions.back().t_s);
    return actions;
  }

  bool has_more(double t_s) const override {
    return paused_ || t_s <= end_s_ + (to_do_.empty() ? 0 : waits_for_validate_s);
  }

  std::optional<Answer> judge(const TrialView& trial,
                              std::span<const DisplayedFrame>) const override {
    const auto actions = recording_.actions.find(trial.trial_number);
    if (actions == recording_.actions.end()) return std::nullopt;
    check(actions->second, trial);
    return answer_of(actions->second, trial);
  }

 private:
  Recording recording_;
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
