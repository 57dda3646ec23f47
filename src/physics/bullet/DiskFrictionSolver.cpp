#include "physics/bullet/DiskFrictionSolver.h"

#include <initializer_list>

namespace heft {

namespace {
// Velocity along a row that its constraint still lacks. Our rows hold the wanted velocity in m_rhs.
btScalar missing_velocity(const btSolverConstraint& row, btSolverBody& a, btSolverBody& b) {
  const btScalar changed = row.m_contactNormal1.dot(a.internalGetDeltaLinearVelocity()) +
                           row.m_relpos1CrossNormal.dot(a.internalGetDeltaAngularVelocity()) +
                           row.m_contactNormal2.dot(b.internalGetDeltaLinearVelocity()) +
                           row.m_relpos2CrossNormal.dot(b.internalGetDeltaAngularVelocity());
  return row.m_rhs - changed;
}

void apply(btSolverConstraint& row, btSolverBody& a, btSolverBody& b, btScalar impulse) {
  const btScalar change = impulse - row.m_appliedImpulse;
  a.internalApplyImpulse(row.m_contactNormal1 * a.internalGetInvMass(), row.m_angularComponentA,
                         change);
  b.internalApplyImpulse(row.m_contactNormal2 * b.internalGetInvMass(), row.m_angularComponentB,
                         change);
  row.m_appliedImpulse = impulse;
}
}  // namespace

// Both directions take the same step size (the smaller of their effective masses), then the pair is
// scaled back to the disk: at the end friction points exactly against the sliding.
btScalar DiskFrictionSolver::solve_friction(btSolverConstraint& first, btSolverConstraint& second,
                                            btScalar limit) {
  btSolverBody& a = m_tmpSolverBodyPool[first.m_solverBodyIdA];
  btSolverBody& b = m_tmpSolverBodyPool[first.m_solverBodyIdB];
  const btScalar mass = btMin(first.m_jacDiagABInv, second.m_jacDiagABInv);
  const btScalar old_x = first.m_appliedImpulse, old_y = second.m_appliedImpulse;
  if (limit == 0 && old_x == 0 && old_y == 0) return 0;
  btScalar x = old_x + mass * missing_velocity(first, a, b);
  btScalar y = old_y + mass * missing_velocity(second, a, b);
  const btScalar length = btSqrt(x * x + y * y);
  if (length > limit) {
    x *= limit / length;
    y *= limit / length;
  }
  apply(first, a, b, x);
  apply(second, a, b, y);
  return ((x - old_x) * (x - old_x) + (y - old_y) * (y - old_y)) / (mass * mass);
}

btScalar DiskFrictionSolver::solveGroupCacheFriendlySetup(btCollisionObject** bodies, int n_bodies,
                                                          btPersistentManifold** manifolds,
                                                          int n_manifolds,
                                                          btTypedConstraint** joints, int n_joints,
                                                          const btContactSolverInfo& info,
                                                          btIDebugDraw* drawer) {
  const btScalar result = btSequentialImpulseConstraintSolver::solveGroupCacheFriendlySetup(
      bodies, n_bodies, manifolds, n_manifolds, joints, n_joints, info, drawer);
  for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i) {
    btSolverConstraint& normal = m_tmpSolverContactConstraintPool[i];
    const auto& point = *static_cast<btManifoldPoint*>(normal.m_originalContactPoint);
    btSolverBody& a = m_tmpSolverBodyPool[normal.m_solverBodyIdA];
    btSolverBody& b = m_tmpSolverBodyPool[normal.m_solverBodyIdB];
    btSolverConstraint* friction =
        &m_tmpSolverContactFrictionConstraintPool[normal.m_frictionIndex];
    for (btSolverConstraint* row : {&normal, friction, friction + 1})
      row->m_rhs /= row->m_jacDiagABInv;  // Bullet's is an impulse
    apply(friction[0], a, b, point.m_appliedImpulseLateral1);
    apply(friction[1], a, b, point.m_appliedImpulseLateral2);
  }
  return result;
}

btScalar DiskFrictionSolver::solveSingleIteration(int, btCollisionObject**, int,
                                                  btPersistentManifold**, int, btTypedConstraint**,
                                                  int, const btContactSolverInfo&, btIDebugDraw*) {
  btScalar residual = 0;
  for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i) {
    btSolverConstraint& normal = m_tmpSolverContactConstraintPool[i];
    btSolverBody& a = m_tmpSolverBodyPool[normal.m_solverBodyIdA];
    btSolverBody& b = m_tmpSolverBodyPool[normal.m_solverBodyIdB];
    const btScalar old = normal.m_appliedImpulse;
    apply(normal, a, b,
          btMax(btScalar(0), old + normal.m_jacDiagABInv * missing_velocity(normal, a, b)));
    const btScalar change = (normal.m_appliedImpulse - old) / normal.m_jacDiagABInv;
    residual = btMax(residual, change * change);
    residual =
        btMax(residual,
              solve_friction(m_tmpSolverContactFrictionConstraintPool[normal.m_frictionIndex],
                             m_tmpSolverContactFrictionConstraintPool[normal.m_frictionIndex + 1],
                             normal.m_friction * normal.m_appliedImpulse));
  }
  return residual;
}

}  // namespace heft
