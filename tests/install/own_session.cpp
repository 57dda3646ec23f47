// An external program: a session whose comparisons interleave a procedure defined here with one of
// Heft's.
#include <cstdio>

#include "engine/Engine.h"
#include "psychophysics/UpDown.h"
#include "tasks/Comparison.h"

// Bisects the interval that contains the threshold.
struct Bisection {
  double low, high;

  double next_level(const heft::RandomStream&) const { return (low + high) / 2; }
  heft::Update respond(const heft::Response& response, double shown) {
    (response.positive ? high : low) = shown;
    return {{}, finish()};
  }
  std::optional<heft::StopReason> finish() const {
    return high - low < 2 ? std::optional(heft::StopReason::precision) : std::nullopt;
  }
  std::vector<heft::Estimate> estimates() const {
    return {{.method = "bisection", .value = (low + high) / 2, .low = low, .high = high}};
  }
};

int main() {
  heft::UpDownConfig rule{.start = 175, .step = 50, .halve_every = 2, .floor = 0};
  heft::Comparison::Block block;
  block.name = "comparison";
  block.staircases = {{15, {"own", Bisection{0, 400}}, {}}, {15, {"15g", rule}, {}}};
  auto plan = std::make_shared<heft::SessionPlan>();
  plan->blocks = {block};
  heft::Engine engine(plan, 1);
  constexpr double threshold_g = 62;
  int n_estimates = 0;
  for (double t_s = 0; engine.next().kind == heft::Next::Kind::trial;) {
    engine.apply(heft::Event{t_s += 1, heft::TrialStarted{}});
    engine.apply(heft::Event{t_s += 1, heft::CubesShown{}});
    const heft::TrialPlan trial = *engine.next().plan;
    heft::Action answer{"no_difference", {}, {}};
    if (*trial.level_g > threshold_g) answer = {"select", trial.reference_slot == 1 ? 2 : 1, {}};
    for (const heft::EstimateRow& row : engine.apply(heft::Event{t_s += 1, answer}).estimates) {
      std::printf("%s: %.2f g\n", row.staircase.c_str(), *row.jnd_g);
      ++n_estimates;
    }
  }
  return n_estimates == 2 ? 0 : 1;
}
