// Events of a session: the only input of the engine's fold, and the rows of the log's `event`
// table.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "experiment/EventPayloads.h"
#include "experiment/SessionConfig.h"

namespace heft {

/// New payloads are added at the end: EventKind is an index into this list.
using EventPayload =
    std::variant<TrialStarted, Action, TrialVoided, SessionPaused, SessionContinued, CubesReset,
                 DemonstrationShown, SessionResumed, SessionEnded, SessionConfig, CubesShown,
                 CubeTouch, EffectorLost, EffectorFound, Consent, TextShown, BreakTaken, Note,
                 Deviation, Unblinding, CameraReport, CheckResult, ActionRefused, AnswerVetoed>;

/// Index of a payload in EventPayload; its name is that of the payload in the log.
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

/// Reason of an attempt that a crash interrupted; it is repeated with the same draws.
inline constexpr std::string_view void_interrupted = "interrupted";

/// Start of the reason of a trial whose answer was vetoed.
inline constexpr std::string_view answer_vetoed = "answer vetoed: ";

/// Rounds a time to the log's resolution, 2^-20 s (about 1 us). Sums and differences of such times
/// are exact, so a duration has the same bits anywhere in a session.
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
