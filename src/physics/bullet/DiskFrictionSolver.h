// Bullet's sequential impulse solver with Coulomb's friction disk in place of its pyramid, which
// holds a body up to sqrt(2) times too hard at 45 degrees. Friction starts from the last step's
// impulses as the normal forces do; Bullet's own starts from zero each step.
#pragma once

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

namespace heft {

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

}  // namespace heft
