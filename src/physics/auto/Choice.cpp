#include "physics/auto/Choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace heft {

namespace {
constexpr auto table = std::to_array<KnownError>({
#include "physics/auto/ErrorTable.inc"
});

// The table is for the paper's springs. The error depends on the oscillator's phase per step, so a
// faster oscillator needs shorter steps. A slower one uses the table unchanged.
double times_faster(const Scene& scene) {
  const auto omega_rad_s = [](const Coupling& coupling) {
    return std::sqrt(coupling.stiffness_n_per_m / coupling.clone_mass_kg);
  };
  return std::max(1.0, omega_rad_s(scene.coupling) / omega_rad_s(Coupling{}));
}

bool keeps(const Tolerance& known, const Tolerance& asked) {
  return known.clone_rms_m <= asked.clone_rms_m && known.lag_g <= asked.lag_g &&
         known.cubes_rms_m <= asked.cubes_rms_m && known.turn_rms_rad <= asked.turn_rms_rad;
}

std::string text_of_rest(const Tolerance& tolerance) {
  return fmt::format("cubes {:.2g} mm, turns {:.2g} degrees", 1e3 * tolerance.cubes_rms_m,
                     tolerance.turn_rms_rad * 180 / M_PI);
}

SimulatorPick pick_of(const KnownError& known, const Scene& scene, double at_least_hz) {
  const bool kept = keeps(known.within, scene.tolerance);
  const bool general = simulator_named(known.simulator).for_sessions;
  return {std::string(known.simulator),
          std::max(std::ceil(known.rate_hz * times_faster(scene)), at_least_hz),
          fmt::format("models {}, known to be within {:.2g} mm RMS and {:.2g} g, {} (asked for: "
                      "{:.2g} mm and {:.2g} g, {}){}",
                      general ? "everything" : "a straight push of one cube",
                      1e3 * known.within.clone_rms_m, known.within.lag_g,
                      text_of_rest(known.within), 1e3 * scene.tolerance.clone_rms_m,
                      scene.tolerance.lag_g, text_of_rest(scene.tolerance),
                      kept ? "" : ": the most accurate available, but NOT within the tolerance")};
}
}  // namespace

std::span<const KnownError> known_errors() {
  return table;
}

bool models_contacts(std::string_view simulator, const Scene& scene) {
  return scene.contact_compliance_m_per_n == 0 || simulator == "boxes" || simulator == "auto";
}

std::string described(const SimulatorPick& pick) {
  return fmt::format("auto takes {} at {:g} Hz: it {}", pick.simulator, pick.rate_hz, pick.why);
}

std::vector<SimulatorPick> simulator_ladder(const Scene& scene, double at_least_hz) {
  std::vector<SimulatorPick> ladder;
  const auto add_cheapest = [&](std::string_view simulator) {
    for (const KnownError& known : table)
      if (known.simulator == simulator && keeps(known.within, scene.tolerance))
        return void(ladder.push_back(pick_of(known, scene, at_least_hz)));
  };
  if (models_contacts("push", scene)) add_cheapest("push");
  add_cheapest("boxes");
  if (ladder.empty() || ladder.back().simulator != "boxes")
    ladder.push_back(pick_of(table.back(), scene, at_least_hz));
  return ladder;
}

SimulatorPick resolve_auto(const Scene& scene, double at_least_hz) {
  return simulator_ladder(scene, at_least_hz).back();
}

std::unique_ptr<DecouplingSimulator> make_auto() {
  Scene scene;
  scene.cubes.resize(3);
  return make_simulator(resolve_auto(scene, 0).simulator);
}

}  // namespace heft
