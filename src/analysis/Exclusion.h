// Who takes part in the figures: everybody, but for those whom the protocol said beforehand that it
// would leave out.
#pragma once

#include <map>
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
class ParticipantsFold {
 public:
  void add(const SessionData& data);
  std::vector<ParticipantRow> result() const;

 private:
  struct Seen {
    ParticipantRow row;
    int n_attempts = 0;
    ExclusionRules rules;
  };
  std::map<std::string, Seen> participants_;
};

/// What all sessions' protocols declare alike; none where one declares nothing or something else.
class PlanFold {
 public:
  void add(const SessionData& data);
  std::optional<AnalysisPlan> result() const { return differ_ ? std::nullopt : plan_; }

 private:
  std::optional<AnalysisPlan> plan_;
  bool differ_ = false;
};

inline std::vector<ParticipantRow> participants_of(std::span<const SessionData> sessions) {
  return folded<ParticipantsFold>(sessions);
}
inline std::optional<AnalysisPlan> declared_plan(std::span<const SessionData> sessions) {
  return folded<PlanFold>(sessions);
}

}  // namespace heft
