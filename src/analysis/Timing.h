// How long answers took, and why attempts are void.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/Fold.h"
#include "tasks/Tasks.h"

namespace heft {

/// validated - shown - paused - lost, in seconds; none where the trial was not shown or validated.
std::optional<double> response_time_s(const TrialRow& trial);

/// Completed trials of one task in one condition, all participants together.
struct ResponseTimes {
  Task task;
  std::string condition;
  int n_trials = 0;  ///< with a response time
  std::optional<double> median_s, lower_quartile_s, upper_quartile_s;
};

/// By task and condition; only those that have a completed trial.
class TimesFold {
 public:
  void add(const SessionData& data);
  std::vector<ResponseTimes> result() const;

 private:
  std::map<std::pair<Task, std::string>, std::deque<double>, InTaskOrder> times_s_;
};

struct VoidCount {
  std::string reason;
  int n = 0;
};

/// Void attempts by reason, most frequent first.
class VoidsFold {
 public:
  void add(const SessionData& data);
  std::vector<VoidCount> result() const;

 private:
  std::map<std::string, int> counts_;
};

inline std::vector<ResponseTimes> response_times(std::span<const SessionData> sessions) {
  return folded<TimesFold>(sessions);
}
inline std::vector<VoidCount> voids_of(std::span<const SessionData> sessions) {
  return folded<VoidsFold>(sessions);
}

}  // namespace heft
