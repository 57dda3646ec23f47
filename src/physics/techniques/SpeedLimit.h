// The technique `speed_limit`. While the clone touches cubes of mass m together it goes straight
// towards the hand, no faster than v(m): of the way w that it is from the hand at the end of a step
// of h seconds there remains
//   max(0, |w| - v(m) h).
// A hand that pushes at speed u for t seconds is (u - v) t ahead, and the clone catches up with one
// that waits: mass is told by how fast a cube can be moved.
#pragma once

#include <Eigen/Core>

#include "base/files/Keys.h"
#include "physics/techniques/MassCurve.h"

namespace heft {

struct SpeedLimit {
  static constexpr std::string_view kind = "speed_limit";

  MassCurve of_mass;       ///< m/s
  double return_s = 0.05;  ///< of the way back, see DisplacedSimulator.h

  /// The displacement at the end of a step in which the hand moves.
  Eigen::Vector3d after(const Eigen::Vector3d& displacement_m, const Eigen::Vector3d& hand_moves_m,
                        double mass_kg, double h_s) const {
    const Eigen::Vector3d behind_m = displacement_m - hand_moves_m;
    const double can_go_m = of_mass.at(mass_kg) * h_s, way_m = behind_m.norm();
    return way_m > can_go_m ? Eigen::Vector3d(behind_m * (1 - can_go_m / way_m))
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
  visit(ConfigKey{"limit_m_s_of_mass", "how fast the clone may go", true}, law.of_mass,
        Range{0, 100});
  visit(ConfigKey{"return_s", "time constant of the way back"}, law.return_s, above_zero);
}

}  // namespace heft
