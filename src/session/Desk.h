// The experimenter's place: what they see of a running session, and what they can do to it. It
// keeps them blind: no mass, level, condition or correctness unless they unblind themselves, which
// is logged.
#pragma once

#include <optional>
#include <string>

#include "experiment/ScreenState.h"
#include "experiment/TrialPlan.h"

namespace heft {

enum class DeskCommandKind {
  pause,  ///< the session stands still, an open trial too
  go_on,
  veto,    ///< the open trial is void and will be presented again; text: why
  note,    ///< text
  rest,    ///< a break before the next trial
  end,     ///< leave the session so that it can be resumed
  unblind  ///< show the open trial's plan from now on
};

struct DeskCommand {
  DeskCommandKind kind = DeskCommandKind::note;
  std::string text;
};

struct DeskStatus {
  double session_s = 0;
  int n_completed = 0;  ///< trials
  ScreenState screen;   ///< what the participant has in front of them
  bool paused = false;
  bool tracked = false;           ///< the effector, in the last picture
  std::string trouble;            ///< with the camera or the board
  std::optional<double> quality;  ///< of tracking, 0...1
  double pictures_per_s = 0;
  int n_dropped = 0, n_late = 0;  ///< pictures, in this session
  std::optional<TrialPlan> plan;  ///< only once unblinded
};

class Desk {
 public:
  virtual ~Desk() = default;

  /// What the experimenter wants, if anything. Returns at once.
  virtual std::optional<DeskCommand> command() = 0;

  /// Called often; draw when it suits.
  virtual void show(const DeskStatus& status) = 0;

  /// Something to tell them: why a command was not taken.
  virtual void say(const std::string& text) = 0;
};

}  // namespace heft
