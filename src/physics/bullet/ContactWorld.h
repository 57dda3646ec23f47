// Boxes on a table with Bullet's contact solver. The solver is called directly, not through
// Bullet's world, which has fixed substeps, sleeping thresholds for meter-sized bodies, multiplied
// friction coefficients, and an order of pairs that depends on addresses. Bodies and pairs keep the
// order in which they were added. Contacts are detected in every step, some millimeters before
// boxes meet.
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

#include <memory>
#include <vector>

#include "physics/bullet/RigidBox.h"
#include "physics/scene/BoxContacts.h"

namespace heft {

/// Bullet's sequential impulse solver with Coulomb's friction disk instead of a pyramid, whose
/// friction is up to sqrt(2) times too large at 45 degrees. Friction is warm-started like the
/// normal impulses; Bullet's starts from zero in each step.
class DiskFrictionSolver : public btSequentialImpulseConstraintSolver {
 protected:
  /// Needs two friction directions per contact (SOLVER_USE_2_FRICTION_DIRECTIONS) and no joints.
  /// @return the largest squared change of a contact velocity, m^2/s^2; Bullet stops iterating when
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

  /// Adds gravity to the boxes that are not driven, and solves contacts with friction, so that no
  /// boxes overlap after a step of h_s seconds. Separates overlapping boxes gradually.
  void solve(double h_s);

  /// Lets boxes rest that have not moved for a while and touch no moving box.
  void settle(double h_s);

  /// Mean force of `pusher` on `pushed` over the last step, N; zero without contact.
  Eigen::Vector3d force_n(std::size_t pusher, std::size_t pushed) const;

  /// Drops the contacts of a box and wakes the boxes that it touched.
  void forget_contacts(std::size_t i);

 private:
  // Two boxes, or one box and the table.
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
  std::vector<Pair> pairs_;  ///< each box with all earlier ones, then with the table
  DiskFrictionSolver solver_;
  btContactSolverInfo info_;
};

}  // namespace heft
