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

std::string text_of(const Tolerance& tolerance) {
  return fmt::format("{:.2g} mm RMS and {:.2g} g (cubes {:.2g} mm, turns {:.2g} degrees)",
                     1e3 * tolerance.clone_rms_m, tolerance.lag_g, 1e3 * tolerance.cubes_rms_m,
                     tolerance.turn_rms_rad * 180 / M_PI);
}

Tolerance times_tolerance(double factor) {
  const Tolerance usual;
  return {factor * usual.clone_rms_m, factor * usual.lag_g, factor * usual.cubes_rms_m,
          factor * usual.turn_rms_rad};
}

std::string promise_of(double factor, const Tolerance& asked) {
  const Tolerance known = times_tolerance(factor);
  return "within " + text_of(known) +
         (keeps(known, asked) ? "" : ", which is NOT within the tolerance of " + text_of(asked));
}

SimulatorPick pick_of(const KnownError& known, const Scene& scene, double at_least_hz) {
  const Tolerance& asked = scene.tolerance;
  const std::string where_even = promise_of(known.even, asked);
  if (!known.uneven)  // exact at any rate
    return {std::string(known.simulator), at_least_hz,
            "models a straight push of one cube, " + where_even};
  const std::string why = fmt::format(
      "models everything; {0:g} % of simulated hands that push within 4 mm of the middle of "
      "cubes on the table are {1}; where hands turn by up to 35 degrees, push up to 30 mm beside "
      "the middle or move stacked cubes, {2}",
      100 * auto_share, where_even,
      scene.contact_compliance_m_per_n > 0
          ? fmt::format("{:g} % are ", 100 * auto_share) + promise_of(*known.uneven, asked)
          : "rigid contacts have no unique result (set contact_compliance_m_per_n)");
  return {std::string(known.simulator),
          std::max(std::ceil(auto_rate_hz * times_faster(scene)), at_least_hz), why};
}
}  // namespace

std::span<const KnownError> known_errors() {
  return table;
}

bool models_compliance(std::string_view simulator) {
  return simulator_named(simulator).fit_for.compliant;
}

std::string described(const SimulatorPick& pick) {
  return fmt::format("auto takes {} at {:g} Hz: it {}", pick.simulator, pick.rate_hz, pick.why);
}

std::vector<SimulatorPick> simulator_ladder(const Scene& scene, double at_least_hz) {
  std::vector<SimulatorPick> ladder;
  for (const KnownError& known : table)
    if (known.uneven || (keeps(times_tolerance(known.even), scene.tolerance) &&
                         scene.contact_compliance_m_per_n == 0))
      ladder.push_back(pick_of(known, scene, at_least_hz));
  return ladder;
}

SimulatorPick resolve_auto(const Scene& scene, double at_least_hz) {
  return simulator_ladder(scene, at_least_hz).back();
}

std::unique_ptr<DecouplingSimulator> make_auto() {
  return make_simulator(table.back().simulator);
}

}  // namespace heft
