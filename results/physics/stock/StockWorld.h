// A scene on Bullet's own world, solver and contacts with customary settings, for the simulators of
// StockSimulators.h. Heft's schemes use ContactWorld.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "physics/DecouplingSimulator.h"
#include "physics/coupling/CouplingLaw.h"
#include "physics/scene/Scene.h"

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
  /// Of the clone about its axes, kinematic or not.
  const Eigen::Vector3d& clone_inertia_kg_m2() const { return clone_inertia_kg_m2_; }

  /// One step of exactly h_s seconds.
  void step(double h_s);

  void put_clone(const Pose& pose, const Velocity& velocity) { put(clone_index, pose, velocity); }
  void put_cube(std::size_t cube, const Pose& pose) { put(cube_index(cube), pose, {}); }
  void set_clone_solid(bool solid);

  /// False also if a value is not finite.
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

// Customary couplings of a body to a target in Bullet: forces before the step, or constraint rows
// in it. None includes the spring in the clone's solver mass, as physics/coupling/CouplingLaw.h
// does. Failures: see the factory functions.

/// One step of the target.
struct TargetStep {
  Pose from, to;
  double h_s = 0;
};

class StockCoupling {
 public:
  virtual ~StockCoupling() = default;
  /// Steps the world while the target moves.
  virtual void step(StockWorld& world, const TargetStep& target) = 0;
};

/// Makes a coupling for a world whose clone is not kinematic. The world outlives it.
using MakeStockCoupling = std::unique_ptr<StockCoupling> (*)(StockWorld&, const Coupling&);

/// F = -k d - c v once a step, as in the paper. Stable for steps below 2 (sqrt 2 - 1) / w.
std::unique_ptr<StockCoupling> explicit_force(StockWorld& world, const Coupling& coupling);

/// The same, held over Bullet's substeps of at most 1/240 s. Substeps do not improve stability,
/// because the force is set once a step.
std::unique_ptr<StockCoupling> held_force(StockWorld& world, const Coupling& coupling);

/// The force at the end of the step, position and velocity predicted with the clone's mass (stable
/// PD control, after Tan, Liu and Turk 2011, with the position implicit too). Contacts push a clone
/// of mass m where the law needs m (1 + w h)^2: the steady lag is that many times too long.
std::unique_ptr<StockCoupling> stable_pd(StockWorld& world, const Coupling& coupling);

/// The velocity that the free oscillator has at the end of the step. In contact the steady lag is
/// e^(w h) times too long; and a spring that comes to rest within a step, such as the paper's
/// torsional one, does not undo an offset, as at its end it no longer moves.
std::unique_ptr<StockCoupling> exact_velocity(StockWorld& world, const Coupling& coupling);

/// Constraint rows softened by error reduction h k / (h k + c) and force mixing 1 / (h (h k + c)).
/// Bullet's iteration lacks the mixing in its step size: it diverges for w h < sqrt 2 - 1.
std::unique_ptr<StockCoupling> soft_rows(StockWorld& world, const Coupling& coupling);

/// btGeneric6DofSpring2Constraint with its default limits, which lower stiffness and damping to the
/// stability limit of an explicit step.
std::unique_ptr<StockCoupling> six_dof_spring(StockWorld& world, const Coupling& coupling);

}  // namespace heft
