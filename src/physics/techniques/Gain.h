// The technique `gain`, a control/display ratio. While the clone touches cubes of total mass m, it
// moves g(m) times as far as the hand at x, so that its displacement d from the hand is
//   d(t + h) = d(t) - (1 - g(m)) (x(t + h) - x(t)).
// After a push of s meters the clone is (1 - g) s behind, at any speed and friction. The cue to
// mass is the displayed fraction of the hand's movement.
#pragma once

#include <Eigen/Core>

#include "base/files/Keys.h"
#include "physics/techniques/MassCurve.h"

namespace heft {

struct Gain {
  static constexpr std::string_view kind = "gain";

  MassCurve of_mass;
  double return_s = 0.05;  ///< time constant of the return, see Displacement.h

  /// The displacement after a step in which the hand moves.
  Eigen::Vector3d after(const Eigen::Vector3d& displacement_m, const Eigen::Vector3d& hand_moves_m,
                        double mass_kg, double /*h_s*/) const {
    return displacement_m - (1 - of_mass.at(mass_kg)) * hand_moves_m;
  }
  /// For reports.
  std::string described() const { return displacement_text("gain", of_mass, "", return_s); }
};
template <typename Law, typename Visit>
requires ConfigOf<Law, Gain>
void visit_keys(Law& law, Visit&& visit) {
  visit(ConfigKey{"gain_of_mass", "clone movement per hand movement", true}, law.of_mass,
        Range{0, 10});
  visit(ConfigKey{"return_s", "time constant of the return"}, law.return_s, above_zero);
}

}  // namespace heft
