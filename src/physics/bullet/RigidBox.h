// One box of a ContactWorld. Its pose and velocity are the truth; Bullet's body is filled from them
// for the contact solver and read back after it.
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

/// A body without mass, at rest. No gyroscopic term: it would not know that our masses can hold a
/// spring.
std::unique_ptr<btRigidBody> make_bullet_body();

struct RigidBox {
  Eigen::Vector3d size_m = Eigen::Vector3d::Ones();
  Pose pose;
  Velocity velocity;
  double mass_kg = 0;   ///< 0: moves as its velocity says, whatever touches it
  bool solid = true;    ///< false: touches nothing
  bool driven = false;  ///< true: has no weight and never rests
  double still_s = 0;   ///< for how long it has not moved noticeably
  bool at_rest = false;
  std::unique_ptr<btRigidBody> body;

  /// Zero inertia: nothing turns it.
  void set_mass(double kg, const Eigen::Vector3d& inertia_kg_m2);
  void wake() {
    at_rest = false;
    still_s = 0;
  }
  /// Wakes it, too.
  void put(const Pose& to, const Velocity& at);
  /// Goes on at its velocity for h_s seconds.
  void move(double h_s);

  void write_body();
  /// Takes the velocity; and the pose only where the solver has pushed overlapping boxes apart, so
  /// that otherwise it keeps its bits.
  void read_body();
};

}  // namespace heft
