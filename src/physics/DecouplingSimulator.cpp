// The table of simulators.
#include "physics/DecouplingSimulator.h"

#include <array>
#include <vector>

#include "base/PlugTable.h"
#include "physics/bullet/BulletSimulator.h"

namespace heft {

namespace {
constexpr std::array<SimulatorEntry, 4> table{{
    {"bullet", "the default: bullet-lx", make_bullet_lx},
    {"bullet-lx", "exact coupling, orientation locked to the effector's", make_bullet_lx},
    {"bullet-ea", "coupling by implicit Euler, in translation and rotation", make_bullet_ea},
    {"bullet-x", "exact coupling, in translation and rotation", make_bullet_x},
}};
}  // namespace

std::span<const SimulatorEntry> simulators() {
  return table;
}

const SimulatorEntry& simulator_named(std::string_view name) {
  return entry_named("simulator", name, simulators());
}

std::unique_ptr<DecouplingSimulator> make_simulator(std::string_view name) {
  return simulator_named(name).make();
}

}  // namespace heft
