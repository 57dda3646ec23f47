// The decoupling technique on Bullet's contact solver. Law and schemes:
// physics/coupling/CouplingLaw.h.
#include <optional>

#include "base/Pose.h"
#include "physics/DecouplingSimulator.h"
#include "physics/bullet/ContactWorld.h"
#include "physics/coupling/CouplingLaw.h"
#include "physics/scene/Scene.h"

namespace heft {

namespace {
using Eigen::Vector3d;

class BulletSimulator : public DecouplingSimulator {
 public:
  BulletSimulator(CouplingScheme scheme, bool locked) : scheme_(scheme), locked_(locked) {}

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

  void begin_coupled(const Pose& target, double h_s);
  void end_coupled(const Pose& target);

  CouplingScheme scheme_;
  bool locked_;
  Scene scene_;
  std::optional<ContactWorld> world_;
  Pose target_;
  CloneCoupling coupling_;
};

void BulletSimulator::reset(const Scene& scene, const Pose& target) {
  scene_ = scene;
  target_ = target;
  world_.emplace(scene.friction, scene.gravity_m_s2);
  world_->add(scene.effector_size_m, clone_start(scene, target));
  clone().driven = true;
  clone().set_mass(0, Vector3d::Zero());
  for (const Cube& cube : scene.cubes) {
    const std::size_t i = world_->add(cube.size_m, upright_pose(cube.position_m, cube.yaw_rad));
    world_->box(i).set_mass(cube.mass_kg, box_inertia_kg_m2(cube.mass_kg, cube.size_m));
    world_->box(i).table_friction = cube.table_friction;
  }
  coupling_ = CloneCoupling(scheme_, scene, locked_);
  coupling_.restart({clone().pose, {}}, {});
}

// Sets the clone's solver mass and free velocity.
void BulletSimulator::begin_coupled(const Pose& target, double h_s) {
  const CoupledClone free = coupling_.begin(clone().pose, target_, target, h_s);
  clone().velocity = free.velocity;
  clone().set_mass(free.mass_kg, free.inertia_kg_m2);
}

void BulletSimulator::end_coupled(const Pose& target) {
  coupling_.end({clone().pose, clone().velocity});
  if (locked_) clone().pose.orientation = target.orientation;
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
  coupling_.restart({target, velocity}, velocity);
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

// Implicit Euler in translation and rotation.
std::unique_ptr<DecouplingSimulator> make_bullet_ea() {
  return std::make_unique<BulletSimulator>(CouplingScheme::implicit_euler, false);
}

// The exact sampled oscillator in translation and rotation.
std::unique_ptr<DecouplingSimulator> make_bullet_x() {
  return std::make_unique<BulletSimulator>(CouplingScheme::exact, false);
}

// Exact in translation, the clone's orientation locked to the effector's. The paper's torsional
// spring (150 N m/rad on 1e-5 kg m^2) is nearly that stiff. A scene's torsional stiffness has no
// effect.
std::unique_ptr<DecouplingSimulator> make_bullet_lx() {
  return std::make_unique<BulletSimulator>(CouplingScheme::exact, true);
}

}  // namespace heft
