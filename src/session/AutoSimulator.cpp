#include "session/AutoSimulator.h"

#include <algorithm>

#include "physics/auto/ErrorTable.h"

namespace heft {

namespace {
std::vector<std::vector<double>> masses_of(const DemonstrationBlock&) {
  return {};
}
std::vector<std::vector<double>> masses_of(const BreakBlock&) {
  return {};
}
std::vector<std::vector<double>> masses_of(const IntroductionBlock& block) {
  return {block.masses_g};
}
std::vector<std::vector<double>> masses_of(const SortingBlock& block) {
  return {block.masses_g};
}
std::vector<std::vector<double>> masses_of(const ComparisonBlock& block) {
  std::vector<std::vector<double>> masses_g;
  for (const auto& [reference_g, staircase] : block.staircases)
    for (double level_g : Procedure(staircase).planned_levels())
      masses_g.push_back({reference_g, reference_g + level_g});
  return masses_g;
}

// Of one table, so that the picks can be compared: the dearer simulator, or the shorter steps.
bool is_cheaper(const SimulatorPick& a, const SimulatorPick& b) {
  const auto rung = [](const SimulatorPick& pick) {
    return std::ranges::find(ladder_of_simulators, pick.simulator) - ladder_of_simulators.begin();
  };
  return rung(a) != rung(b) ? rung(a) < rung(b) : a.rate_hz < b.rate_hz;
}
}  // namespace

SimulatorPick resolve_auto(const Protocol& protocol) {
  SimulatorPick dearest =
      resolve_auto(scene_of(protocol, Condition::C2, {}), protocol.display_rate_hz);
  for (const Block& block : protocol.blocks)
    for (const auto& masses_g :
         std::visit([](const auto& some) { return masses_of(some); }, block)) {
      const SimulatorPick pick =
          resolve_auto(scene_of(protocol, Condition::C2, masses_g), protocol.display_rate_hz);
      dearest = std::max(dearest, pick, is_cheaper);
    }
  return dearest;
}

}  // namespace heft
