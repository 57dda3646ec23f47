// Runs a session: asks the engine what comes next and lets it happen: pages for people, breaks, the
// demonstration, one attempt after the other.
#pragma once

#include <atomic>
#include <functional>

#include "apparatus/PictureSource.h"
#include "engine/Engine.h"
#include "record/EventSink.h"
#include "responders/Responder.h"
#include "session/Console.h"
#include "session/Pages.h"
#include "view/ArView.h"

namespace heft {

class EventOutlet;

/// What a session is run with.
struct SessionParts {
  const Protocol& protocol;
  Engine& engine;
  EventSink& sink;
  PictureSource& pictures;
  Responder& responder;  ///< its mind answers, unless a person does
  ArView& view;
  SessionClock& clock;
  bool has_screen = false;             ///< the view can be looked at and touched
  const ScreenTexts* texts = nullptr;  ///< of the person who answers; null: the responder answers
  Apparatus apparatus = {};  ///< what the demonstration shows; without a board a plain table
  GoneThrough before = {};   ///< of a session that goes on
  bool left_hand = false;    ///< holds the effector in it
  const ScreenTexts* asked =
      nullptr;  ///< of questionnaires that the responder is asked; null: none
};

struct RunnerOptions {
  bool keep_frames = true;
  /// Called after every event, for a progress bar.
  std::function<void(const Engine&)> progress = [](const Engine&) {};
  /// Set from a signal handler to stop at the next picture; the session can be resumed.
  const std::atomic<bool>* stop = nullptr;
  /// What is to be said where there is no console.
  std::function<void(const std::string&)> tell = [](const std::string&) {};
  Console* console = nullptr;  ///< the experimenter's; only on a wall clock
  /// Other recorders, told of each event that is on disk; null: there are none.
  EventOutlet* events = nullptr;
  /// Where the session's number is put once it is in the log; null: nobody asks.
  std::int64_t* begun = nullptr;
  /// Go on although the check failed, where nobody can be asked.
  bool go_on_unchecked = false;
};

enum class RunEnd {
  finished,
  paused,   ///< three voids of one trial: somebody has to look
  stopped,  ///< RunnerOptions::stop, the experimenter, or a closed window
  declined  ///< the person does not want to take part
};

class Runner {
 public:
  Runner(const SessionParts& parts, const RunnerOptions& options);
  Runner(const Runner&) = delete;

  /// Runs until the session ends, pauses or is stopped. On a finished session everything is saved.
  /// @throws Error from the log (nothing acknowledged is lost), or when the responder has nothing
  ///   more to do, or does what the screen does not offer, while a trial is open
  RunEnd run();

 private:
  RunEnd run_blocks();
  bool wait_for_log(double waited_s);
  bool begin();
  void check_apparatus();
  std::string failed_checks();
  SessionControl::Answer ask_whether_failures_matter();
  [[noreturn]] void refuse_unchecked(const std::string& failed);
  std::string block_to_come() const;
  std::optional<RunEnd> finish();
  void take_break(const std::string& name, double least_s);
  void show_demonstration(const DemonstrationBlock& block);
  void run_trial(const TrialPlan& plan);
  void fade_out();
  bool is_looked_at() const { return parts_.has_screen || pages_.has_reader(); }

  SessionParts parts_;
  RunnerOptions options_;
  Journal journal_;
  ParticipantScreen screen_;
  SessionControl control_;
  Pages pages_;
  ViewFrame last_shown_;  // of a trial
  std::optional<std::string> noted_last_staircase_;
};

}  // namespace heft
