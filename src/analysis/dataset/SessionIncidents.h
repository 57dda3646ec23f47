// Configurations of the sessions, and incidents: notes, deviations, unblindings, failed checks.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "analysis/dataset/Dataset.h"

namespace heft {

/// One value of a column of the log's table `setup`.
struct SetupValue {
  std::string what, unit, value, meaning;
  int n_sessions = 0, n_attempts = 0;  ///< that ran with it
};

/// Every recorded value, in the order of the columns.
class SetupsFold {
 public:
  void add(const SessionData& data);
  std::vector<SetupValue> result() const;

 private:
  struct Counted {
    int n_sessions = 0, n_attempts = 0;
  };
  std::map<std::pair<std::size_t, std::string>, Counted> values_;  // by column and value
};

/// A note, deviation, unblinding or a check that was not passed, as the log has it.
struct Incident {
  std::int64_t session_id = 0;
  std::string participant;
  Noted noted;
};

/// In order.
class IncidentsFold {
 public:
  void add(const SessionData& data);
  std::vector<Incident> result() const { return incidents_; }

 private:
  std::vector<Incident> incidents_;
};

}  // namespace heft
