// Runs a session: asks the engine what comes next, the picture source for poses, the world for what
// they do, shows it, and takes the responder's actions back to the engine and the log. An answer is
// committed before the screen changes.
#pragma once

#include <atomic>
#include <functional>

#include "record/EventSink.h"
#include "responders/Responder.h"
#include "session/Engine.h"
#include "session/PictureSource.h"
#include "session/TrialWorld.h"
#include "view/ArView.h"

namespace heft {

/// Everything a session is run with.
struct SessionParts {
  Engine& engine;
  EventSink& sink;
  PictureSource& pictures;
  Responder& responder;
  ArView& view;
};

struct RunnerOptions {
  bool keep_frames = true;
  /// Called after every event, for a progress bar.
  std::function<void(const Engine&)> progress = [](const Engine&) {};
  /// Set from a signal handler to stop at the next picture; the session can be resumed.
  const std::atomic<bool>* stop = nullptr;
};

enum class RunEnd {
  finished,
  paused,  ///< three voids of one trial: somebody has to look
  stopped  ///< RunnerOptions::stop
};

class Runner {
 public:
  /// @param start_s session time to go on from
  Runner(const SessionParts& parts, const RunnerOptions& options, double start_s);

  /// Runs until the session ends, pauses or is stopped. On a finished session everything is saved.
  /// @throws Error from the log (nothing acknowledged is lost), or when the responder has nothing
  ///   more to do, or does what the screen does not offer, while a trial is open
  RunEnd run();

 private:
  void run_attempt(const TrialPlan& plan);
  bool run_picture(const TrialPlan& plan);
  bool wait_for_camera(const Picture& picture);
  void present(const ShownPicture& shown, const Picture& picture, int after_event);
  void take_actions(const ShownPicture& shown);
  void take_action(const Action& action);
  void stop_for(const std::string& why);
  void emit(Event event, Durability durability);
  void emit_now(EventKind kind, std::string detail = {}, std::optional<double> value = {});
  bool stopping() const { return options_.stop && options_.stop->load(); }

  SessionParts parts_;
  RunnerOptions options_;
  double now_s_;  // session time
  double attempt_start_s_ = 0;
  std::optional<TrialWorld> world_;
  std::optional<double> trouble_since_s_;
  std::optional<std::string> told_survivor_;
};

}  // namespace heft
