// The rule of the simulator `auto`: the cheapest simulator whose known errors are within a
// tolerance. The hand's movement is not known in advance, so there is a ladder of two: `push`,
// exact for a straight push of one cube, then `boxes`, which models everything, at the lowest rate
// within the tolerance for simulated hands. When a simulator throws OutsideModel, the caller
// restarts the scene with the next one, so that all output is from one simulator.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "physics/DecouplingSimulator.h"

namespace heft {

struct SimulatorPick {
  std::string simulator;
  double rate_hz = 240;  ///< lower bound of the physics rate
  std::string why;       ///< reason, as a predicate: "models everything, ..."
};

/// Errors of a simulator for simulated hands: 99.75 % quantiles over the random scenes of
/// `heft bench physics` (results/physics/hands.csv); 99.5 % of the scenes are within all four.
struct KnownError {
  std::string_view simulator;
  double rate_hz;
  Tolerance within;
};

/// By cost: the cheaper simulator first, rates ascending.
std::span<const KnownError> known_errors();

/// Whether the simulator models the scene's contact compliance.
bool models_contacts(std::string_view simulator, const Scene& scene);

/// "auto takes boxes at 240 Hz: it models everything, known to be ..."
std::string described(const SimulatorPick& pick);

/// At least one; the last models everything. If no rate is within the scene's tolerance, the last
/// is the most accurate one, and its reason reports that.
/// @param at_least_hz lower bound of the rate, such as the rate of the poses
std::vector<SimulatorPick> simulator_ladder(const Scene& scene, double at_least_hz);

/// For sessions: the first of the ladder that models everything.
SimulatorPick resolve_auto(const Scene& scene, double at_least_hz);

/// The simulator that resolve_auto picks for a scene with the paper's springs. The caller chooses
/// the rate.
std::unique_ptr<DecouplingSimulator> make_auto();

}  // namespace heft
