#include "physics/auto/Choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "physics/auto/ErrorTable.h"

namespace heft {

namespace {
using Classes = std::vector<SceneClass>;

// What a hand may do in the scene, as far as a simulator models it: others refuse the rest.
Classes classes_asked(const Scene& scene, bool of_a_general_simulator) {
  if (scene.cubes.empty()) return {SceneClass::free_air};
  Classes classes{SceneClass::free_air, SceneClass::push, SceneClass::press};
  if (!of_a_general_simulator) return classes;
  classes.insert(classes.end(), {SceneClass::turn, SceneClass::rough});
  if (scene.cubes.size() > 1) classes.push_back(SceneClass::several);
  return classes;
}

// The table is for the paper's springs. What counts is how far a spring swings in a step: a faster
// one needs shorter steps for the same error. A slower one is left with the table's.
double hurry(const Scene& scene) {
  const auto omega_rad_s = [](const Coupling& coupling) {
    return std::sqrt(coupling.stiffness_n_per_m / coupling.clone_mass_kg);
  };
  return std::max(1.0, omega_rad_s(scene.coupling) / omega_rad_s(Coupling{}));
}

struct Worst {
  double clone_rms_m = 0, lag_g = 0;
  bool within(const Tolerance& tolerance) const {
    return clone_rms_m <= tolerance.clone_rms_m && lag_g <= tolerance.lag_g;
  }
};

// None where the table does not know all of the classes.
std::optional<Worst> worst_of(std::string_view simulator, double rate_hz, const Classes& classes) {
  Worst worst;
  for (SceneClass scene_class : classes) {
    const auto known = std::ranges::find_if(known_errors(), [&](const KnownError& error) {
      return error.simulator == simulator && error.rate_hz == rate_hz &&
             error.scene_class == scene_class;
    });
    if (known == known_errors().end()) return std::nullopt;
    worst.clone_rms_m = std::max(worst.clone_rms_m, 1e-3 * known->clone_rms_mm);
    worst.lag_g = std::max(worst.lag_g, known->lag_g);
  }
  return worst;
}

std::vector<double> rates_of(std::string_view simulator) {
  std::vector<double> rates_hz;
  for (const KnownError& error : known_errors())
    if (error.simulator == simulator) rates_hz.push_back(error.rate_hz);
  std::ranges::sort(rates_hz);
  rates_hz.erase(std::unique(rates_hz.begin(), rates_hz.end()), rates_hz.end());
  return rates_hz;
}

struct Rung {
  SimulatorPick pick;
  Worst worst;
  bool general = true;
};

std::string what_is_known(const Worst& worst, const Tolerance& tolerance) {
  return fmt::format(
      "known to be within {:.2g} mm RMS and {:.2g} g (asked for: {:.2g} mm and "
      "{:.2g} g)",
      1e3 * worst.clone_rms_m, worst.lag_g, 1e3 * tolerance.clone_rms_m, tolerance.lag_g);
}

// Every rate of a simulator that is fast enough for the poses, or else its highest.
std::vector<Rung> rungs_of(std::string_view simulator, const Scene& scene, double at_least_hz) {
  const bool general = simulator_named(simulator).for_sessions;
  const Classes classes = classes_asked(scene, general);
  std::vector<Rung> rungs;
  const std::vector<double> rates_hz = rates_of(simulator);
  for (double rate_hz : rates_hz) {
    const double scaled_hz = std::ceil(rate_hz * hurry(scene));
    const auto worst = worst_of(simulator, rate_hz, classes);
    if (!worst || (scaled_hz < at_least_hz && rate_hz != rates_hz.back())) continue;
    const std::string model = general ? "models everything" : "models a straight push at one cube";
    rungs.push_back({{std::string(simulator), std::max(scaled_hz, at_least_hz),
                      model + ", " + what_is_known(*worst, scene.tolerance)},
                     *worst,
                     general});
  }
  return rungs;
}

SimulatorPick most_accurate(std::vector<Rung> rungs, const Tolerance& tolerance) {
  Rung best = *std::ranges::min_element(rungs, {}, [&](const Rung& rung) {
    return std::max(rung.worst.clone_rms_m / tolerance.clone_rms_m,
                    rung.worst.lag_g / tolerance.lag_g);
  });
  best.pick.why += ": the most accurate there is, and MISSES the tolerance";
  return best.pick;
}
}  // namespace

bool models_contacts(std::string_view simulator, const Scene& scene) {
  return scene.contact_compliance_m_per_n == 0 || simulator == "boxes" || simulator == "auto";
}

std::string described(const SimulatorPick& pick) {
  return fmt::format("auto takes {} at {:g} Hz: it {}", pick.simulator, pick.rate_hz, pick.why);
}

std::vector<SimulatorPick> simulator_ladder(const Scene& scene, double at_least_hz) {
  std::vector<SimulatorPick> ladder;
  std::vector<Rung> general;
  for (std::string_view simulator : ladder_of_simulators) {
    if (!models_contacts(simulator, scene)) continue;
    const std::vector<Rung> rungs = rungs_of(simulator, scene, at_least_hz);
    const auto cheapest = std::ranges::find_if(
        rungs, [&](const Rung& rung) { return rung.worst.within(scene.tolerance); });
    if (cheapest != rungs.end()) ladder.push_back(cheapest->pick);
    if (cheapest != rungs.end() && cheapest->general) return ladder;
    for (const Rung& rung : rungs)
      if (rung.general) general.push_back(rung);
  }
  ladder.push_back(most_accurate(std::move(general), scene.tolerance));
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
