// The technique `speed_limit`. While the clone touches cubes of total mass m, it moves straight
// towards the hand, at most at speed v(m): of its distance |w| from the hand, a step of h seconds
// leaves
//   max(0, |w| - v(m) h).
// A hand that pushes at speed u for t seconds is (u - v) t ahead, and the clone reaches a hand that
// waits. The cue to mass is the speed at which a cube can be moved.
#pragma once

#include <Eigen/Core>

#include "base/files/Keys.h"
#include "physics/techniques/MassCurve.h"

namespace heft {

struct SpeedLimit {
  static constexpr std::string_view kind = "speed_limit";

  MassCurve of_mass;       ///< m/s
  double return_s = 0.05;  ///< time constant of the return, see Displacement.h

  /// The displacement after a step in which the hand moves.
  Eigen::Vector3d after(const Eigen::Vector3d& displacement_m, const Eigen::Vector3d& hand_moves_m,
                        double mass_kg, double h_s) const {
    const Eigen::Vector3d behind_m = displacement_m - hand_moves_m;
    const double limit_m = of_mass.at(mass_kg) * h_s, distance_m = behind_m.norm();
    return distance_m > limit_m ? Eigen::Vector3d(behind_m * (1 - limit_m / distance_m))
                                : Eigen::Vector3d::Zero();
  }
  /// For reports.
  std::string described() const {
    return displacement_text("speed limit", of_mass, " m/s", return_s);
  }
};
template <typename Law, typename Visit>
requires ConfigOf<Law, SpeedLimit>
void visit_keys(Law& law, Visit&& visit) {
  visit(ConfigKey{"limit_m_s_of_mass", "largest speed of the clone", true}, law.of_mass,
        Range{0, 100});
  visit(ConfigKey{"return_s", "time constant of the return"}, law.return_s, above_zero);
}

}  // namespace heft
