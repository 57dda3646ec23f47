#include <algorithm>

#include "apparatus/SessionSetup.h"
#include "base/DefaultTechniques.h"
#include "physics/auto/Choice.h"

namespace heft {

SimulatorPick resolve_auto(const Protocol& protocol) {
  std::vector<std::string> techniques{spring_technique};
  for (const Technique& declared : protocol.techniques) techniques.push_back(declared.name);
  std::vector<SimulatorPick> picks;
  for (const std::string& technique : techniques)
    picks.push_back(resolve_auto(scene_of(protocol, technique, {}), protocol.display_rate_hz));
  return *std::ranges::max_element(picks, {}, &SimulatorPick::rate_hz);
}

}  // namespace heft
