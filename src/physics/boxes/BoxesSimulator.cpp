#include "physics/boxes/BoxesSimulator.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/Pose.h"
#include "physics/BoxInertia.h"
#include "physics/CloneCoupling.h"
#include "physics/boxes/BoxWorld.h"

namespace heft {

namespace {
using boxes::Body;
using boxes::BoxWorld;
using Eigen::Vector3d;

// Where boxes are near each other and one goes farther than this in a step, the step is cut: a box
// that is hit turns within the step, and contacts know only how it stood before.
constexpr double longest_travel_m = 1.5e-3;
constexpr double most_pieces = 64;
constexpr double same_length = 1 + 1e-6;
constexpr double steady_m_s = 0.01;  // of the target, from step to step
constexpr double instant_s = 1e-9;
constexpr double least_share = 1e-3;  // of a step that is worth cutting off
constexpr double there_m = 1e-6;      // a way to a cube that is none
constexpr int most_cuts = 4;  // until the clone has slid off: it may be slower than foreseen

// How many times more a push at the tip moves the clone than it turns the tip aside, at least.
constexpr double locked_ratio = 100;

// Where the torsional spring is so much stiffer than the other that turning adds nothing to the
// lag, unless the clone is released turned away.
bool turns_as_target(const Scene& scene) {
  const Coupling& coupling = scene.coupling;
  const double lever_m = scene.effector_size_m.norm() / 2;
  const bool stiff = coupling.torsional_stiffness_nm_per_rad >=
                     locked_ratio * coupling.stiffness_n_per_m * lever_m * lever_m;
  return stiff && rotation_vector(scene.clone_offset.orientation).norm() < 1e-9;
}

class BoxesSimulator : public DecouplingSimulator {
 public:
  void reset(const Scene& scene, const Pose& target) override;
  void step(const Pose& target, double h_s) override;
  void teleport_clone(const Pose& target, const Velocity& velocity) override;
  void set_clone_solid(bool solid) override { clone().solid = solid; }
  void place_cube(int cube, const Pose& pose) override;
  WorldState state() const override;

 private:
  static constexpr std::size_t clone_index = 0;

  Body& clone() { return world_->body(clone_index); }
  static std::size_t index_of(std::size_t cube) { return cube + 1; }

  void add_clone(const Scene& scene, const Pose& target);
  double n_pieces(const Velocity& of_target, double h_s) const;
  void pieces(const Pose& target, double h_s);
  void piece(const Pose& target, double h_s);
  void coupled_piece(const Pose& target, double h_s);
  void decoupled_piece(const Pose& target, double h_s);
  void begin_decoupled(const Pose& target, double h_s);
  void end_decoupled(const Pose& target, double h_s);
  void note_impulses();

  bool decoupled_ = true;
  std::size_t n_cubes_ = 0;
  std::optional<BoxWorld> world_;
  CloneCoupling coupling_;
  Pose target_;
  std::vector<Vector3d> impulse_n_s_;  // of the clone on each cube, over the last step
  double last_h_s_ = 0, piece_s_ = 0;
  Velocity of_target_;  // over the last pieces
};

void BoxesSimulator::reset(const Scene& scene, const Pose& target) {
  decoupled_ = scene.coupling.decoupled;
  n_cubes_ = scene.cubes.size();
  target_ = target;
  last_h_s_ = piece_s_ = 0;
  of_target_ = {};
  impulse_n_s_.assign(n_cubes_, Vector3d::Zero());
  world_.emplace(boxes::ContactSurface{scene.friction, scene.contact_compliance_m_per_n},
                 scene.gravity_m_s2, n_cubes_ + 1, !decoupled_);
  add_clone(scene, target);
  for (const Cube& cube : scene.cubes) {
    Body body;
    body.set_size(cube.size_m);
    body.set_mass(cube.mass_kg, box_inertia_kg_m2(cube.mass_kg, cube.size_m));
    body.put(upright_pose(cube.position_m, cube.yaw_rad), {});
    world_->add(body);
  }
  if (scene.contact_compliance_m_per_n == 0) world_->settle_at_start();  // else they sink first
}

void BoxesSimulator::add_clone(const Scene& scene, const Pose& target) {
  Body body;
  body.set_size(scene.effector_size_m);
  body.has_weight = false;
  body.put(clone_start(scene, target), {});
  world_->add(body);
  coupling_ = CloneCoupling(CouplingScheme::exact, scene, turns_as_target(scene));
  coupling_.restart({body.pose, {}}, {});
}

// Pieces become longer only where nothing changes suddenly.
double BoxesSimulator::n_pieces(const Velocity& of_target, double h_s) const {
  // The clone may become as fast as the target within the step.
  const double fastest_m_s =
      std::max(world_->fastest_m_s(), world_->body(clone_index).tip_speed_m_s(of_target));
  const double travel_m = h_s * fastest_m_s;
  double n = 1;
  if (travel_m > longest_travel_m && world_->crowded(2 * travel_m))
    n = std::min(most_pieces, std::ceil(travel_m / longest_travel_m));
  const double turn_m_s = (of_target.linear_m_s - of_target_.linear_m_s).norm();
  const bool may_be_longer = world_->steady() && turn_m_s < steady_m_s;
  if (h_s / n <= same_length * piece_s_ || piece_s_ == 0 || may_be_longer) return n;
  return std::min(most_pieces, std::ceil(h_s / (same_length * piece_s_)));
}

// A drawn clone that slides off a cube snaps back; a step later it would be millimeters elsewhere.
// So the step is cut there, and the clone is free from then on, at the velocity that it has.
void BoxesSimulator::step(const Pose& target, double h_s) {
  for (Vector3d& impulse_n_s : impulse_n_s_) impulse_n_s.setZero();
  const Pose from = target_;
  double done = 0;
  for (int cut = 0; decoupled_ && cut < most_cuts; ++cut) {
    const auto share = world_->share_before_sliding_off(clone_index, (1 - done) * h_s);
    if (!share || *share >= 1) break;
    const double until = done + *share * (1 - done);
    pieces(interpolate(from, target, until), (until - done) * h_s);
    coupling_.restart({clone().pose, clone().velocity}, mean_velocity(from, target, h_s));
    done = until;
  }
  pieces(target, (1 - done) * h_s);
  last_h_s_ = h_s;
}

void BoxesSimulator::pieces(const Pose& target, double h_s) {
  const Pose from = target_;
  const Velocity of_target = mean_velocity(from, target, h_s);
  const double n = n_pieces(of_target, h_s);
  of_target_ = of_target;
  piece_s_ = h_s / n;
  for (double i = 1; i < n; ++i) piece(interpolate(from, target, i / n), h_s / n);
  piece(target, h_s / n);
}

// A clone that hits a cube shares its momentum with it, as light as it is; the coupling's mass is
// that of a clone that is pushed for the whole step. So the step is cut there, and the hit is a
// step that takes no time.
void BoxesSimulator::piece(const Pose& target, double h_s) {
  if (!decoupled_) return coupled_piece(target, h_s);
  const Pose from = target_;
  double done = 0;
  for (int hit = 0;; ++hit) {
    const double left_s = (1 - done) * h_s;
    begin_decoupled(target, left_s);
    const auto share = world_->share_before_hitting(clone_index, left_s);
    if (!share || hit == most_cuts || (1 - *share) * left_s < least_share * h_s) break;
    const Velocity of_target = mean_velocity(from, target, h_s);
    if (*share * left_s * clone().tip_speed_m_s() > there_m) {
      done += *share * (1 - done);
      decoupled_piece(interpolate(from, target, done), *share * left_s);
      // A path that bends may meet the cube a little earlier: the load of that is no lasting one.
      if (world_->touches(clone_index))
        coupling_.restart({clone().pose, clone().velocity}, of_target);
    }
    decoupled_piece(target_, instant_s);
    coupling_.restart({clone().pose, clone().velocity}, of_target);
  }
  end_decoupled(target, (1 - done) * h_s);
}

void BoxesSimulator::coupled_piece(const Pose& target, double h_s) {
  clone().velocity = mean_velocity(clone().pose, target, h_s);
  world_->solve(h_s);
  world_->move(h_s);
  clone().place(target);
  target_ = target;
  note_impulses();
}

void BoxesSimulator::decoupled_piece(const Pose& target, double h_s) {
  begin_decoupled(target, h_s);
  end_decoupled(target, h_s);
}

// Gives the clone its solver mass and the velocity at which it moves if nothing touches it.
void BoxesSimulator::begin_decoupled(const Pose& target, double h_s) {
  const CoupledClone free = coupling_.begin(clone().pose, target_, target, h_s);
  clone().velocity = free.velocity;
  clone().set_mass(free.mass_kg, free.inertia_kg_m2);
}

void BoxesSimulator::end_decoupled(const Pose& target, double h_s) {
  world_->solve(h_s);
  world_->move(h_s);
  coupling_.end({clone().pose, clone().velocity});
  if (coupling_.locked()) clone().place({clone().pose.position_m, target.orientation});
  target_ = target;
  note_impulses();
}

void BoxesSimulator::note_impulses() {
  for (std::size_t cube = 0; cube < n_cubes_; ++cube)
    if (!world_->body(index_of(cube)).asleep)
      impulse_n_s_[cube] += world_->impulse_n_s(clone_index, index_of(cube));
}

void BoxesSimulator::teleport_clone(const Pose& target, const Velocity& velocity) {
  target_ = target;
  clone().put(target, velocity);
  world_->forget_contacts(clone_index);
  coupling_.restart({clone().pose, velocity}, velocity);
}

void BoxesSimulator::place_cube(int cube, const Pose& pose) {
  const std::size_t i = index_of(static_cast<std::size_t>(cube));
  world_->body(i).put(pose, {});
  world_->forget_contacts(i);
}

WorldState BoxesSimulator::state() const {
  const auto state_of = [&](std::size_t i) {
    return BodyState{world_->body(i).pose, world_->body(i).velocity};
  };
  WorldState state;
  state.clone = state_of(clone_index);
  state.cubes.reserve(n_cubes_);
  for (std::size_t cube = 0; cube < n_cubes_; ++cube) {
    state.cubes.push_back(state_of(index_of(cube)));
    if (!impulse_n_s_[cube].isZero(0))
      state.contacts.push_back({static_cast<int>(cube), impulse_n_s_[cube] / last_h_s_});
  }
  return state;
}
}  // namespace

std::unique_ptr<DecouplingSimulator> make_boxes() {
  return std::make_unique<BoxesSimulator>();
}

}  // namespace heft
