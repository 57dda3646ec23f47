#include "physics/bullet/RigidBox.h"

#include "base/Pose.h"

namespace heft {

namespace {
btTransform transform_of(const Pose& pose) {
  const auto& q = pose.orientation;
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), to_bullet(pose.position_m));
}
}  // namespace

std::unique_ptr<btRigidBody> make_bullet_body() {
  auto body = std::make_unique<btRigidBody>(0, nullptr, nullptr);
  body->setFlags(0);
  return body;
}

void RigidBox::set_mass(double kg, const Eigen::Vector3d& inertia_kg_m2) {
  mass_kg = kg;
  const auto kinematic = btCollisionObject::CF_KINEMATIC_OBJECT;
  const auto fixed = btCollisionObject::CF_STATIC_OBJECT;
  body->setMassProps(kg, to_bullet(inertia_kg_m2));
  const int flags = body->getCollisionFlags() & ~(kinematic | fixed);
  body->setCollisionFlags(kg > 0 ? flags : flags | kinematic);
}

void RigidBox::put(const Pose& to, const Velocity& at) {
  pose = to;
  velocity = at;
  wake();
}

void RigidBox::move(double h_s) {
  pose.position_m += h_s * velocity.linear_m_s;
  pose.orientation =
      (rotation_from_vector(h_s * velocity.angular_rad_s) * pose.orientation).normalized();
}

void RigidBox::write_body() {
  body->setWorldTransform(transform_of(pose));
  body->setLinearVelocity(to_bullet(velocity.linear_m_s));
  body->setAngularVelocity(to_bullet(velocity.angular_rad_s));
  body->updateInertiaTensor();
}

void RigidBox::read_body() {
  velocity = {from_bullet(body->getLinearVelocity()), from_bullet(body->getAngularVelocity())};
  const btTransform& moved = body->getWorldTransform();
  if (moved == transform_of(pose)) return;
  const btQuaternion q = moved.getRotation();
  const Eigen::Quaterniond orientation(q.w(), q.x(), q.y(), q.z());
  const double sign = orientation.dot(pose.orientation) < 0 ? -1 : 1;
  pose = {from_bullet(moved.getOrigin()), Eigen::Quaterniond(sign * orientation.coeffs())};
}

}  // namespace heft
