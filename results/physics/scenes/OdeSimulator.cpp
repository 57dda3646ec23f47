#include "results/physics/scenes/Reference.h"

#ifndef HEFT_HAVE_ODE

namespace heft {
std::unique_ptr<DecouplingSimulator> make_ode_simulator() {
  return nullptr;
}
}  // namespace heft

#else

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <span>

#include "base/Pose.h"

namespace heft {

namespace {
using Eigen::Vector3d;

constexpr double no_penetration_speed_m_s = 0.02;  // at which overlaps are corrected
// Stiffer torsional springs keep the orientation within 0.03 degrees. ODE computes normal forces as
// if there were no friction, so the torque of a sliding tip is wrong unless the orientation is
// locked.
constexpr double locks_nm_per_rad = 50;
constexpr double sticking_m_s = 1e-5;  // slower is sticking
// Creep of sticking compliant contacts, which makes the distribution of friction unique.
constexpr double creep_m_s_per_n = 1e-6;
constexpr double no_slip_m_s = 1e-12;

struct OdeIsReady {
  OdeIsReady() {
    dInitODE2(0);
    // ODE warns of statically indeterminate contacts; the study reports the differences.
    dSetMessageHandler([](int, const char*, va_list) {});
  }
};

void set_pose(dBodyID body, const Pose& pose) {
  const auto& p = pose.position_m;
  const auto& q = pose.orientation;
  const dQuaternion quaternion{q.w(), q.x(), q.y(), q.z()};
  dBodySetPosition(body, p.x(), p.y(), p.z());
  dBodySetQuaternion(body, quaternion);
}

void set_velocity(dBodyID body, const Velocity& velocity) {
  const auto &v = velocity.linear_m_s, &w = velocity.angular_rad_s;
  dBodySetLinearVel(body, v.x(), v.y(), v.z());
  dBodySetAngularVel(body, w.x(), w.y(), w.z());
}

BodyState state_of(dBodyID body) {
  const dReal *p = dBodyGetPosition(body), *q = dBodyGetQuaternion(body);
  const dReal *v = dBodyGetLinearVel(body), *w = dBodyGetAngularVel(body);
  return {{{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}}, {{v[0], v[1], v[2]}, {w[0], w[1], w[2]}}};
}

class OdeSimulator : public DecouplingSimulator {
 public:
  OdeSimulator() = default;
  ~OdeSimulator() override { clear(); }
  OdeSimulator(const OdeSimulator&) = delete;
  OdeSimulator& operator=(const OdeSimulator&) = delete;

  void reset(const Scene& scene, const Pose& target) override;
  void step(const Pose& target, double h_s) override;
  void teleport_clone(const Pose& target, const Velocity& velocity) override {
    set_pose(bodies_[0], target);
    set_velocity(bodies_[0], velocity);
    target_ = target;
  }
  void set_clone_solid(bool solid) override { solid_ = solid; }
  void place_cube(int cube, const Pose& pose) override {
    set_pose(bodies_[static_cast<std::size_t>(cube) + 1], pose);
    set_velocity(bodies_[static_cast<std::size_t>(cube) + 1], {});
  }
  WorldState state() const override {
    WorldState state;
    state.clone = state_of(bodies_[0]);
    for (std::size_t i = 1; i < bodies_.size(); ++i) state.cubes.push_back(state_of(bodies_[i]));
    return state;
  }

 private:
  bool gives() const { return scene_.contact_compliance_m_per_n > 0; }
  void clear();
  void add(const Vector3d& size_m, const Pose& pose, double mass_kg);
  void pull(const Pose& target, double h_s);
  void touch(dGeomID a, dGeomID b, double h_s);
  void give(dContact& contact, dBodyID a, dBodyID b, double h_s) const;
  void rub(dContact& contact, double slip_m_s, double load_n) const;
  double table_friction(dGeomID box) const;
  double inverse_mass_per_kg(const dContactGeom& at, dBodyID body) const;
  Vector3d relative_velocity(const dContactGeom& at, dBodyID a, dBodyID b) const;
  Vector3d slip(const dContactGeom& at, dBodyID a, dBodyID b) const;

  OdeIsReady ready_;
  dWorldID world_ = nullptr;
  dJointGroupID contacts_ = nullptr;
  dGeomID table_ = nullptr;
  std::vector<dBodyID> bodies_;  ///< the clone, the cubes
  std::vector<dGeomID> boxes_;
  Scene scene_;
  Vector3d inertia_kg_m2_ = Vector3d::Zero();  ///< of the clone
  bool locked_ = false;                        ///< by its torsional spring
  bool solid_ = true;
  Pose target_;
  Vector3d heading_ = Vector3d::UnitX();  ///< from the clone to the hand
};

void OdeSimulator::clear() {
  if (!world_) return;
  for (dGeomID box : boxes_) dGeomDestroy(box);
  dGeomDestroy(table_);
  dJointGroupDestroy(contacts_);
  dWorldDestroy(world_);
  bodies_.clear();
  boxes_.clear();
  world_ = nullptr;
}

void OdeSimulator::add(const Vector3d& size_m, const Pose& pose, double mass_kg) {
  dMass mass;
  dMassSetBoxTotal(&mass, mass_kg, size_m.x(), size_m.y(), size_m.z());
  const dBodyID body = dBodyCreate(world_);
  dBodySetMass(body, &mass);
  const dGeomID box = dCreateBox(nullptr, size_m.x(), size_m.y(), size_m.z());
  dGeomSetBody(box, body);
  set_pose(body, pose);
  bodies_.push_back(body);
  boxes_.push_back(box);
}

void OdeSimulator::reset(const Scene& scene, const Pose& target) {
  clear();
  scene_ = scene;
  target_ = target;
  solid_ = true;
  world_ = dWorldCreate();
  contacts_ = dJointGroupCreate(0);
  table_ = dCreatePlane(nullptr, 0, 0, 1, 0);
  dWorldSetGravity(world_, 0, 0, -scene.gravity_m_s2);
  dWorldSetCFM(world_, 1e-10);
  if (!gives()) {
    dWorldSetContactMaxCorrectingVel(world_, no_penetration_speed_m_s);
    dWorldSetContactSurfaceLayer(world_, 1e-7);
  }

  const Coupling& coupling = scene.coupling;
  add(scene.effector_size_m, clone_start(scene, target), coupling.clone_mass_kg);
  dMass mass;
  dBodyGetMass(bodies_[0], &mass);
  inertia_kg_m2_ = {mass.I[0], mass.I[5], mass.I[10]};
  locked_ = coupling.torsional_stiffness_nm_per_rad >= locks_nm_per_rad;
  if (locked_) {
    dMassSetParameters(&mass, coupling.clone_mass_kg, 0, 0, 0, 1e3, 1e3, 1e3, 0, 0, 0);
    dBodySetMass(bodies_[0], &mass);
  }
  dBodySetGravityMode(bodies_[0], 0);
  if (!coupling.decoupled) dBodySetKinematic(bodies_[0]);
  for (const Cube& cube : scene.cubes)
    add(cube.size_m, upright_pose(cube.position_m, cube.yaw_rad), cube.mass_kg);
}

// The paper's coupling, with damping of the velocity relative to the target.
void OdeSimulator::pull(const Pose& target, double h_s) {
  const Coupling& coupling = scene_.coupling;
  const BodyState clone = state_of(bodies_[0]);
  const Velocity hand = mean_velocity(target_, target, h_s);
  const auto damping = [&](double stiffness, double mass) {
    return coupling.damping_ratio * 2 * std::sqrt(stiffness * mass);
  };
  const double k = coupling.stiffness_n_per_m, kappa = coupling.torsional_stiffness_nm_per_rad;
  const Vector3d force_n =
      -k * (clone.pose.position_m - target_.position_m) -
      damping(k, coupling.clone_mass_kg) * (clone.velocity.linear_m_s - hand.linear_m_s);
  dBodyAddForce(bodies_[0], force_n.x(), force_n.y(), force_n.z());
  if (locked_) {
    set_pose(bodies_[0], {clone.pose.position_m, target_.orientation});
    dBodySetAngularVel(bodies_[0], hand.angular_rad_s.x(), hand.angular_rad_s.y(),
                       hand.angular_rad_s.z());
    return;
  }
  const auto& own = clone.pose.orientation;
  const Vector3d turn_rad = rotation_vector(target_.orientation.conjugate() * own);
  const Vector3d turning_rad_s =
      own.conjugate() * (clone.velocity.angular_rad_s - hand.angular_rad_s);
  Vector3d torque_nm;
  for (Eigen::Index i = 0; i < 3; ++i)
    torque_nm[i] = -kappa * turn_rad[i] - damping(kappa, inertia_kg_m2_[i]) * turning_rad_s[i];
  dBodyAddRelTorque(bodies_[0], torque_nm.x(), torque_nm.y(), torque_nm.z());
}

// Velocity of the point of a relative to that of b.
Vector3d OdeSimulator::relative_velocity(const dContactGeom& at, dBodyID a, dBodyID b) const {
  const auto velocity = [&](dBodyID body) {
    dVector3 v{0, 0, 0};
    if (body) dBodyGetPointVel(body, at.pos[0], at.pos[1], at.pos[2], v);
    return Vector3d(v[0], v[1], v[2]);
  };
  return velocity(a) - velocity(b);
}

// Velocity of a relative to b in the contact plane.
Vector3d OdeSimulator::slip(const dContactGeom& at, dBodyID a, dBodyID b) const {
  const Vector3d normal(at.normal[0], at.normal[1], at.normal[2]);
  const Vector3d relative = relative_velocity(at, a, b);
  return relative - normal * normal.dot(relative);
}

// Inverse effective mass of a body along the contact normal.
double OdeSimulator::inverse_mass_per_kg(const dContactGeom& at, dBodyID body) const {
  if (!body || dBodyIsKinematic(body)) return 0;
  dMass mass;
  dBodyGetMass(body, &mass);
  const BodyState is = state_of(body);
  const auto own = is.pose.orientation.conjugate();
  const Vector3d arm_m = Vector3d(at.pos[0], at.pos[1], at.pos[2]) - is.pose.position_m;
  const Vector3d turn = own * arm_m.cross(Vector3d(at.normal[0], at.normal[1], at.normal[2]));
  const Vector3d inertia_kg_m2(mass.I[0], mass.I[5], mass.I[10]);
  return 1 / mass.mass + turn.dot(turn.cwiseQuotient(inertia_kg_m2));
}

// ERP and CFM of a spring with critical damping (ODE manual, "How to use ERP and CFM").
void OdeSimulator::give(dContact& contact, dBodyID a, dBodyID b, double h_s) const {
  const dContactGeom& at = contact.geom;
  const double k_n_per_m = 1 / scene_.contact_compliance_m_per_n;
  const double mass_kg = 1 / (inverse_mass_per_kg(at, a) + inverse_mass_per_kg(at, b));
  const double c_n_s_per_m = 2 * std::sqrt(k_n_per_m * mass_kg);
  contact.surface.mode |= dContactSoftERP | dContactSoftCFM;
  contact.surface.soft_erp = h_s * k_n_per_m / (h_s * k_n_per_m + c_n_s_per_m);
  contact.surface.soft_cfm = 1 / (h_s * k_n_per_m + c_n_s_per_m);
  const Vector3d normal(at.normal[0], at.normal[1], at.normal[2]);
  const Vector3d velocity = relative_velocity(at, a, b);
  const double closing_m_s = -normal.dot(velocity);
  const double load_n = std::max(0.0, k_n_per_m * at.depth + c_n_s_per_m * closing_m_s);
  rub(contact, (velocity + closing_m_s * normal).norm(), load_n);
}

// Coulomb's disk, linearized about the current slip: friction is at its limit along the slip, and
// across it follows the rotation of the limit's direction. With a pyramid, a box that slides on
// four points could not change its center of rotation. The limit uses the current load; ODE's
// dContactApprox1 uses the load without friction.
void OdeSimulator::rub(dContact& contact, double slip_m_s, double load_n) const {
  const double limit_n = contact.surface.mu * load_n;
  contact.surface.mode &= ~dContactApprox1;
  contact.surface.mode |= dContactSlip1 | dContactSlip2;
  contact.surface.mu = limit_n;
  contact.surface.slip1 = creep_m_s_per_n;
  contact.surface.slip2 =
      limit_n > 0 ? std::max(creep_m_s_per_n, slip_m_s / limit_n) : creep_m_s_per_n;
}

// Moves the points of an overlap to one plane across the normal, as in `boxes`. Overlaps are some
// hundredths of a millimeter deep and unequal on a pitched cube, and the torque of friction depends
// on where in the overlap it acts.
void flatten(std::span<dContact> contacts) {
  const auto along_normal_m = [](const dContactGeom& at) {
    return at.normal[0] * at.pos[0] + at.normal[1] * at.pos[1] + at.normal[2] * at.pos[2];
  };
  double mean_m = 0;
  for (const dContact& contact : contacts)
    mean_m += along_normal_m(contact.geom) / static_cast<double>(contacts.size());
  for (dContact& contact : contacts) {
    dContactGeom& at = contact.geom;
    const double by_m = mean_m - along_normal_m(at);
    for (std::size_t j = 0; j < 3; ++j) at.pos[j] += by_m * at.normal[j];
  }
}

double OdeSimulator::table_friction(dGeomID box) const {
  const auto index = static_cast<std::size_t>(std::ranges::find(boxes_, box) - boxes_.begin());
  return index == 0 ? scene_.friction : scene_.table_friction(index - 1);
}

// ODE's friction pyramid equals Coulomb's disk if one of its axes is along the slip.
void OdeSimulator::touch(dGeomID a, dGeomID b, double h_s) {
  std::array<dContact, 8> contacts{};
  const int n = dCollide(a, b, 8, &contacts[0].geom, sizeof(dContact));
  if (gives() && b != table_) flatten({contacts.data(), static_cast<std::size_t>(n)});
  const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
  const double friction = b == table_ ? table_friction(a) : scene_.friction;
  for (int i = 0; i < n; ++i) {
    dContact& contact = contacts[static_cast<std::size_t>(i)];
    const Vector3d normal(contact.geom.normal[0], contact.geom.normal[1], contact.geom.normal[2]);
    Vector3d along = slip(contact.geom, body_a, body_b);
    const double least_m_s = gives() ? no_slip_m_s : sticking_m_s;
    if (along.norm() < least_m_s) along = heading_ - normal * normal.dot(heading_);
    if (along.norm() < least_m_s) along = normal.unitOrthogonal();
    along.normalize();
    for (std::size_t j = 0; j < 3; ++j) contact.fdir1[j] = along[static_cast<Eigen::Index>(j)];
    contact.surface.mode = dContactApprox1 | dContactFDir1;
    contact.surface.mu = friction;
    if (gives()) give(contact, body_a, body_b, h_s);
    dJointAttach(dJointCreateContact(world_, contacts_, &contact), body_a, body_b);
  }
}

void OdeSimulator::step(const Pose& target, double h_s) {
  const Vector3d pull_m = target.position_m - state_of(bodies_[0]).pose.position_m;
  if (pull_m.norm() > 0) heading_ = pull_m.normalized();
  if (scene_.coupling.decoupled)
    pull(target, h_s);
  else
    set_velocity(bodies_[0], mean_velocity(state_of(bodies_[0]).pose, target, h_s));
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (i == 0 && !solid_) continue;
    touch(boxes_[i], table_, h_s);
    for (std::size_t j = solid_ ? 0 : 1; j < i; ++j) touch(boxes_[i], boxes_[j], h_s);
  }
  dWorldStep(world_, h_s);
  dJointGroupEmpty(contacts_);
  target_ = target;
}
}  // namespace

std::unique_ptr<DecouplingSimulator> make_ode_simulator() {
  return std::make_unique<OdeSimulator>();
}

}  // namespace heft

#endif
