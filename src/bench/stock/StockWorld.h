// A scene as one builds it on Bullet's own world, solver and contacts, with the settings that
// people find they need. The variants in StockSimulators.h run on it; our own schemes use
// ContactWorld.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "physics/Scene.h"
#include "physics/WorldState.h"

namespace heft {

class StockWorld {
 public:
  /// The clone is kinematic where the scene's coupling is not decoupled.
  StockWorld(const Scene& scene, const Pose& clone);
  ~StockWorld();
  StockWorld(const StockWorld&) = delete;
  StockWorld& operator=(const StockWorld&) = delete;

  btRigidBody& clone() { return *bodies_[clone_index]; }
  const btRigidBody& clone() const { return *bodies_[clone_index]; }
  btDiscreteDynamicsWorld& bullet() { return world_; }
  /// Of the clone about its own axes, whether it is kinematic or not.
  const Eigen::Vector3d& clone_inertia_kg_m2() const { return clone_inertia_kg_m2_; }

  /// One step of exactly h_s seconds.
  void step(double h_s);

  void put_clone(const Pose& pose, const Velocity& velocity) { put(clone_index, pose, velocity); }
  void put_cube(std::size_t cube, const Pose& pose) { put(cube_index(cube), pose, {}); }
  void set_clone_solid(bool solid);

  /// False, too, where anything is not finite.
  bool slower_than(double speed_m_s, double turn_rad_s) const;

  WorldState state() const;

 private:
  static constexpr std::size_t table_index = 0, clone_index = 1;
  static std::size_t cube_index(std::size_t cube) { return cube + 2; }

  btRigidBody& add(const Eigen::Vector3d& size_m, const Pose& pose, double mass_kg);
  void add_clone(const Scene& scene, const Pose& pose);
  void put(std::size_t index, const Pose& pose, const Velocity& velocity);
  Eigen::Vector3d force_on_n(const btRigidBody& cube) const;

  double friction_;  ///< of each surface: Bullet multiplies the two that touch
  double gravity_m_s2_, last_h_s_ = 0;
  Eigen::Vector3d clone_inertia_kg_m2_;
  std::vector<std::unique_ptr<btBoxShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;  ///< the table, the clone, the cubes
  btDefaultCollisionConfiguration configuration_;
  mutable btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
};

btTransform to_bullet(const Pose& pose);
Pose pose_of(const btRigidBody& body);
Velocity velocity_of(const btRigidBody& body);

}  // namespace heft
