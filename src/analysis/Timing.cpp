#include "analysis/Timing.h"

#include <algorithm>
#include <functional>

#include "base/Quantile.h"

namespace heft {

std::optional<double> response_time_s(const TrialRow& trial) {
  if (!trial.shown_s || !trial.validated_s) return std::nullopt;
  return *trial.validated_s - *trial.shown_s - trial.paused_s - trial.lost_s;
}

void TimesFold::add(const SessionData& data) {
  for (const Attempt& attempt : data.attempts) {
    if (!attempt.completed()) continue;
    auto& times_s = times_s_[{attempt.trial.plan.task, attempt.trial.plan.condition}];
    if (const auto time_s = response_time_s(attempt.trial)) times_s.push_back(*time_s);
  }
}

std::vector<ResponseTimes> TimesFold::result() const {
  std::vector<ResponseTimes> rows;
  for (const auto& [key, values] : times_s_) {
    ResponseTimes& row = rows.emplace_back(
        ResponseTimes{key.first, key.second, static_cast<int>(values.size()), {}, {}, {}});
    if (const auto found = quartiles({values.begin(), values.end()})) {
      row.median_s = found->median;
      row.lower_quartile_s = found->lower;
      row.upper_quartile_s = found->upper;
    }
  }
  return rows;
}

void VoidsFold::add(const SessionData& data) {
  for (const Attempt& attempt : data.attempts)
    if (attempt.trial.status == TrialStatus::voided)
      counts_[attempt.trial.void_reason.value_or("no reason logged")] += 1;
}

std::vector<VoidCount> VoidsFold::result() const {
  std::vector<VoidCount> voids;
  for (const auto& [reason, n] : counts_) voids.push_back({reason, n});
  std::ranges::stable_sort(voids, std::greater(), &VoidCount::n);
  return voids;
}

}  // namespace heft
