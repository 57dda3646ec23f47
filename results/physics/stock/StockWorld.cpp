#include "results/physics/stock/StockWorld.h"

#include <algorithm>
#include <cmath>

#include "base/PoseTypes.h"
#include "physics/bullet/RigidBox.h"

namespace heft {

namespace {
const Eigen::Vector3d table_size_m{4, 4, 0.2};
}  // namespace

btTransform to_bullet(const Pose& pose) {
  const auto& q = pose.orientation;
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), to_bullet(pose.position_m));
}

Pose pose_of(const btRigidBody& body) {
  const btQuaternion q = body.getOrientation();
  return {from_bullet(body.getCenterOfMassPosition()),
          Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z())};
}

Velocity velocity_of(const btRigidBody& body) {
  return {from_bullet(body.getLinearVelocity()), from_bullet(body.getAngularVelocity())};
}

StockWorld::StockWorld(const Scene& scene, const Pose& clone)
    : friction_(std::sqrt(scene.friction)),
      gravity_m_s2_(scene.gravity_m_s2),
      dispatcher_(&configuration_),
      world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
  btContactSolverInfo& info = world_.getSolverInfo();
  info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS | SOLVER_ENABLE_FRICTION_DIRECTION_CACHING |
                       SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION;
  info.m_splitImpulsePenetrationThreshold = 0;  // its default is deeper than a cube is high
  world_.setGravity({0, 0, -gravity_m_s2_});
  add(table_size_m, upright_pose({0, 0, -table_size_m.z() / 2}, 0), 0);
  add_clone(scene, clone);
  for (const Cube& cube : scene.cubes)
    add(cube.size_m, upright_pose(cube.position_m, cube.yaw_rad), cube.mass_kg);
  for (const auto& body : bodies_) world_.addRigidBody(body.get());
}

StockWorld::~StockWorld() {
  for (const auto& body : bodies_) world_.removeRigidBody(body.get());
}

btRigidBody& StockWorld::add(const Eigen::Vector3d& size_m, const Pose& pose, double mass_kg) {
  const auto& shape =
      shapes_.emplace_back(std::make_unique<btBoxShape>(to_bullet(Eigen::Vector3d(size_m / 2))));
  btVector3 inertia(0, 0, 0);
  if (mass_kg > 0) inertia = to_bullet(box_inertia_kg_m2(mass_kg, size_m));
  btRigidBody::btRigidBodyConstructionInfo info(mass_kg, nullptr, shape.get(), inertia);
  info.m_startWorldTransform = to_bullet(pose);
  info.m_friction = friction_;
  auto& body = bodies_.emplace_back(std::make_unique<btRigidBody>(info));
  body->setActivationState(DISABLE_DEACTIVATION);  // Bullet sleeps below 0.8 m/s
  return *body;
}

void StockWorld::add_clone(const Scene& scene, const Pose& pose) {
  const bool decoupled = scene.coupling.decoupled;
  clone_inertia_kg_m2_ = box_inertia_kg_m2(scene.coupling.clone_mass_kg, scene.effector_size_m);
  btRigidBody& body =
      add(scene.effector_size_m, pose, decoupled ? scene.coupling.clone_mass_kg : 0);
  body.setFlags(body.getFlags() | BT_DISABLE_WORLD_GRAVITY);
  if (!decoupled) body.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
}

// Without substeps, Bullet steps by exactly the given time.
void StockWorld::step(double h_s) {
  world_.stepSimulation(h_s, 0);
  last_h_s_ = h_s;
}

void StockWorld::put(std::size_t index, const Pose& pose, const Velocity& velocity) {
  btRigidBody& body = *bodies_[index];
  body.setCenterOfMassTransform(to_bullet(pose));
  body.setInterpolationWorldTransform(to_bullet(pose));
  body.setLinearVelocity(to_bullet(velocity.linear_m_s));
  body.setAngularVelocity(to_bullet(velocity.angular_rad_s));
  body.clearForces();
  broadphase_.getOverlappingPairCache()->cleanProxyFromPairs(body.getBroadphaseHandle(),
                                                             &dispatcher_);
}

void StockWorld::set_clone_solid(bool solid) {
  constexpr int no_response = btCollisionObject::CF_NO_CONTACT_RESPONSE;
  const int flags = clone().getCollisionFlags();
  clone().setCollisionFlags(solid ? flags & ~no_response : flags | no_response);
}

Eigen::Vector3d StockWorld::force_on_n(const btRigidBody& cube) const {
  btVector3 impulse(0, 0, 0);  // on the first body
  for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(i);
    const bool cube_first = manifold.getBody0() == &cube && manifold.getBody1() == &clone();
    const bool cube_second = manifold.getBody1() == &cube && manifold.getBody0() == &clone();
    if (!cube_first && !cube_second) continue;
    const btScalar sign = cube_first ? 1 : -1;
    for (int j = 0; j < manifold.getNumContacts(); ++j) {
      const btManifoldPoint& point = manifold.getContactPoint(j);
      impulse += sign * (point.m_appliedImpulse * point.m_normalWorldOnB +
                         point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
                         point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2);
    }
  }
  return last_h_s_ > 0 ? Eigen::Vector3d(from_bullet(impulse) / last_h_s_)
                       : Eigen::Vector3d::Zero();
}

bool StockWorld::slower_than(double speed_m_s, double turn_rad_s) const {
  return std::ranges::all_of(bodies_, [&](const auto& body) {
    const btVector3& at = body->getCenterOfMassPosition();
    return std::isfinite(at.x() + at.y() + at.z()) &&
           body->getLinearVelocity().length2() < speed_m_s * speed_m_s &&
           body->getAngularVelocity().length2() < turn_rad_s * turn_rad_s;
  });
}

WorldState StockWorld::state() const {
  WorldState state;
  state.clone = {pose_of(clone()), velocity_of(clone())};
  for (std::size_t i = clone_index + 1; i < bodies_.size(); ++i) {
    const btRigidBody& body = *bodies_[i];
    state.cubes.push_back({pose_of(body), velocity_of(body)});
    const Eigen::Vector3d force_n = force_on_n(body);
    const int cube = static_cast<int>(state.cubes.size()) - 1;
    if (!force_n.isZero(0)) state.contacts.push_back({cube, force_n});
  }
  return state;
}

}  // namespace heft
