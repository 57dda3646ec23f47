// The rule of the simulator `auto`: `push`, exact for a straight push of one cube, where it models
// the scene; else `boxes`, which models everything. The hand's movement is not known in advance, so
// there is a ladder: when a simulator throws OutsideModel, the caller restarts the scene with the
// next one, so that all output is from one simulator. The rate is not chosen: near cubes `boxes`
// divides its steps anyway.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "physics/DecouplingSimulator.h"

namespace heft {

struct SimulatorPick {
  std::string simulator;
  double rate_hz = 240;  ///< lower bound of the physics rate
  std::string why;       ///< reason, as a predicate: "models everything; ..."
};

/// Errors of a simulator for simulated hands at auto_rate_hz, with the paper's spring, as multiples
/// of the default tolerance. auto_share of scenes are within them, by the random scenes of
/// `heft bench physics` (results/physics/promise.csv); the test AutoPromise tries others.
struct KnownError {
  std::string_view simulator;
  /// Hands that sway and tremble and push within 4 mm of the middle of cubes on the table.
  double even = 0;
  /// Hands that turn by up to 0.6 rad, push up to 30 mm beside the middle or move stacked cubes,
  /// with compliant contacts; none: such scenes are outside the model.
  std::optional<double> uneven;
};

inline constexpr double auto_rate_hz = 240, auto_share = 0.995;

/// Known errors, cheapest simulator first.
std::span<const KnownError> known_errors();

/// Whether a simulator models compliant contacts.
bool models_compliance(std::string_view simulator);

/// "auto takes boxes at 240 Hz: it models everything; known to be ..."
std::string described(const SimulatorPick& pick);

/// At least one; the last models everything. Its reason says where it is not within the scene's
/// tolerance.
/// @param at_least_hz lower bound of the rate, such as the rate of the poses
std::vector<SimulatorPick> simulator_ladder(const Scene& scene, double at_least_hz);

/// For sessions: the first of the ladder that models everything.
SimulatorPick resolve_auto(const Scene& scene, double at_least_hz);

/// The simulator that resolve_auto picks. The caller chooses the rate.
std::unique_ptr<DecouplingSimulator> make_auto();

}  // namespace heft
