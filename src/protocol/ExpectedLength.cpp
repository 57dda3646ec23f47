#include "protocol/ExpectedLength.h"

#include <algorithm>

#include "base/Random.h"

namespace heft {

namespace {
// Trials that one observer takes; level by level it says yes where the difference, with noise in
// proportion to the threshold, is beyond the threshold.
int simulated_trials(Procedure procedure, double threshold_g, std::uint64_t observer) {
  constexpr double noise_per_threshold = 0.4;
  constexpr int enough_trials = 1000;  // steps too small for their start never get anywhere
  RandomStream stream(0, "expected length", observer);
  const RandomStream levels = level_stream(observer, procedure.name());
  while (!procedure.finished() && procedure.n_trials() < enough_trials) {
    const double level_g = procedure.next_level(levels);
    const double seen_g = level_g + noise_per_threshold * threshold_g * stream.normal();
    procedure.respond({seen_g > threshold_g}, level_g);
  }
  return procedure.n_trials();
}

double mean_trials(const Procedure& procedure, double largest_threshold_g) {
  if (const auto planned = procedure.planned_trials()) return *planned;
  constexpr int n_observers = 200;
  double total = 0;
  for (int i = 0; i < n_observers; ++i) {
    const double fraction = 0.25 + 0.75 * (i + 0.5) / n_observers;
    total +=
        simulated_trials(procedure, fraction * largest_threshold_g, static_cast<std::uint64_t>(i));
  }
  return total / n_observers;
}

// Staircases of one reference that start from above and from below meet the same observers.
double largest_start_g(const ComparisonBlock& block, double reference_g) {
  double largest_g = 0;
  for (const ReferenceStaircase& other : block.staircases)
    if (other.reference_g == reference_g)
      for (double level_g : other.staircase.planned_levels())
        largest_g = std::max(largest_g, level_g);
  return largest_g;
}

class Forecast {
 public:
  Forecast(const TrialDurations& durations, double gap_s) : durations_(durations), gap_s_(gap_s) {}

  void operator()(const DemonstrationBlock& block) { seconds_ += block.duration_s; }
  void operator()(const BreakBlock& block) { seconds_ += block.least_duration_s; }
  void operator()(const IntroductionBlock&) { add_trials(1, durations_.introduction_s); }
  void operator()(const SortingBlock& block) { add_trials(block.n_trials(), durations_.sorting_s); }
  void operator()(const ComparisonBlock& block) {
    double trials = 0;
    for (const ReferenceStaircase& reference : block.staircases)
      trials += mean_trials(reference.staircase, largest_start_g(block, reference.reference_g));
    length_.staircase_trials += trials;
    length_.staircases += static_cast<int>(block.staircases.size());
    trials /= 1 - block.catch_fraction;
    for (const ReferenceCatchTrials& some : block.catch_trials) trials += some.trials;
    add_trials(trials, durations_.comparison_s);
  }

  ExpectedLength length() const {
    ExpectedLength length = length_;
    length.minutes = seconds_ / 60;
    return length;
  }

 private:
  void add_trials(double trials, double seconds_each) {
    length_.trials += trials;
    seconds_ += trials * (seconds_each + gap_s_);
  }

  TrialDurations durations_;
  double gap_s_;
  ExpectedLength length_;
  double seconds_ = 0;
};
}  // namespace

ExpectedLength expected_length(const Protocol& protocol, const TrialDurations& durations) {
  Forecast forecast(durations, protocol.onset.gap_s);
  for (const Block& block : protocol.blocks) std::visit(forecast, block);
  return forecast.length();
}

}  // namespace heft
