#include "physics/bullet/ContactWorld.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>

namespace heft {

namespace {
// Missing velocity change along a row. m_rhs holds the target velocity here.
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

// Both directions use the same step size, the smaller of their effective masses, and the pair is
// projected to the disk, so that friction opposes the slip after convergence.
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
      row->m_rhs /= row->m_jacDiagABInv;  // an impulse in Bullet
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

namespace {
constexpr double still_m_s = 1e-4, still_rad_s = 5e-3, still_for_s = 0.25;
// Margin of the contact detection in addition to the boxes' motion in a step.
constexpr double look_ahead_m = 0.2e-3;
}  // namespace

ContactWorld::ContactWorld(double friction, double gravity_m_s2)
    : friction_(friction), gravity_m_s2_(gravity_m_s2), table_(make_bullet_body()) {
  info_.m_solverMode = SOLVER_USE_WARMSTARTING | SOLVER_USE_2_FRICTION_DIRECTIONS |
                       SOLVER_ENABLE_FRICTION_DIRECTION_CACHING |
                       SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION;
  info_.m_warmstartingFactor = 1;
  info_.m_splitImpulsePenetrationThreshold = 0;
  info_.m_numIterations = 300;
  info_.m_leastSquaresResidualThreshold = 1e-10;  // (10 um/s)^2
}

std::size_t ContactWorld::add(const Eigen::Vector3d& size_m, const Pose& pose) {
  const std::size_t index = boxes_.size();
  RigidBox& box = boxes_.emplace_back();
  box.size_m = size_m;
  box.pose = pose;
  box.body = make_bullet_body();
  box.body->setWorldArrayIndex(static_cast<int>(index));
  constexpr double any_distance = std::numeric_limits<double>::max();
  const auto add_pair = [&](std::size_t second, const btRigidBody& body) {
    pairs_.push_back({index, second,
                      std::make_unique<btPersistentManifold>(box.body.get(), &body, 0, any_distance,
                                                             any_distance)});
  };
  for (std::size_t i = 0; i < index; ++i) add_pair(i, *boxes_[i].body);
  add_pair(index, *table_);
  return index;
}

const ContactWorld::Pair& ContactWorld::pair(std::size_t i, std::size_t j) const {
  const auto [low, high] = std::minmax(i, j);
  return pairs_[high * (high + 1) / 2 + low];
}

// An impact may make any box as fast as the fastest.
double ContactWorld::farthest_approach_m(double h_s) const {
  double fastest_m_s = 0;
  for (const RigidBox& box : boxes_) {
    if (!moves(box)) continue;
    const double tip_m_s = box.velocity.angular_rad_s.norm() * box.size_m.norm() / 2;
    fastest_m_s = std::max(fastest_m_s, box.velocity.linear_m_s.norm() + tip_m_s);
  }
  return look_ahead_m + 2 * h_s * fastest_m_s;
}

Contact ContactWorld::contact(const Pair& pair, double margin_m) const {
  const RigidBox& first = boxes_[pair.first];
  const RigidBox& second = boxes_[pair.second];
  const Box box = box_at(first.pose, first.size_m);
  if (&first == &second) return contact_with_table(box, margin_m);
  return contact_between(box, box_at(second.pose, second.size_m), margin_m);
}

void ContactWorld::wake_touched(double margin_m) {
  for (bool woken = true; woken;) {
    woken = false;
    for (const Pair& pair : pairs_) {
      RigidBox& first = boxes_[pair.first];
      RigidBox& second = boxes_[pair.second];
      if (moves(first) == moves(second) || !first.solid || !second.solid) continue;
      if (contact(pair, margin_m).n_points == 0) continue;
      first.wake();
      second.wake();
      woken = true;
    }
  }
}

// Writes the contact to the pair's manifold. Points that are known keep their impulses as a warm
// start.
void ContactWorld::renew(Pair& pair, const Contact& contact, double impulse_scale) {
  btPersistentManifold& manifold = *pair.manifold;
  std::array<btManifoldPoint, 4> old;
  const int n_old = manifold.getNumContacts();
  for (int i = 0; i < n_old; ++i) old[static_cast<std::size_t>(i)] = manifold.getContactPoint(i);
  manifold.clearManifold();
  const btVector3 normal = to_bullet(contact.normal);
  const bool with_table = pair.first == pair.second;
  const double friction =
      with_table ? boxes_[pair.first].table_friction.value_or(friction_) : friction_;
  for (const ContactPoint& at : contact.all()) {
    btManifoldPoint point(btVector3(0, 0, 0), btVector3(0, 0, 0), normal, at.distance_m);
    point.m_positionWorldOnA = to_bullet(at.on_first_m);
    point.m_positionWorldOnB = to_bullet(at.on_second_m);
    point.m_combinedFriction = friction;
    point.m_index0 = at.feature;
    btPlaneSpace1(normal, point.m_lateralFrictionDir1, point.m_lateralFrictionDir2);
    point.m_contactPointFlags = BT_CONTACT_FLAG_LATERAL_FRICTION_INITIALIZED;
    const auto before = std::find_if(old.begin(), old.begin() + n_old,
                                     [&](const auto& o) { return o.m_index0 == at.feature; });
    if (before != old.begin() + n_old) {
      point.m_appliedImpulse = before->m_appliedImpulse * impulse_scale;
      point.m_appliedImpulseLateral1 = before->m_appliedImpulseLateral1 * impulse_scale;
      point.m_appliedImpulseLateral2 = before->m_appliedImpulseLateral2 * impulse_scale;
    }
    manifold.addManifoldPoint(point);
  }
}

// Whether a pair needs contact detection. Resting boxes within reach of moving ones are awake
// already.
bool ContactWorld::may_touch(const Pair& pair) const {
  const RigidBox& first = boxes_[pair.first];
  const RigidBox& second = boxes_[pair.second];
  const bool movable = first.mass_kg > 0 || (pair.first != pair.second && second.mass_kg > 0);
  return movable && moves(first) && moves(second);
}

void ContactWorld::solve(double h_s) {
  wake_touched(farthest_approach_m(h_s));
  for (RigidBox& box : boxes_)
    if (!box.driven && !box.at_rest) box.velocity.linear_m_s.z() -= h_s * gravity_m_s2_;
  const double margin_m = farthest_approach_m(h_s);

  btAlignedObjectArray<btPersistentManifold*> touching;
  const double impulse_scale = last_h_s_ > 0 ? h_s / last_h_s_ : 1;
  for (Pair& pair : pairs_) {
    const bool both_rest = boxes_[pair.first].at_rest && boxes_[pair.second].at_rest;
    if (both_rest) continue;  // keeps its impulses
    renew(pair, may_touch(pair) ? contact(pair, margin_m) : Contact{}, impulse_scale);
    if (pair.manifold->getNumContacts() > 0) touching.push_back(pair.manifold.get());
  }
  last_h_s_ = h_s;
  if (touching.size() > 0) run_solver(touching, h_s);
}

void ContactWorld::run_solver(btAlignedObjectArray<btPersistentManifold*>& touching, double h_s) {
  btAlignedObjectArray<btCollisionObject*> bodies;
  for (RigidBox& box : boxes_) {
    if (!moves(box)) continue;
    box.write_body();
    bodies.push_back(box.body.get());
  }
  info_.m_timeStep = h_s;
  solver_.solveGroup(&bodies[0], bodies.size(), &touching[0], touching.size(), nullptr, 0, info_,
                     nullptr, nullptr);
  for (RigidBox& box : boxes_)
    if (moves(box) && box.mass_kg > 0) box.read_body();
}

void ContactWorld::settle(double h_s) {
  for (RigidBox& box : boxes_) {
    const bool still = !box.driven && box.velocity.linear_m_s.norm() < still_m_s &&
                       box.velocity.angular_rad_s.norm() < still_rad_s;
    box.still_s = still ? box.still_s + h_s : 0;
  }
  for (const Pair& pair : pairs_) {
    if (pair.manifold->getNumContacts() == 0) continue;
    double& first_s = boxes_[pair.first].still_s;
    double& second_s = boxes_[pair.second].still_s;
    first_s = second_s = std::min(first_s, second_s);
  }
  for (RigidBox& box : boxes_) {
    if (box.at_rest || box.still_s < still_for_s) continue;
    box.at_rest = true;
    box.velocity = {};
  }
}

Eigen::Vector3d ContactWorld::force_n(std::size_t pusher, std::size_t pushed) const {
  const btPersistentManifold& manifold = *pair(pusher, pushed).manifold;
  btVector3 impulse(0, 0, 0);
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& point = manifold.getContactPoint(i);
    impulse += point.m_appliedImpulse * point.m_normalWorldOnB +
               point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
               point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2;
  }
  // The manifold's impulse is on the box that was added later.
  if (last_h_s_ == 0) return Eigen::Vector3d::Zero();
  return from_bullet(impulse) * ((pushed > pusher ? 1 : -1) / last_h_s_);
}

void ContactWorld::forget_contacts(std::size_t i) {
  for (Pair& pair : pairs_) {
    if (pair.first != i && pair.second != i) continue;
    if (pair.manifold->getNumContacts() > 0) {
      boxes_[pair.first].wake();
      boxes_[pair.second].wake();
    }
    pair.manifold->clearManifold();
  }
}

}  // namespace heft
