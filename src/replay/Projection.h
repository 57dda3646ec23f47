// A folded session: the rows projected from its events, and what each attempt's world needs to be
// recomputed.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/Engine.h"
#include "experiment/Rows.h"
#include "record/reader/LogReader.h"

namespace heft {

// A projected row as named columns of text, to compare logged and folded rows and to name a
// difference. Equal texts of doubles mean equal bits.

struct ColumnText {
  std::string name, value;
};

struct RowText {
  std::string table;  ///< name in the log
  std::string key;    ///< of the row, for messages: "cube 2 of trial 7"
  int attempt_index = 0;
  double t_s = 0;  ///< session time of the row; negative: its attempt's end
  std::vector<ColumnText> columns;
};

/// One event of an attempt, and the number of the session's events before it.
struct AttemptEvent {
  int before = 0;
  double previous_s = 0;  ///< time of the previous event
  Event event;
  TrialPlan plan_after;  ///< as presented after this event
};

struct ProjectedAttempt {
  TrialRow row;  ///< as last projected
  TrialPlan first_plan;
  std::vector<AttemptEvent> events;  ///< after trial_started
};

struct Projection {
  std::map<int, ProjectedAttempt> attempts;  ///< by attempt index
  std::map<std::string, RowText> rows;       ///< by table and key
  std::vector<SessionConfig> setups;         ///< in order; a trial's setup_index counts them from 1
  SessionState state = SessionState::running;
  int n_events = 0;
  double last_s = 0;  ///< of the last event
  /// The first event that is not possible, and the reason; the fold stops there.
  std::optional<std::pair<LoggedEvent, std::string>> refused;
};

Projection fold_session(std::shared_ptr<const SessionPlan> plan, std::uint64_t seed,
                        const std::vector<LoggedEvent>& events);

/// The rows of the log, by the same keys.
std::map<std::string, RowText> logged_rows(const LogReader& reader, std::int64_t session_id);

}  // namespace heft
