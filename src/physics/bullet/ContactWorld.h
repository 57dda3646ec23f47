// Boxes on a table, stepped with Bullet's rigid bodies and contact solver. The solver is called
// directly rather than through Bullet's world, so that nothing happens behind our back: no fixed
// substep, no sleeping thresholds made for meter-sized bodies, no multiplied friction, no order of
// pairs that depends on addresses. Bodies and pairs keep the order they were added in, and all
// contacts are found anew each step, some millimeters before the boxes meet.
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

#include <memory>
#include <vector>

#include "physics/bullet/RigidBox.h"
#include "physics/scene/BoxContacts.h"

namespace heft {

/// Bullet's sequential impulse solver with Coulomb's friction disk in place of its pyramid, which
/// holds a body up to sqrt(2) times too hard at 45 degrees. Friction starts from the last step's
/// impulses as the normal forces do; Bullet's own starts from zero each step.
class DiskFrictionSolver : public btSequentialImpulseConstraintSolver {
 protected:
  /// Needs two friction directions per contact (SOLVER_USE_2_FRICTION_DIRECTIONS) and no joints.
  /// @return the largest squared change of a contact velocity, m^2/s^2: Bullet stops iterating when
  ///   it falls below m_leastSquaresResidualThreshold
  btScalar solveSingleIteration(int iteration, btCollisionObject** bodies, int n_bodies,
                                btPersistentManifold** manifolds, int n_manifolds,
                                btTypedConstraint** joints, int n_joints,
                                const btContactSolverInfo& info, btIDebugDraw* drawer) override;

  btScalar solveGroupCacheFriendlySetup(btCollisionObject** bodies, int n_bodies,
                                        btPersistentManifold** manifolds, int n_manifolds,
                                        btTypedConstraint** joints, int n_joints,
                                        const btContactSolverInfo& info,
                                        btIDebugDraw* drawer) override;

 private:
  btScalar solve_friction(btSolverConstraint& first, btSolverConstraint& second, btScalar limit);
};

class ContactWorld {
 public:
  ContactWorld(double friction, double gravity_m_s2);

  /// @return its index
  std::size_t add(const Eigen::Vector3d& size_m, const Pose& pose);
  RigidBox& box(std::size_t i) { return boxes_[i]; }
  const RigidBox& box(std::size_t i) const { return boxes_[i]; }
  std::size_t size() const { return boxes_.size(); }

  /// Adds gravity to what is not driven, then changes velocities so that nothing overlaps at the
  /// end of a step of h_s seconds, with friction. Where boxes overlap already, moves them apart a
  /// little.
  void solve(double h_s);

  /// Lets boxes that have been calm for a while, away from what moves, rest until touched.
  void settle(double h_s);

  /// Mean force of `pusher` on `pushed` over the last step, N; zero if they don't touch.
  Eigen::Vector3d force_n(std::size_t pusher, std::size_t pushed) const;

  /// Forgets the contacts that a box has had, and wakes what it touched.
  void forget_contacts(std::size_t i);

 private:
  // One pair of boxes, or a box (first) and the table.
  struct Pair {
    std::size_t first, second;
    std::unique_ptr<btPersistentManifold> manifold;
  };

  bool moves(const RigidBox& box) const { return box.solid && !box.at_rest; }
  double farthest_approach_m(double h_s) const;
  Contact contact(const Pair& pair, double margin_m) const;
  bool may_touch(const Pair& pair) const;
  void wake_touched(double margin_m);
  void renew(Pair& pair, const Contact& contact, double impulse_scale);
  void run_solver(btAlignedObjectArray<btPersistentManifold*>& touching, double h_s);
  const Pair& pair(std::size_t i, std::size_t j) const;

  double friction_, gravity_m_s2_;
  double last_h_s_ = 0;
  std::vector<RigidBox> boxes_;
  std::unique_ptr<btRigidBody> table_;
  std::vector<Pair> pairs_;  ///< each box with the boxes before it, then with the table
  DiskFrictionSolver solver_;
  btContactSolverInfo info_;
};

}  // namespace heft
