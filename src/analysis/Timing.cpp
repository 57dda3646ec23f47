#include "analysis/Timing.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/Quantile.h"

namespace heft {

std::optional<double> response_time_s(const TrialRow& trial) {
  if (!trial.shown_s || !trial.validated_s) return std::nullopt;
  return *trial.validated_s - *trial.shown_s - trial.paused_s - trial.lost_s;
}

std::vector<ResponseTimes> response_times(std::span<const SessionData> sessions) {
  std::map<std::pair<Task, std::string>, std::vector<double>> times;
  for (const SessionData& data : sessions) {
    for (const Attempt& attempt : data.attempts) {
      if (!attempt.completed()) continue;
      auto& task_times = times[{attempt.trial.plan.task, attempt.trial.plan.condition}];
      if (const auto time = response_time_s(attempt.trial)) task_times.push_back(*time);
    }
  }
  std::vector<ResponseTimes> rows;
  for (const auto& [key, values] : times)
    rows.push_back({key.first, key.second, static_cast<int>(values.size()), quantile(values, 0.5),
                    quantile(values, 0.25), quantile(values, 0.75)});
  return rows;
}

std::vector<VoidCount> voids_of(std::span<const SessionData> sessions) {
  std::map<std::string, int> counts;
  for (const SessionData& data : sessions)
    for (const Attempt& attempt : data.attempts)
      if (attempt.trial.status == TrialStatus::voided)
        counts[attempt.trial.void_reason.value_or("no reason logged")] += 1;
  std::vector<VoidCount> voids;
  for (const auto& [reason, n] : counts) voids.push_back({reason, n});
  std::ranges::stable_sort(voids, std::greater(), &VoidCount::n);
  return voids;
}

}  // namespace heft
