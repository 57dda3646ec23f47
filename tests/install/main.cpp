// An external program: a staircase that finds the mass difference a participant can perceive.
#include <cmath>
#include <cstdio>

#include "psychophysics/Procedure.h"
#include "psychophysics/UpDown.h"

int main() {
  heft::UpDownConfig rule;
  rule.start = 200;
  rule.steps = {50, 25, 10, 5};
  rule.floor = 0;
  rule.stop_reversals = 12;
  rule.discard_reversals = 4;
  heft::Procedure staircase("mass", rule);
  const heft::RandomStream stream = heft::level_stream(1, "mass");  // for kinds that draw levels
  constexpr double threshold_g = 62;                                // of an observer without noise
  while (!staircase.finished()) {
    const double shown_g = staircase.next_level(stream);
    const bool perceived = shown_g > threshold_g;
    std::printf("%3d  %6.1f g  %s\n", staircase.n_trials() + 1, shown_g,
                perceived ? "perceived" : "-");
    staircase.respond({perceived}, shown_g);
  }
  const double estimate_g = *staircase.estimates().front().value;
  std::printf("threshold: %.2f g\n", estimate_g);
  return std::abs(estimate_g - threshold_g) < 5 ? 0 : 1;
}
