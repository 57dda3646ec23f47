#include <algorithm>
#include <optional>

#include "apparatus/SessionSetup.h"
#include "physics/auto/Choice.h"
#include "physics/auto/ErrorTable.h"
#include "psychophysics/Procedure.h"

namespace heft {

namespace {
// Of the trials of a block, which may have none.
template <typename SomeBlock>
std::vector<std::vector<double>> masses_of(const SomeBlock& block) {
  if constexpr (requires { block.masses_g; }) return {block.masses_g};
  return {};
}
std::vector<std::vector<double>> masses_of(const ComparisonBlock& block) {
  std::vector<std::vector<double>> masses_g;
  for (const auto& [reference_g, staircase, technique] : block.staircases)
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
  std::vector<std::string> techniques{"C2"};
  for (const Technique& declared : protocol.techniques) techniques.push_back(declared.name);
  std::vector<std::vector<double>> trials{{}};
  for (const Block& block : protocol.blocks)
    for (const auto& masses_g : std::visit([](const auto& some) { return masses_of(some); }, block))
      trials.push_back(masses_g);
  std::optional<SimulatorPick> dearest;
  for (const std::string& technique : techniques)
    for (const auto& masses_g : trials) {
      const SimulatorPick pick =
          resolve_auto(scene_of(protocol, technique, masses_g), protocol.display_rate_hz);
      dearest = dearest ? std::max(*dearest, pick, is_cheaper) : pick;
    }
  return *dearest;
}

}  // namespace heft
