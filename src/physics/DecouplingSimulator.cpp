// The table of simulators.
#include "physics/DecouplingSimulator.h"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "base/Error.h"
#include "base/Names.h"
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

std::unique_ptr<DecouplingSimulator> make_simulator(std::string_view name) {
  std::vector<std::string_view> names;
  for (const SimulatorEntry& entry : table) {
    if (entry.name == name) return entry.make();
    names.push_back(entry.name);
  }
  const auto nearest = nearest_name(name, names);
  throw Error(fmt::format("there is no simulator \"{}\"{}; expected {}", name,
                          nearest ? fmt::format(", did you mean \"{}\"?", *nearest) : "",
                          quoted_list(names)),
              ExitCode::usage);
}

}  // namespace heft
