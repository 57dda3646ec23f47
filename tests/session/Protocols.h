// Small protocols made in code, for tests of the session room.
#pragma once

#include <memory>

#include "protocol/Protocol.h"
#include "psychophysics/Procedure.h"

namespace heft::testing {

inline ProcedureConfig staircase(const std::string& name, double start_g, double step_g,
                                 int stop_trials = 30) {
  UpDownConfig config;
  config.start = start_g;
  config.step = step_g;
  config.halve_every = 2;
  config.floor = 0;
  config.stop_reversals = 4;
  config.stop_trials = stop_trials;
  config.discard_reversals = 2;
  return {name, config};
}

/// Demonstration, introduction, four sorting trials, a break, two staircases.
inline Protocol small_protocol() {
  Protocol protocol;
  protocol.name = "small";
  protocol.text = "small";
  IntroductionBlock introduction{"introduction", {15, 800}};
  SortingBlock sorting{"sorting", {15, 200, 800}, {{"C1", 2}, {"C2", 2}}, 2};
  ComparisonBlock comparison;
  comparison.name = "comparison";
  comparison.staircases = {{15, staircase("15g", 175, 50)}, {200, staircase("200g", 600, 150)}};
  protocol.blocks = {DemonstrationBlock{"demonstration", 20}, introduction, sorting,
                     BreakBlock{"break", 60}, comparison};
  return protocol;
}

/// Two sorting trials, at a display fast enough for a test.
inline Protocol quick_protocol() {
  Protocol protocol = small_protocol();
  protocol.display_rate_hz = 200;
  protocol.blocks = {SortingBlock{"sorting", {15, 200, 800}, {{"C2", 2}}, 0}};
  return protocol;
}

/// A quick one with every page: all screens, a demonstration, a break, and the introduction after
/// it.
inline Protocol every_page_protocol() {
  Protocol protocol = quick_protocol();
  protocol.screens = {"fr", true, true, true};
  protocol.blocks.insert(protocol.blocks.begin(), DemonstrationBlock{"demonstration", 0.1});
  protocol.blocks.push_back(BreakBlock{"break", 0.1});
  protocol.blocks.push_back(small_protocol().blocks[1]);  // the introduction
  return protocol;
}

/// Comparisons by one short staircase.
inline ComparisonBlock short_comparison(int stop_reversals) {
  ComparisonBlock comparison;
  comparison.name = "comparison";
  comparison.staircases = {{15, staircase("15g", 175, 50, stop_reversals)}};
  return comparison;
}

/// The same with a short staircase at the end.
inline Protocol whole_protocol(double display_rate_hz, int stop_reversals) {
  Protocol protocol = every_page_protocol();
  protocol.display_rate_hz = display_rate_hz;
  protocol.blocks.push_back(short_comparison(stop_reversals));
  return protocol;
}

/// The same protocol with nothing but a short staircase.
inline Protocol comparing_alone(Protocol protocol) {
  protocol.blocks = {short_comparison(3)};
  return protocol;
}

inline std::shared_ptr<const Protocol> shared(Protocol protocol) {
  return std::make_shared<const Protocol>(std::move(protocol));
}

}  // namespace heft::testing
