// One box of a ContactWorld. Its pose and velocity are authoritative; Bullet's body is written
// before the contact solver and read after it.
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <memory>

#include "base/PoseTypes.h"
#include "physics/scene/Scene.h"

namespace heft {

inline btVector3 to_bullet(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
inline Eigen::Vector3d from_bullet(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

/// A body without mass, at rest, without Bullet's gyroscopic term, which would be wrong for solver
/// masses that include a spring.
std::unique_ptr<btRigidBody> make_bullet_body();

struct RigidBox {
  Eigen::Vector3d size_m = Eigen::Vector3d::Ones();
  Pose pose;
  Velocity velocity;
  double mass_kg = 0;                    ///< 0: contacts do not change its velocity
  std::optional<double> table_friction;  ///< on the table; none: the world's
  bool solid = true;                     ///< false: touches nothing
  bool driven = false;                   ///< true: weightless, never at rest
  double still_s = 0;                    ///< time since it last moved noticeably
  bool at_rest = false;
  std::unique_ptr<btRigidBody> body;

  /// Zero inertia: contacts do not rotate it.
  void set_mass(double kg, const Eigen::Vector3d& inertia_kg_m2);
  void wake() {
    at_rest = false;
    still_s = 0;
  }
  /// Sets pose and velocity and wakes the box.
  void put(const Pose& to, const Velocity& at);
  /// Moves at its velocity for h_s seconds.
  void move(double h_s);

  void write_body();
  /// Reads the velocity, and the pose only if the solver has separated overlapping boxes, so that
  /// otherwise the pose keeps its bits.
  void read_body();
};

}  // namespace heft
