// The events of a session: the only input of the engine's fold, and the rows of the log's `event`
// table. Each kind is a type of its own that holds what it tells; record/EventRow.h says how it
// stands in the log.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <variant>

#include "experiment/Action.h"
#include "experiment/Check.h"
#include "experiment/SessionConfig.h"
#include "experiment/Task.h"

namespace heft {

// What the session's course depends on:

struct TrialStarted {
  bool operator==(const TrialStarted&) const = default;
};

struct TrialVoided {
  std::string reason;  ///< not empty; see void_interrupted
  bool operator==(const TrialVoided&) const = default;
};

struct SessionPaused {
  std::string reason;
  bool operator==(const SessionPaused&) const = default;
};

struct SessionContinued {
  bool operator==(const SessionContinued&) const = default;
};

struct CubesReset {
  std::optional<int> slot;  ///< of the cube that had left the area; none: all, by the button
  bool operator==(const CubesReset&) const = default;
};

struct DemonstrationShown {
  std::string block;
  bool operator==(const DemonstrationShown&) const = default;
};

struct SessionResumed {
  std::string utc;
  double away_s = 0;  ///< since the last event before
  bool operator==(const SessionResumed&) const = default;
};

enum class Ending { finished, aborted };
template <>
struct EnumNames<Ending> {
  static constexpr std::array<std::string_view, 2> names{"finished", "aborted"};
};
struct SessionEnded {
  Ending how = Ending::finished;
  bool operator==(const SessionEnded&) const = default;
};

// What only fills columns of the projected rows (SessionConfig too):

/// The first presented frame with all cubes on it.
struct CubesShown {
  bool operator==(const CubesShown&) const = default;
};

struct CubeTouch {
  int slot = 0;
  std::optional<double> ended_after_s{};  ///< none: it began
  /// Of an ended touch, over its frames; not told before version 4 of the log. How far the effector
  /// went from where it was in the first of them, and the clone's largest distance from it.
  std::optional<double> deepest_push_m{}, peak_lag_m{};
  bool operator==(const CubeTouch&) const = default;
};

/// The answer to the comparison that was answered last does not count: it is presented again, and
/// its procedure is as if it had not been asked.
struct AnswerVetoed {
  std::string reason;  ///< not empty
  bool operator==(const AnswerVetoed&) const = default;
};

struct EffectorLost {
  bool operator==(const EffectorLost&) const = default;
};

struct EffectorFound {
  bool operator==(const EffectorFound&) const = default;
};

// What is only kept:

struct Consent {
  bool agreed = false;
  std::string language, sha256;  ///< of the text
  bool operator==(const Consent&) const = default;
};

struct TextShown {
  std::string page, language, sha256;
  bool operator==(const TextShown&) const = default;
};

struct BreakTaken {
  std::string name;
  double duration_s = 0;
  bool operator==(const BreakTaken&) const = default;
};

struct Note {
  std::string text;
  bool operator==(const Note&) const = default;
};

struct Deviation {
  std::string text;
  bool operator==(const Deviation&) const = default;
};

struct Unblinding {
  std::string who;
  bool operator==(const Unblinding&) const = default;
};

/// How an attempt's pictures came along.
struct CameraReport {
  int n_shown = 0, n_dropped = 0, n_late = 0;
  bool operator==(const CameraReport&) const = default;
};

/// What a participant did that could not be taken: too early, or not offered. It changed nothing.
struct ActionRefused {
  Action action;
  std::string reason;
  bool operator==(const ActionRefused&) const = default;
};

using Happening =
    std::variant<TrialStarted, Action, TrialVoided, SessionPaused, SessionContinued, CubesReset,
                 DemonstrationShown, SessionResumed, SessionEnded, SessionConfig, CubesShown,
                 CubeTouch, EffectorLost, EffectorFound, Consent, TextShown, BreakTaken, Note,
                 Deviation, Unblinding, CameraReport, CheckResult, ActionRefused, AnswerVetoed>;

/// The names that the kinds have in the log, in the order of Happening.
enum class EventKind {
  trial_started,
  action,
  voided,
  paused,
  continued,
  cubes_reset,
  demonstration_shown,
  resumed,
  ended,
  setup,
  cubes_shown,
  cube_contact,
  effector_lost,
  effector_found,
  consent,
  text_shown,
  rest,
  note,
  deviation,
  unblinding,
  camera,
  check,
  refused,
  answer_vetoed
};
template <>
struct EnumNames<EventKind> {
  static constexpr std::array<std::string_view, std::variant_size_v<Happening>> names{
      "trial_started",
      "action",
      "void",
      "paused",
      "continued",
      "cubes_reset",
      "demonstration_shown",
      "resumed",
      "ended",
      "setup",
      "cubes_shown",
      "cube_contact",
      "effector_lost",
      "effector_found",
      "consent",
      "text_shown",
      "break",
      "note",
      "deviation",
      "unblinding",
      "camera",
      "check",
      "refused",
      "answer_vetoed"};
};

/// Why an attempt that a crash cut short is void; it is run again with the same draws.
inline constexpr std::string_view void_interrupted = "interrupted";

/// How the reason of a trial begins whose answer was vetoed.
inline constexpr std::string_view answer_vetoed = "answer vetoed: ";

/// A time as the log keeps it: to 2^-20 s, about a microsecond. Sums and differences of such times
/// are exact, so durations come out the same bit for bit wherever in a session they lie.
inline double log_time(double t_s) {
  return std::round(t_s * 0x1p20) * 0x1p-20;
}

struct Event {
  double t_s = 0;  ///< since session start, monotonic
  Happening what = Note{};

  EventKind kind() const { return static_cast<EventKind>(what.index()); }
  template <typename Kind>
  const Kind* as() const {
    return std::get_if<Kind>(&what);
  }

  bool operator==(const Event&) const = default;
};

}  // namespace heft
