// The table of simulators.
#include "physics/DecouplingSimulator.h"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "base/Names.h"
#include "physics/auto/Choice.h"

namespace heft {

std::unique_ptr<DecouplingSimulator> make_boxes();
std::unique_ptr<DecouplingSimulator> make_bullet_ea();
std::unique_ptr<DecouplingSimulator> make_bullet_x();
std::unique_ptr<DecouplingSimulator> make_bullet_lx();
std::unique_ptr<DecouplingSimulator> make_push();
std::unique_ptr<DecouplingSimulator> make_quasi_static();

namespace {
// Simulators that fail, for studies: see linked_simulator.
constexpr MakeSimulator only_for_studies = nullptr;
constexpr int boxes_edition = 8;  // also of `auto`, which uses it

constexpr Fitness everything{true, true, true, true, true};
constexpr Fitness rigid{.straight = true, .coupled = true, .turning = true, .several_cubes = true};
constexpr Fitness locked{.straight = true, .coupled = true, .several_cubes = true};
constexpr Fitness one_push{.straight = true, .coupled = true};
constexpr Fitness nothing{};

constexpr auto listed = std::to_array<SimulatorEntry>({
    {"boxes",
     "the default: a contact solver for a few boxes on a table, exact coupling, Coulomb friction "
     "disk",
     make_boxes, everything, "", true, boxes_edition},
    {"bullet", "the same as bullet-lx", make_bullet_lx, locked, "", true, 2},
    {"bullet-lx", "exact coupling, orientation locked to the effector's", make_bullet_lx, locked,
     "", true, 2},
    {"bullet-ea", "coupling by implicit Euler, in translation and rotation", make_bullet_ea, rigid},
    {"bullet-x", "exact coupling, in translation and rotation", make_bullet_x, rigid, "", true, 2},
    {"push", "one straight push of one cube in closed form, without rotation", make_push, one_push,
     "", false},
    {"quasi_static", "the same without inertia: the lag is min(x_hand, mu M g / k)",
     make_quasi_static, one_push, "", false},
    {"auto", "push where it models the scene, else boxes", make_auto, everything, "", true,
     boxes_edition},
    {"bullet-explicit", "stock Bullet, force and torque once a step as the paper writes them",
     only_for_studies, nothing,
     "is unstable at every display rate: the paper's torsional spring needs steps below 0.1 ms"},
    {"bullet-explicit-held", "the same, held over Bullet's substeps of 1/240 s", only_for_studies,
     nothing, "is unstable: the force is set once a step and held over the substeps"},
    {"bullet-stable-pd", "stock Bullet, stable PD control", only_for_studies, nothing,
     "makes cubes feel too heavy: the lag is (1 + w h)^2 times too long, 1.7 times at 240 Hz"},
    {"bullet-exact-velocity", "stock Bullet, velocity set to the free oscillator's",
     only_for_studies, nothing,
     "makes cubes feel too heavy: the lag is e^(w h) times too long, 1.3 times at 240 Hz"},
    {"bullet-soft-rows", "stock Bullet, spring as soft constraint rows (ERP and CFM)",
     only_for_studies, nothing,
     "is unstable for small steps: with the paper's spring above 170 Hz"},
    {"bullet-spring2", "stock Bullet, btGeneric6DofSpring2Constraint", only_for_studies, nothing,
     "lowers the stiffness without warning: the lag is 1.4 times too long at 240 Hz, 20 times at "
     "60 Hz"},
});
}  // namespace

[[gnu::weak]] MakeSimulator linked_simulator(std::string_view) {
  return nullptr;
}

std::span<const SimulatorEntry> simulators() {
  static const auto table = [] {
    auto entries = listed;
    for (SimulatorEntry& entry : entries)
      if (entry.make == only_for_studies) entry.make = linked_simulator(entry.name);
    return entries;
  }();
  return table;
}

const SimulatorEntry& simulator_named(std::string_view name) {
  const SimulatorEntry& entry = entry_named("simulator", name, simulators());
  if (entry.make == only_for_studies)
    throw OnlyForStudies(fmt::format("simulator {} {}; it is only in heft-bench, for studies",
                                     entry.name, entry.warning));
  return entry;
}

std::unique_ptr<DecouplingSimulator> make_simulator(std::string_view name) {
  return simulator_named(name).make();
}

}  // namespace heft
