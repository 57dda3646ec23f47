// The events of a session: the only input of the engine's fold, and the rows of the log's `event`
// table. Each payload is a type that declares its fields, its name in the log, what the engine does
// with it and which columns of the event's row it fills.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "experiment/Action.h"
#include "experiment/Check.h"
#include "experiment/EventType.h"
#include "experiment/SessionConfig.h"
#include "experiment/Task.h"

namespace heft {

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

struct CubesReset {
  static constexpr EventType event_type{"cubes_reset", EventRole::attempt};
  std::optional<int> slot;  ///< of the cube that had left the area; none: all, by the button
  static void event_columns(auto& reset, auto& row) {
    row.slot(reset.slot)
        .detail_is(reset.slot ? "out_of_area" : "button",
                   "\"button\", or \"out_of_area\" with a cube's slot");
  }
  bool operator==(const CubesReset&) const = default;
};

struct DemonstrationShown {
  static constexpr EventType event_type{"demonstration_shown", EventRole::course};
  std::string block;
  static void event_columns(auto& shown, auto& row) { row.detail(shown.block); }
  bool operator==(const DemonstrationShown&) const = default;
};

struct SessionResumed {
  static constexpr EventType event_type{"resumed", EventRole::course};
  std::string utc;
  double away_s = 0;  ///< since the last event before
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

// Of an attempt (Action too):

/// The first presented frame with all cubes on it.
struct CubesShown {
  static constexpr EventType event_type{"cubes_shown", EventRole::attempt};
  bool operator==(const CubesShown&) const = default;
};

struct CubeTouch {
  static constexpr EventType event_type{"cube_contact", EventRole::attempt};
  int slot = 0;
  std::optional<double> ended_after_s{};  ///< none: it began
  /// Of an ended touch, over its frames: how far the effector went from where it was in the first
  /// of them, and the clone's largest distance from it.
  std::optional<double> deepest_push_m{}, peak_lag_m{};
  static void event_columns(auto& touch, auto& row) {
    row.slot(touch.slot)
        .duration(touch.ended_after_s)
        .push(touch)
        .detail_is(touch.ended_after_s ? "ended" : "began",
                   "\"began\", or \"ended\" with a duration");
  }
  bool operator==(const CubeTouch&) const = default;
};

/// The answer to the trial that was answered last does not count: it is presented again, and its
/// block is as if it had not been answered.
struct AnswerVetoed {
  static constexpr EventType event_type{"answer_vetoed", EventRole::course};
  std::string reason;  ///< not empty
  static void event_columns(auto& vetoed, auto& row) { row.detail(vetoed.reason); }
  bool operator==(const AnswerVetoed&) const = default;
};

struct EffectorLost {
  static constexpr EventType event_type{"effector_lost", EventRole::attempt};
  bool operator==(const EffectorLost&) const = default;
};

struct EffectorFound {
  static constexpr EventType event_type{"effector_found", EventRole::attempt};
  bool operator==(const EffectorFound&) const = default;
};

// What is only recorded (CheckResult too), and breaks:

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

struct BreakTaken {
  static constexpr EventType event_type{"break", EventRole::setting};
  std::string name;
  double duration_s = 0;
  static void event_columns(auto& taken, auto& row) {
    row.detail(taken.name).duration(taken.duration_s);
  }
  bool operator==(const BreakTaken&) const = default;
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

/// How an attempt's pictures came along.
struct CameraReport {
  static constexpr EventType event_type{"camera", EventRole::recorded};
  int n_shown = 0, n_dropped = 0, n_late = 0;
  static void event_columns(auto& report, auto& row) {
    row.json("shown", report.n_shown).json("dropped", report.n_dropped);
    row.json("late", report.n_late);
  }
  bool operator==(const CameraReport&) const = default;
};

/// What a participant did that could not be taken: too early, or not offered. It changed nothing.
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

/// Each declares its name and role (event_type), and, unless it is empty, the columns of the
/// event's row that it fills (event_columns). A new one is added at the end: the log's list keeps
/// the order.
using EventPayload =
    std::variant<TrialStarted, Action, TrialVoided, SessionPaused, SessionContinued, CubesReset,
                 DemonstrationShown, SessionResumed, SessionEnded, SessionConfig, CubesShown,
                 CubeTouch, EffectorLost, EffectorFound, Consent, TextShown, BreakTaken, Note,
                 Deviation, Unblinding, CameraReport, CheckResult, ActionRefused, AnswerVetoed>;

/// A payload's place in EventPayload. It has the name that the payload has in the log.
enum class EventKind : std::size_t {};

template <typename... Payloads>
struct EventPayloads {
  static constexpr std::array names{Payloads::event_type.name...};
  template <typename Payload>
  static constexpr std::size_t place_of() {
    constexpr std::array is_payload{std::is_same_v<Payload, Payloads>...};
    return static_cast<std::size_t>(std::ranges::find(is_payload, true) - is_payload.begin());
  }
};
template <typename... Payloads>
EventPayloads<Payloads...> payloads_of(const std::variant<Payloads...>&);
using ListedPayloads = decltype(payloads_of(std::declval<EventPayload>()));

template <typename Payload>
inline constexpr EventKind event_kind{ListedPayloads::place_of<Payload>()};

template <>
struct EnumNames<EventKind> {
  static constexpr auto names = ListedPayloads::names;
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
  EventPayload what = Note{};

  EventKind kind() const { return static_cast<EventKind>(what.index()); }
  template <typename Payload>
  const Payload* as() const {
    return std::get_if<Payload>(&what);
  }
  template <typename... Payloads>
  bool is() const {
    return (std::holds_alternative<Payloads>(what) || ...);
  }

  bool operator==(const Event&) const = default;
};

}  // namespace heft
