// One attempt at a trial, from start to end: poses, physics, displayed frames and the participant's
// actions.
#pragma once

#include "apparatus/TrialWorld.h"
#include "session/Runner.h"
#include "session/SessionControl.h"

namespace heft {

/// What the responder may know of the open trial.
TrialView trial_view(const SessionParts& parts, const TrialPlan& plan);

class AttemptRun {
 public:
  AttemptRun(const SessionParts& parts, const RunnerOptions& options, Journal& journal,
             SessionControl& control, ParticipantScreen& screen);

  /// Returns when the attempt has ended, the session pauses, or it is to be left. An open attempt
  /// of a session that is left becomes void ("interrupted").
  /// @throws Error as Runner::run
  void run(const TrialPlan& plan);

  /// The last displayed frame.
  const ViewFrame& shown() const { return shown_; }

 private:
  const Engine& engine() const { return parts_.engine; }
  bool trial_continues() const;
  bool has_ended() const;

  bool run_picture();
  std::optional<Picture> next_picture();
  void listen();
  bool wait_until(double t_s);
  void require_sight(const FrameRow& row);
  bool wait_for_camera(const Picture& picture);
  void show(const ShownFrame& shown, const Picture& picture, FrameRow& row);
  void log_events(const std::vector<Event>& events);
  void count_frame(const Picture& picture, const FrameRow& row);
  void report_pictures();

  void take_touches(const std::vector<Touch>& touches);
  bool take_touch(const Touch& touch);
  void put_cubes_back();
  void take_actions(const ShownFrame& shown);
  [[noreturn]] void refuse_model(const TimedAction& action, const std::string& why);
  std::string answer(const Action& action, double t_s);

  const SessionParts& parts_;
  const RunnerOptions& options_;
  Journal& journal_;
  SessionControl& control_;
  ParticipantScreen& screen_;

  double start_s_ = 0;  // session time
  std::optional<TrialWorld> world_;
  double seen_s_ = 0;  // when the effector was last seen
  std::optional<double> trouble_since_s_;
  ViewFrame shown_;
  std::optional<double> presented_s_;  // session time of the last frame
  int n_continued_ = 0;                // Journal::n_continued when pictures were last awaited
  int n_shown_ = 0, n_dropped_ = 0, n_late_ = 0, n_doubled_ = 0;
};

}  // namespace heft
