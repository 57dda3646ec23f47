// The rule behind the simulator `auto`: the cheapest that stays within a tolerance as far as is
// known. What a hand will do is not known beforehand, so there is a ladder of two: `push`, exact
// for a straight push at one cube, then `boxes`, which models everything, at the lowest rate that
// kept the tolerance on hands as they are. Whoever runs a scene climbs when a simulator throws
// OutsideModel, and starts over, so that all output is of one simulator; nobody climbs down.
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
  double rate_hz = 240;  ///< steps a second, at least
  std::string why;       ///< one line for people: it ...
};

/// How far off a simulator is on hands as they are: what 99.75 % of the random scenes of
/// `heft bench physics` stay within (results/physics/hands.csv), all four together in 99.5 %.
struct KnownError {
  std::string_view simulator;
  double rate_hz;
  Tolerance within;
};

/// The cheaper simulator first, each one's rates ascending.
std::span<const KnownError> known_errors();

/// Whether the simulator knows contacts that give, or the scene's are rigid.
bool models_contacts(std::string_view simulator, const Scene& scene);

/// One line for people: "auto takes boxes at 240 Hz: it models everything, known to be ...".
std::string described(const SimulatorPick& pick);

/// At least one; the last models everything. Where no rate stays within the scene's tolerance, it
/// is the highest there is, and says so.
/// @param at_least_hz poses a second; fewer steps are never made
std::vector<SimulatorPick> simulator_ladder(const Scene& scene, double at_least_hz);

/// For sessions, where a person may do anything: the ladder's first that models everything. Depends
/// on nothing that happens later.
SimulatorPick resolve_auto(const Scene& scene, double at_least_hz);

/// What resolve_auto picks for a scene with the paper's springs. It steps as it is told: whoever
/// wants the rate too asks resolve_auto.
std::unique_ptr<DecouplingSimulator> make_auto();

}  // namespace heft
