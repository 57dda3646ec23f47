// An event as the log has it: the one place where an event becomes text and back; and as a line of
// JSON, announced to other programs while a session runs.
// A setup as the JSON object that its event carries: every column, and the contents of its files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "experiment/Event.h"
#include "experiment/Rows.h"
#include "experiment/SessionConfig.h"

namespace heft {

struct EventRow {
  int attempt_index = 0;  ///< 0: none
  double t_s = 0;
  EventKind kind = event_kind<Note>;
  std::optional<int> slot;
  std::optional<Label> label;
  std::string detail;
  std::optional<double> value;
  std::optional<double> max_push_displacement_m, peak_lag_m;

  bool operator==(const EventRow&) const = default;
};
template <typename Row, typename Visit>
requires RowOf<Row, EventRow>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"t_s", "s", "session time", ">= 0"}, row.t_s);
  visit(LogColumn{"kind", "", "what happened"}, row.kind);
  visit(LogColumn{"slot", "", "to which cube, 1 leftmost", "BETWEEN 1 AND 6"}, row.slot);
  visit(LogColumn{"label", "", "with which label"}, row.label);
  visit(LogColumn{"detail", "", "the action, the reason, a text, or JSON, by kind"}, row.detail);
  visit(LogColumn{"value", "", "a duration in seconds or the number that was given, by kind"},
        row.value);
  visit_push_columns(row, visit);
}

EventRow row_of(const Event& event);

/// @throws Error when the row can't be an event of its kind: what was expected, what was found
Event event_of(const EventRow& row);

/// An event in a line, for people.
std::string text_of(const Event& event);

/// What an event's line for other programs says besides the event.
struct AnnouncedEvent {
  std::int64_t session_id = 0;
  std::string participant;
  std::string utc;                ///< of the event
  std::optional<TrialPlan> plan;  ///< of the trial that it belongs to
};

/// {"t_s":12.5,"utc":"...","session":1,"participant":"P07","kind":"cubes_shown","trial":3,...}:
/// kind, slot, label and detail as the table `event` has them, without a setup's files; nothing of
/// masses, levels or conditions. A long detail is cut: at most 2000 bytes in all.
std::string event_line(const Event& event, const AnnouncedEvent& about);

std::string to_json(const SessionConfig& setup);

/// What the text does not have keeps its default: it came after the text was written.
/// @throws Error when it is no such object
SessionConfig setup_from_json(const std::string& text);

}  // namespace heft
