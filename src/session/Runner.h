// Runs a session: asks the engine for the next step and carries it out (pages, breaks, the
// demonstration, attempts).
#pragma once

#include "apparatus/sources/PictureSource.h"
#include "engine/Engine.h"
#include "record/stream/EventSink.h"
#include "responders/Responder.h"
#include "session/Console.h"
#include "session/Pages.h"
#include "session/SessionControl.h"
#include "view/ArView.h"

namespace heft {

/// Everything that a session runs with.
struct SessionParts {
  const Protocol& protocol;
  Engine& engine;
  EventSink& sink;
  PictureSource& pictures;
  Responder& responder;  ///< answers, unless a person does
  ArView& view;
  SessionClock& clock;
  bool has_screen = false;             ///< whether the view can be seen and touched
  const ScreenTexts* texts = nullptr;  ///< for the person who answers; null: the responder answers
  Apparatus apparatus = {};  ///< shown in the demonstration; without a board a plain table
  ResumeState before = {};   ///< of a resumed session
  bool left_hand = false;    ///< holds the effector in the demonstration
  const ScreenTexts* asked = nullptr;  ///< of questionnaires for the responder; null: none
  bool has_pictures = true;            ///< false: attempts are SurrogateAttempts
};

enum class RunEnd {
  finished,
  paused,   ///< three voids of one trial: needs the experimenter
  stopped,  ///< RunnerOptions::stop, the experimenter, or a closed window
  declined  ///< the person does not agree to take part
};

class Runner {
 public:
  Runner(const SessionParts& parts, const RunnerOptions& options);
  Runner(const Runner&) = delete;

  /// Runs until the session ends, pauses or is stopped. When it has ended, everything is saved.
  /// @throws Error from the log (nothing acknowledged is lost), or if the responder has no more
  ///   actions, or an action that the screen does not offer, while a trial is open
  RunEnd run();

 private:
  RunEnd run_blocks();
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
