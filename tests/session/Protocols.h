// Small protocols for tests of sessions.
#pragma once

#include "engine/Plans.h"
#include "protocol/Protocol.h"

namespace heft::testing {

/// Demonstration, introduction, four sorting trials, a break, two staircases.
inline Protocol small_protocol() {
  Protocol protocol;
  protocol.name = "small";
  protocol.text = "small";
  protocol.blocks = small_plan().blocks;
  return protocol;
}

/// Two sorting trials, at a display rate that is fast enough for a test.
inline Protocol quick_protocol() {
  Protocol protocol = small_protocol();
  protocol.display_rate_hz = 200;
  protocol.blocks = {Sorting::Block{"sorting", {15, 200, 800}, {{"C2", 2}}, 0}};
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
inline Comparison::Block short_comparison(int stop_reversals) {
  Comparison::Block comparison;
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

}  // namespace heft::testing
