// How long answers took, and why attempts are void.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/Dataset.h"

namespace heft {

/// validated - shown - paused - lost, in seconds; none where the trial was not shown or validated.
std::optional<double> response_time_s(const TrialRow& trial);

/// Completed trials of one task in one condition, all participants together.
struct ResponseTimes {
  Task task = Task::sorting;
  std::string condition;
  int n_trials = 0;  ///< with a response time
  std::optional<double> median_s, lower_quartile_s, upper_quartile_s;
};

/// By task and condition; only those that have a completed trial.
std::vector<ResponseTimes> response_times(std::span<const SessionData> sessions);

struct VoidCount {
  std::string reason;
  int n = 0;
};

/// Void attempts by reason, most frequent first.
std::vector<VoidCount> voids_of(std::span<const SessionData> sessions);

}  // namespace heft
