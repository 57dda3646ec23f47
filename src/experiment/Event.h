// The events of a session: the only input of the engine's fold, and the rows of the log's `event`
// table.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "experiment/Task.h"

namespace heft {

enum class EventKind {
  // What the session's course depends on:
  trial_started,
  action,  ///< detail: the ActionKind's name
  voided,  ///< detail: the reason; "interrupted" reruns with the same draws
  paused,  ///< detail: the reason
  continued,
  cubes_reset,  ///< detail: "button" or "out_of_area" (then with the slot)
  demonstration_shown,
  resumed,  ///< value: seconds since the last event before
  ended,    ///< detail: "finished" or "aborted"
  // What only fills columns of the projected rows:
  cubes_shown,   ///< the first presented picture with all cubes on it
  cube_contact,  ///< detail: "began", or "ended" with value: seconds of contact
  effector_lost,
  effector_found,
  // What is only kept:
  consent,
  text_shown,
  rest,  ///< value: seconds
  note,
  deviation,
  unblinding,
  camera,
  check
};
template <>
struct EnumNames<EventKind> {
  static constexpr std::array<std::string_view, 21> names{"trial_started",
                                                          "action",
                                                          "void",
                                                          "paused",
                                                          "continued",
                                                          "cubes_reset",
                                                          "demonstration_shown",
                                                          "resumed",
                                                          "ended",
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
                                                          "check"};
};

/// Why an attempt that a crash cut short is void; it is run again with the same draws.
inline constexpr std::string_view void_interrupted = "interrupted";

/// A time as the log keeps it: to 2^-20 s, about a microsecond. Sums and differences of such times
/// are exact, so durations come out the same bit for bit wherever in a session they lie.
inline double log_time(double t_s) {
  return std::round(t_s * 0x1p20) * 0x1p-20;
}

struct Event {
  double t_s = 0;  ///< since session start, monotonic
  EventKind kind = EventKind::note;
  std::optional<int> slot;
  std::optional<Label> label;
  std::string detail;
  std::optional<double> value;

  bool operator==(const Event&) const = default;
};

}  // namespace heft
