// Somebody else's program: a staircase that looks for the mass difference a person can feel.
#include <cmath>
#include <cstdio>

#include "psychophysics/Staircase.h"

int main() {
  heft::StaircaseConfig config;
  config.start = 200;
  config.steps = {50, 25, 10, 5};
  config.floor = 0;
  config.stop_reversals = 12;
  config.discard_reversals = 4;
  heft::Staircase staircase(config);

  constexpr double threshold_g = 62;  // of a person who never errs
  while (!staircase.finished()) {
    const double shown_g = staircase.level();
    const bool felt = shown_g > threshold_g;
    std::printf("%3d  %6.1f g  %s\n", staircase.n_trials() + 1, shown_g, felt ? "felt" : "-");
    staircase.respond(felt);
  }
  std::printf("threshold: %.2f g\n", *staircase.estimate());
  return std::abs(*staircase.estimate() - threshold_g) < 5 ? 0 : 1;
}
