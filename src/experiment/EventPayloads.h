// Payloads of a session's events. Each declares its name in the log and its role (event_type) and,
// unless it is empty, the columns of the `event` row that it fills (event_columns).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "base/Names.h"
#include "experiment/TrialPlan.h"

namespace heft {

/// When the engine accepts an event, and what it does with it.
enum class EventRole {
  course,   ///< determines what comes next; refused when it is not due or the session has ended
  attempt,  ///< belongs to the open attempt; refused without one and while the session is paused
  setting,  ///< folded, accepted at any time
  recorded  ///< recorded only, accepted at any time
};

struct EventType {
  std::string_view name;  ///< in the log
  EventRole role = EventRole::recorded;
};

template <typename Payload>
concept Recorded = Payload::event_type.role == EventRole::recorded;

/// An answer, or a step of one. A task's declaration (src/tasks) lists its kinds of action and the
/// columns that each fills.
struct Action {
  static constexpr EventType event_type{"action", EventRole::attempt};
  ActionKind kind{};
  std::optional<int> slot{};  ///< of a cube; 1 is leftmost
  std::optional<Label> label{};
  std::optional<double> value{};

  static void event_columns(auto& action, auto& row) {
    row.detail(action.kind).slot(action.slot).label(action.label).number(action.value);
  }
  bool operator==(const Action&) const = default;
};

/// An action with its time, seconds since the trial's start.
struct TimedAction : Action {
  double t_s = 0;
};

enum class CheckVerdict { ok, warning, failed };
template <>
struct EnumNames<CheckVerdict> {
  static constexpr std::array<std::string_view, 3> names{"ok", "warning", "failed"};
};

/// One check of the apparatus before a session.
struct CheckResult {
  static constexpr EventType event_type{"check", EventRole::recorded};
  CheckVerdict verdict = CheckVerdict::ok;
  std::string name;     ///< "frame rate", "light"...
  std::string finding;  ///< the figure; if not ok, also what was expected and what to do

  static void event_columns(auto& check, auto& row) {
    row.json("name", check.name).json("verdict", check.verdict).json("finding", check.finding);
  }
  bool operator==(const CheckResult&) const = default;
};

// The session's course:

struct TrialStarted {
  static constexpr EventType event_type{"trial_started", EventRole::course};
  bool operator==(const TrialStarted&) const = default;
};

struct TrialVoided {
  static constexpr EventType event_type{"void", EventRole::course};
  std::string reason;  ///< not empty; see void_interrupted
  static void event_columns(auto& voided, auto& row) { row.detail(voided.reason); }
  bool operator==(const TrialVoided&) const = default;
};

/// Voids the trial that was answered last. It is presented again, and its block's procedures are
/// restored to their state before the answer.
struct AnswerVetoed {
  static constexpr EventType event_type{"answer_vetoed", EventRole::course};
  std::string reason;  ///< not empty
  static void event_columns(auto& vetoed, auto& row) { row.detail(vetoed.reason); }
  bool operator==(const AnswerVetoed&) const = default;
};

struct SessionPaused {
  static constexpr EventType event_type{"paused", EventRole::course};
  std::string reason;
  static void event_columns(auto& paused, auto& row) { row.detail(paused.reason); }
  bool operator==(const SessionPaused&) const = default;
};

struct SessionContinued {
  static constexpr EventType event_type{"continued", EventRole::course};
  bool operator==(const SessionContinued&) const = default;
};

struct SessionResumed {
  static constexpr EventType event_type{"resumed", EventRole::course};
  std::string utc;
  double away_s = 0;  ///< since the previous event
  static void event_columns(auto& resumed, auto& row) {
    row.detail(resumed.utc).duration(resumed.away_s, /*if_none=*/0.0);
  }
  bool operator==(const SessionResumed&) const = default;
};

enum class Ending { finished, aborted };
template <>
struct EnumNames<Ending> {
  static constexpr std::array<std::string_view, 2> names{"finished", "aborted"};
};
struct SessionEnded {
  static constexpr EventType event_type{"ended", EventRole::course};
  Ending how = Ending::finished;
  static void event_columns(auto& ended, auto& row) { row.detail(ended.how); }
  bool operator==(const SessionEnded&) const = default;
};

struct DemonstrationShown {
  static constexpr EventType event_type{"demonstration_shown", EventRole::course};
  std::string block;
  static void event_columns(auto& shown, auto& row) { row.detail(shown.block); }
  bool operator==(const DemonstrationShown&) const = default;
};

struct BreakTaken {
  static constexpr EventType event_type{"break", EventRole::setting};
  std::string name;
  double duration_s = 0;
  static void event_columns(auto& taken, auto& row) {
    row.detail(taken.name).duration(taken.duration_s);
  }
  bool operator==(const BreakTaken&) const = default;
};

// Events of an attempt, besides Action:

/// The first presented frame that shows all cubes.
struct CubesShown {
  static constexpr EventType event_type{"cubes_shown", EventRole::attempt};
  bool operator==(const CubesShown&) const = default;
};

struct CubesReset {
  static constexpr EventType event_type{"cubes_reset", EventRole::attempt};
  std::optional<int> slot;  ///< of the cube that left the area; none: all cubes, by the button
  static void event_columns(auto& reset, auto& row) {
    row.slot(reset.slot)
        .detail_is(reset.slot ? "out_of_area" : "button",
                   "\"button\", or \"out_of_area\" with a cube's slot");
  }
  bool operator==(const CubesReset&) const = default;
};

/// The clone begins or ends to touch a cube.
struct CubeTouch {
  static constexpr EventType event_type{"cube_contact", EventRole::attempt};
  int slot = 0;
  std::optional<double> ended_after_s{};  ///< none: the touch begins
  /// For an ended touch, over its frames: largest displacement of the effector from its position in
  /// the first frame, and largest distance between clone and effector.
  std::optional<double> max_push_displacement_m{}, peak_lag_m{};
  static void event_columns(auto& touch, auto& row) {
    row.slot(touch.slot)
        .duration(touch.ended_after_s)
        .push(touch)
        .detail_is(touch.ended_after_s ? "ended" : "began",
                   "\"began\", or \"ended\" with a duration");
  }
  bool operator==(const CubeTouch&) const = default;
};

struct EffectorLost {
  static constexpr EventType event_type{"effector_lost", EventRole::attempt};
  bool operator==(const EffectorLost&) const = default;
};

struct EffectorFound {
  static constexpr EventType event_type{"effector_found", EventRole::attempt};
  bool operator==(const EffectorFound&) const = default;
};

// Recorded only, as CheckResult:

struct Consent {
  static constexpr EventType event_type{"consent", EventRole::recorded};
  bool agreed = false;
  std::string language, sha256;  ///< of the text
  static void event_columns(auto& consent, auto& row) {
    row.json("agreed", consent.agreed);
    row.json("language", consent.language).json("sha256", consent.sha256);
  }
  bool operator==(const Consent&) const = default;
};

struct TextShown {
  static constexpr EventType event_type{"text_shown", EventRole::recorded};
  std::string page, language, sha256;
  static void event_columns(auto& text, auto& row) {
    row.json("page", text.page).json("language", text.language);
    row.json("sha256", text.sha256);
  }
  bool operator==(const TextShown&) const = default;
};

struct Note {
  static constexpr EventType event_type{"note", EventRole::recorded};
  std::string text;
  static void event_columns(auto& note, auto& row) { row.detail(note.text); }
  bool operator==(const Note&) const = default;
};

struct Deviation {
  static constexpr EventType event_type{"deviation", EventRole::recorded};
  std::string text;
  static void event_columns(auto& deviation, auto& row) { row.detail(deviation.text); }
  bool operator==(const Deviation&) const = default;
};

struct Unblinding {
  static constexpr EventType event_type{"unblinding", EventRole::recorded};
  std::string who;
  static void event_columns(auto& unblinding, auto& row) { row.detail(unblinding.who); }
  bool operator==(const Unblinding&) const = default;
};

/// Counts of an attempt's camera pictures.
struct CameraReport {
  static constexpr EventType event_type{"camera", EventRole::recorded};
  int n_shown = 0, n_dropped = 0, n_late = 0;
  /// Shown pictures with a second print of a tag in view; none: the program did not count them.
  std::optional<int> n_doubled{};
  static void event_columns(auto& report, auto& row) {
    row.json("shown", report.n_shown).json("dropped", report.n_dropped);
    row.json("late", report.n_late).json("doubled", report.n_doubled);
  }
  bool operator==(const CameraReport&) const = default;
};

/// An action that was refused, because it came too early or was not offered. It has no effect.
struct ActionRefused {
  static constexpr EventType event_type{"refused", EventRole::recorded};
  Action action;
  std::string reason;
  static void event_columns(auto& refused, auto& row) {
    row.json("action", refused.action.kind).json("reason", refused.reason);
    row.slot(refused.action.slot).label(refused.action.label).number(refused.action.value);
  }
  bool operator==(const ActionRefused&) const = default;
};

}  // namespace heft
