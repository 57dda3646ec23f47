// The experimenter's console: the state of a running session and the commands on it. The
// experimenter stays blind to mass, level, condition and correctness until they ask to be
// unblinded, which is logged.
#pragma once

#include <optional>
#include <string>

#include "experiment/ScreenState.h"
#include "experiment/TrialPlan.h"

namespace heft {

enum class ConsoleCommandKind {
  pause,  ///< pauses the session, with an open trial
  proceed,
  veto,         ///< voids the open trial, which will be presented again; text: reason
  veto_answer,  ///< voids the trial that was answered last; text: reason
  check,        ///< checks the apparatus again
  note,         ///< text
  rest,         ///< a break before the next trial
  end,          ///< leaves the session, which can be resumed
  unblind       ///< shows the open trial's plan from now on
};

struct ConsoleCommand {
  ConsoleCommandKind kind = ConsoleCommandKind::note;
  std::string text;
};

/// Tracking during a trial.
struct TrackingStatus {
  bool tracked = false;           ///< whether the effector was tracked in the last frame
  std::optional<double> quality;  ///< 0...1
  double frames_per_s = 0;        ///< 0: not known yet
};

struct ConsoleStatus {
  double session_s = 0;
  int n_completed = 0;                ///< trials
  std::optional<ScreenState> screen;  ///< the participant's screen; none: nothing
  bool paused = false;
  bool paused_itself = false;              ///< needs the experimenter
  std::string trouble;                     ///< of the camera or the board
  std::optional<TrackingStatus> tracking;  ///< none: no trial is open
  int n_dropped = 0, n_late = 0;           ///< pictures of this session
  std::optional<TrialPlan> plan;           ///< only once unblinded
};

class Console {
 public:
  virtual ~Console() = default;

  /// The experimenter's next command, if any. Returns immediately.
  virtual std::optional<ConsoleCommand> command() = 0;

  /// Called often; draws at its own rate.
  virtual void show(const ConsoleStatus& status) = 0;

  /// Asks whether to continue; the answer arrives as a command, proceed or end.
  /// @return false: there is no one to ask, and no answer will come
  virtual bool ask_to_continue(const std::string& question) = 0;

  /// Displays a message, such as why a command was refused.
  virtual void say(const std::string& text) = 0;
};

}  // namespace heft
