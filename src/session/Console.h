// The experimenter's console: what they see of a running session, and what they can do to it. It
// keeps them blind: no mass, level, condition or correctness unless they unblind themselves, which
// is logged.
#pragma once

#include <optional>
#include <string>

#include "experiment/ScreenState.h"
#include "experiment/TrialPlan.h"

namespace heft {

enum class ConsoleCommandKind {
  pause,  ///< the session stands still, an open trial too
  go_on,
  veto,         ///< the open trial is void and will be presented again; text: why
  veto_answer,  ///< the same of the trial that was answered last; text: why
  check,        ///< look at the apparatus once more
  note,         ///< text
  rest,         ///< a break before the next trial
  end,          ///< leave the session so that it can be resumed
  unblind       ///< show the open trial's plan from now on
};

struct ConsoleCommand {
  ConsoleCommandKind kind = ConsoleCommandKind::note;
  std::string text;
};

/// How the frames of a trial come along.
struct TrackingStatus {
  bool tracked = false;           ///< the effector, in the last frame
  std::optional<double> quality;  ///< 0...1
  double frames_per_s = 0;        ///< 0: not known yet
};

struct ConsoleStatus {
  double session_s = 0;
  int n_completed = 0;                ///< trials
  std::optional<ScreenState> screen;  ///< what the participant has before them; none: nothing
  bool paused = false;
  bool paused_itself = false;              ///< somebody has to look
  std::string trouble;                     ///< with the camera or the board
  std::optional<TrackingStatus> tracking;  ///< none: no trial is on the screen
  int n_dropped = 0, n_late = 0;           ///< pictures, in this session
  std::optional<TrialPlan> plan;           ///< only once unblinded
};

class Console {
 public:
  virtual ~Console() = default;

  /// What the experimenter wants, if anything. Returns at once.
  virtual std::optional<ConsoleCommand> command() = 0;

  /// Called often; draw when it suits.
  virtual void show(const ConsoleStatus& status) = 0;

  /// Asks whether to go on; the answer comes as a command, go_on or end.
  /// @return false: nobody can be asked, and no answer will come
  virtual bool ask_to_go_on(const std::string& question) = 0;

  /// Something to tell them: why a command was not taken.
  virtual void say(const std::string& text) = 0;
};

}  // namespace heft
