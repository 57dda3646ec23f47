#include "physics/bullet/BulletSimulator.h"

#include <array>
#include <optional>

#include "physics/CouplingLaw.h"
#include "physics/bullet/ContactWorld.h"

namespace heft {

namespace {
using Eigen::Vector3d;

enum class Orientation { coupled, locked };

class BulletSimulator : public DecouplingSimulator {
 public:
  BulletSimulator(CouplingScheme scheme, Orientation orientation)
      : scheme_(scheme), orientation_(orientation) {}

  void reset(const Scene& scene, const Pose& target) override;
  void step(const Pose& target, double h_s) override;
  void teleport_clone(const Pose& target, const Velocity& velocity) override;
  void set_clone_solid(bool solid) override { clone().solid = solid; }
  void place_cube(int cube, const Pose& pose) override;
  WorldState state() const override;

 private:
  static constexpr std::size_t clone_index = 0;

  RigidBox& clone() { return world_->box(clone_index); }
  static std::size_t index_of(std::size_t cube) { return cube + 1; }

  void restart_coupling(const Velocity& clone_velocity, const Velocity& target_velocity);
  void begin_coupled(const Pose& target, double h_s);
  void end_coupled(const Pose& target);

  CouplingScheme scheme_;
  Orientation orientation_;
  Scene scene_;
  std::optional<ContactWorld> world_;
  Pose target_;
  std::array<CouplingLaw, 3> translation_, rotation_;  // world axes, the clone's own axes
};

void BulletSimulator::reset(const Scene& scene, const Pose& target) {
  scene_ = scene;
  target_ = target;
  world_.emplace(scene.friction, scene.gravity_m_s2);
  const Pose offset = scene.coupling.decoupled ? scene.clone_offset : Pose{};
  world_->add(scene.effector_size_m,
              {target * offset.position_m, target.orientation * offset.orientation});
  clone().driven = true;
  clone().set_mass(0, Vector3d::Zero());
  for (const Cube& cube : scene.cubes) {
    const std::size_t i = world_->add(cube.size_m, upright_pose(cube.position_m, cube.yaw_rad));
    world_->box(i).set_mass(cube.mass_kg, box_inertia_kg_m2(cube.mass_kg, cube.size_m));
  }
  restart_coupling({}, {});
}

void BulletSimulator::restart_coupling(const Velocity& clone_velocity,
                                       const Velocity& target_velocity) {
  const Coupling& coupling = scene_.coupling;
  const double m = coupling.clone_mass_kg;
  const Vector3d inertia = box_inertia_kg_m2(m, scene_.effector_size_m);
  const auto own = clone().pose.orientation.conjugate();
  const Vector3d own_turn = own * clone_velocity.angular_rad_s;
  const Vector3d own_target_turn = own * target_velocity.angular_rad_s;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    translation_[i] = {scheme_, {m, coupling.stiffness_n_per_m, coupling.damping_ratio}};
    translation_[i].restart(clone_velocity.linear_m_s[e], target_velocity.linear_m_s[e]);
    rotation_[i] = {scheme_,
                    {inertia[e], coupling.torsional_stiffness_nm_per_rad, coupling.damping_ratio}};
    rotation_[i].restart(own_turn[e], own_target_turn[e]);
  }
}

// Gives the clone its solver mass and the velocity at which it moves if nothing touches it.
void BulletSimulator::begin_coupled(const Pose& target, double h_s) {
  RigidBox& box = clone();
  const Velocity of_target = mean_velocity(target_, target, h_s);
  const Vector3d offset_m = box.pose.position_m - target_.position_m;
  double solver_mass_kg = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    const FreeStep free = translation_[i].begin(offset_m[e], of_target.linear_m_s[e], h_s);
    solver_mass_kg = free.solver_mass;
    box.velocity.linear_m_s[e] = free.velocity;
  }
  if (orientation_ == Orientation::locked) {
    box.velocity.angular_rad_s = mean_velocity(box.pose, target, h_s).angular_rad_s;
    box.set_mass(solver_mass_kg, Vector3d::Zero());
    return;
  }
  const auto& own = box.pose.orientation;
  const Vector3d offset_rad = rotation_vector(target_.orientation.conjugate() * own);
  const Vector3d target_turn = own.conjugate() * of_target.angular_rad_s;
  Vector3d turn, solver_inertia;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    const FreeStep free = rotation_[i].begin(offset_rad[e], target_turn[e], h_s);
    solver_inertia[e] = free.solver_mass;
    turn[e] = free.velocity;
  }
  box.velocity.angular_rad_s = own * turn;
  box.set_mass(solver_mass_kg, solver_inertia);
}

void BulletSimulator::end_coupled(const Pose& target) {
  RigidBox& box = clone();
  const Vector3d turn = box.pose.orientation.conjugate() * box.velocity.angular_rad_s;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    translation_[i].end(box.velocity.linear_m_s[e]);
    if (orientation_ == Orientation::coupled) rotation_[i].end(turn[e]);
  }
  if (orientation_ == Orientation::locked) box.pose.orientation = target.orientation;
}

void BulletSimulator::step(const Pose& target, double h_s) {
  const bool decoupled = scene_.coupling.decoupled;
  if (decoupled)
    begin_coupled(target, h_s);
  else
    clone().velocity = mean_velocity(clone().pose, target, h_s);
  world_->solve(h_s);
  for (std::size_t i = 0; i < world_->size(); ++i)
    if (!world_->box(i).at_rest) world_->box(i).move(h_s);
  if (decoupled)
    end_coupled(target);
  else
    clone().pose = target;
  world_->settle(h_s);
  target_ = target;
}

void BulletSimulator::teleport_clone(const Pose& target, const Velocity& velocity) {
  target_ = target;
  clone().put(target, velocity);
  world_->forget_contacts(clone_index);
  restart_coupling(velocity, velocity);
}

void BulletSimulator::place_cube(int cube, const Pose& pose) {
  const std::size_t i = index_of(static_cast<std::size_t>(cube));
  world_->box(i).put(pose, {});
  world_->forget_contacts(i);
}

WorldState BulletSimulator::state() const {
  const auto state_of = [&](std::size_t i) {
    return BodyState{world_->box(i).pose, world_->box(i).velocity};
  };
  WorldState state;
  state.clone = state_of(clone_index);
  for (std::size_t cube = 0; cube < scene_.cubes.size(); ++cube) {
    state.cubes.push_back(state_of(index_of(cube)));
    const Vector3d force_n = world_->force_n(clone_index, index_of(cube));
    if (!force_n.isZero(0)) state.contacts.push_back({static_cast<int>(cube), force_n});
  }
  return state;
}
}  // namespace

std::unique_ptr<DecouplingSimulator> make_bullet_ea() {
  return std::make_unique<BulletSimulator>(CouplingScheme::implicit_euler, Orientation::coupled);
}

std::unique_ptr<DecouplingSimulator> make_bullet_x() {
  return std::make_unique<BulletSimulator>(CouplingScheme::exact, Orientation::coupled);
}

std::unique_ptr<DecouplingSimulator> make_bullet_lx() {
  return std::make_unique<BulletSimulator>(CouplingScheme::exact, Orientation::locked);
}

}  // namespace heft
