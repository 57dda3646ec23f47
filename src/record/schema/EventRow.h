// An event as a row of the log, a configuration as the JSON of its event, and an event as a line of
// JSON for other programs while a session runs.
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
  visit(LogColumn{"kind", "", "kind of event"}, row.kind);
  visit(LogColumn{"slot", "", "slot of the cube; 1 is leftmost", "BETWEEN 1 AND 6"}, row.slot);
  visit(LogColumn{"label", "", "label of the action"}, row.label);
  visit(LogColumn{"detail", "", "depends on the kind: action, reason, text or JSON"}, row.detail);
  visit(LogColumn{"value", "", "depends on the kind: duration in seconds or given number"},
        row.value);
  visit_push_columns(row, visit);
}

EventRow row_of(const Event& event);

/// @throws Error if the row is no event of its kind: what was expected and found
Event event_of(const EventRow& row);

/// An event as a line of text for people.
std::string text_of(const Event& event);

/// `the answer "label cube 2 heaviest" of trial 7`, `the event "cubes_reset" of trial 7`
std::string description(const Event& event, std::optional<int> trial_number);

/// What event_line() adds to the event.
struct AnnouncedEvent {
  std::int64_t session_id = 0;
  std::string participant;
  std::string utc;                ///< of the event
  std::optional<TrialPlan> plan;  ///< of the event's trial
  /// For an event that is announced twice: whether it is on disk.
  std::optional<bool> logged = {};
};

/// {"t_s":12.5,"utc":"...","session":1,"participant":"P07","kind":"cubes_shown","trial":3,...}:
/// kind, slot, label and detail as in the table `event`, without the files of a setup, masses,
/// levels and conditions. Long details are truncated: at most 2000 bytes in total.
std::string event_line(const Event& event, const AnnouncedEvent& about);

/// {"t_s":812.5,"utc":"...","session":1,"participant":"P07","kind":"sealed","head":"1a2b..."}
std::string sealed_line(const AnnouncedEvent& about, double t_s, const std::string& head);

/// JSON object with all columns and the contents of files.
std::string to_json(const SessionConfig& setup);

/// Missing keys keep their defaults: they are newer than the text.
/// @throws Error if the text is no such object
SessionConfig setup_from_json(const std::string& text);

}  // namespace heft
