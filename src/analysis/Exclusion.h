// Who takes part in the figures: everybody, but for those whom the protocol said beforehand that it
// would leave out.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/Dataset.h"
#include "protocol/AnalysisPlan.h"

namespace heft {

/// What one participant did, and whether it counts.
struct ParticipantRow {
  std::string participant;
  int n_sessions = 0, n_finished = 0;
  int n_completed = 0;  ///< trials
  int n_impossible = 0, n_lost = 0, n_catch = 0, n_false_alarms = 0;
  std::string excluded_because;  ///< empty: counts

  bool excluded() const { return !excluded_because.empty(); }
};

/// By name. The rules are those of each one's first session.
std::vector<ParticipantRow> participants_of(std::span<const SessionData> sessions);

/// The sessions of those who count.
std::vector<SessionData> included(std::span<const SessionData> sessions,
                                  std::span<const ParticipantRow> participants);

/// What all sessions' protocols declare alike; none where one declares nothing or something else.
std::optional<AnalysisPlan> declared_plan(std::span<const SessionData> sessions);

}  // namespace heft
