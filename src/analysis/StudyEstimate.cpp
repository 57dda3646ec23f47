#include "analysis/StudyEstimate.h"

#include <fmt/format.h>

#include "base/Quantile.h"

namespace heft {

std::string_view beyond_sign(Censored censored) {
  if (censored == Censored::none || censored == Censored::unsettled) return "";
  return censored == Censored::above ? "> " : "< ";
}

Coordinate at(std::string_view name, double value) {
  return {name, fmt::format("{:g}", value), value};
}

std::optional<Interval> interval_of(const published::Figure& figure) {
  if (figure.sd) return student_t_interval(figure.value, *figure.sd, published::n_participants);
  if (!figure.n_hits) return std::nullopt;
  const Interval shares = exact_interval(*figure.n_hits, published::n_participants);
  return Interval{100 * shares.low, 100 * shares.high};
}

StudyEstimate quartiles_estimate(const Measure& measure, const std::deque<double>& values) {
  StudyEstimate estimate{&measure};
  estimate.n_trials = static_cast<int>(values.size());
  estimate.method = "quartiles";
  if (const auto found = quartiles({values.begin(), values.end()})) {
    estimate.value = found->median;
    estimate.low = found->lower;
    estimate.high = found->upper;
  }
  return estimate;
}

StudyEstimate rate_estimate(const Measure& measure, const Rate& rate) {
  StudyEstimate estimate{&measure};
  estimate.value = rate.percent;
  estimate.set(rate.interval_percent);
  estimate.n = rate.n_participants;
  estimate.n_trials = rate.trials.n_trials;
  estimate.n_hits = rate.trials.n_hits;
  return estimate;
}

}  // namespace heft
