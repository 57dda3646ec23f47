#include "physics/boxes/BoxesSimulator.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/Pose.h"
#include "physics/boxes/BoxWorld.h"
#include "physics/coupling/CouplingLaw.h"
#include "physics/scene/Scene.h"

namespace heft {

namespace {
using boxes::Body;
using boxes::BoxWorld;
using boxes::Motion;
using Eigen::Vector3d;

// Near boxes a step is cut into pieces in which the clone's oscillator turns no farther than this,
// and no box either: a push is taken as steady over a piece, a lever as the same. Where that would
// be more pieces than the most, they are longer.
constexpr double oscillation_rad = 0.4, turn_rad = 0.05;
// A coupled clone has none; but the cube that it throws ahead and meets again wants short pieces.
constexpr double coupled_per_s = 190;
constexpr double near_m = 5e-3;
constexpr double most_pieces = 32;
constexpr double rounding = 1e-9;
constexpr int most_cuts = 24;  // pieces of a step that may end at an event

// How many times more a push at the tip moves the clone than it turns the tip aside, at least: with
// the paper's spring and effector from 68 N m/rad on, where 10 cm of spring across hide 0.1 mm.
constexpr double locked_ratio = 482;

// Where the torsional spring is so much stiffer than the other that turning adds nothing to the
// lag, unless the clone is released turned away.
bool turns_as_target(const Scene& scene) {
  const Coupling& coupling = scene.coupling;
  const double lever_m = scene.effector_size_m.norm() / 2;
  const bool stiff = coupling.torsional_stiffness_nm_per_rad >=
                     locked_ratio * coupling.stiffness_n_per_m * lever_m * lever_m;
  return stiff && rotation_vector(scene.clone_offset.orientation).norm() < 1e-9;
}

// The clone on its way with the target, from pose to pose in a straight line.
class Coupled : public boxes::Driver {
 public:
  Coupled() = default;
  explicit Coupled(const Scene& scene)
      : decoupled_(scene.coupling.decoupled),
        locked_(turns_as_target(scene)),
        mass_kg_(scene.coupling.clone_mass_kg),
        inertia_kg_m2_(box_inertia_kg_m2(mass_kg_, scene.effector_size_m)),
        coupling_(scene.coupling) {}

  /// What is not free to move is exactly where the target is, whatever steps round to.
  void keep_on(const Pose& target, Body& clone) const {
    if (!decoupled_)
      clone.place(target);
    else if (locked_)
      clone.place({clone.pose.position_m, target.orientation});
  }
  /// The fastest that its oscillator swings or decays.
  double fastest_per_s() const {
    if (!decoupled_) return coupled_per_s;
    const double z = std::max(1.0, coupling_.damping_ratio);
    return std::sqrt(coupling_.stiffness_n_per_m / mass_kg_) * (z + std::sqrt(z * z - 1));
  }
  void follow(const Pose& from, const Velocity& velocity) {
    from_ = from;
    velocity_ = velocity;
  }

  void set_motion(Body& clone, const boxes::StepTime& time) const override {
    Motion& step = clone.step;
    step.mean = step.end = velocity_;
    step.per_kg = 0;
    step.turns = false;
    if (!decoupled_) {
      clone.velocity = velocity_;
      return;
    }
    if (time.h_s > 0)
      set_translation(clone, time, step);
    else
      step.per_kg = 1 / mass_kg_;
    if (!locked_) set_rotation(clone, time, step);
    if (!(time.h_s > 0)) step.mean = step.end = clone.velocity;
  }

 private:
  void set_translation(const Body& clone, const boxes::StepTime& time, Motion& step) const {
    const double h_s = time.h_s, mean_weight = time.mean_weight();
    const OscillatorStep& axis =
        steps_[3].of({mass_kg_, coupling_.stiffness_n_per_m, coupling_.damping_ratio}, h_s);
    const Vector3d offset_m = clone.pose.position_m - from_.position_m;
    const Vector3d relative_m_s = clone.velocity.linear_m_s - velocity_.linear_m_s;
    const double loss = coupling_.stiffness_n_per_m * axis.offset_by_force;
    step.mean.linear_m_s += (axis.offset_by_velocity * relative_m_s - loss * offset_m) / h_s;
    step.end.linear_m_s +=
        axis.velocity_by_offset * offset_m + axis.velocity_by_velocity * relative_m_s;
    double mean_per_kg = axis.offset_by_force / (h_s * h_s);
    double end_per_kg = axis.velocity_by_force / h_s;
    if (clone.pushed_s > h_s / 2 && h_s * fastest_per_s() < 1) {
      // From the middle of the last step on the push grows by so much per newton of difference.
      const double growth_per_s = 2 / (h_s + clone.pushed_s);
      const double mean_by_growth = growth_per_s * axis.offset_by_growth / h_s;
      const double end_by_growth = growth_per_s * axis.velocity_by_growth;
      mean_per_kg += mean_by_growth / h_s;
      end_per_kg += end_by_growth / h_s;
      step.mean.linear_m_s -= mean_by_growth * clone.pushed_n;
      step.end.linear_m_s -= end_by_growth * clone.pushed_n;
    }
    end_per_kg = std::max(0.0, end_per_kg);  // a stiff spring may have swung back
    step.per_kg = end_per_kg + mean_weight * (mean_per_kg - end_per_kg);
    step.mean_by_ahead = mean_per_kg / step.per_kg;
  }

  // The same about each of the clone's own axes.
  void set_rotation(const Body& clone, const boxes::StepTime& time, Motion& step) const {
    const double h_s = time.h_s, mean_weight = time.mean_weight();
    const auto& own = clone.pose.orientation;
    const Vector3d offset_rad = rotation_vector(from_.orientation.conjugate() * own);
    const Vector3d relative_rad_s =
        own.conjugate() * (clone.velocity.angular_rad_s - velocity_.angular_rad_s);
    Vector3d mean_rad_s = Vector3d::Zero(), end_rad_s = mean_rad_s, per_kg_m2, mean_by_ahead;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto e = static_cast<Eigen::Index>(i);
      const double kappa = coupling_.torsional_stiffness_nm_per_rad;
      const CouplingAxis axis{inertia_kg_m2_[e], kappa, coupling_.damping_ratio};
      if (!(h_s > 0)) {
        per_kg_m2[e] = mean_by_ahead[e] = 1 / axis.mass;
        continue;
      }
      const OscillatorStep& by = steps_[i].of(axis, h_s);
      mean_rad_s[e] =
          (by.offset_by_velocity * relative_rad_s[e] - kappa * by.offset_by_force * offset_rad[e]) /
          h_s;
      end_rad_s[e] =
          by.velocity_by_offset * offset_rad[e] + by.velocity_by_velocity * relative_rad_s[e];
      const double mean_per_kg_m2 = by.offset_by_force / (h_s * h_s);
      const double end_per_kg_m2 = std::max(0.0, by.velocity_by_force / h_s);
      per_kg_m2[e] = end_per_kg_m2 + mean_weight * (mean_per_kg_m2 - end_per_kg_m2);
      mean_by_ahead[e] = mean_per_kg_m2 / per_kg_m2[e];
    }
    const Eigen::Matrix3d axes = clone.shape.axes;
    step.mean.angular_rad_s += axes * mean_rad_s;
    step.end.angular_rad_s += axes * end_rad_s;
    step.per_kg_m2 = axes * per_kg_m2.asDiagonal() * axes.transpose();
    step.mean_turn_by_ahead = axes * mean_by_ahead.asDiagonal() * axes.transpose();
    step.turns = true;
  }

  // Of one axis, kept: most steps are as long as the last.
  struct Kept {
    double h_s = 0;
    OscillatorStep step;
    const OscillatorStep& of(const CouplingAxis& axis, double for_s) {
      if (std::abs(for_s - h_s) > 1e-12 * for_s) {  // a difference of times rounds
        step = oscillator_step(axis, for_s);
        h_s = for_s;
      }
      return step;
    }
  };

  bool decoupled_ = true, locked_ = true;
  double mass_kg_ = 0;
  Vector3d inertia_kg_m2_ = Vector3d::Zero();
  Coupling coupling_;
  Pose from_;
  Velocity velocity_;
  mutable std::array<Kept, 4> steps_;
};

class BoxesSimulator : public DecouplingSimulator {
 public:
  void reset(const Scene& scene, const Pose& target) override;
  void step(const Pose& target, double h_s) override;
  void teleport_clone(const Pose& target, const Velocity& velocity) override;
  void set_clone_solid(bool solid) override { clone().solid = solid; }
  void place_cube(int cube, const Pose& pose) override;
  WorldState state() const override;
  std::optional<SolveCounts> counts() const override {
    return world_ ? world_->counts() : SolveCounts{};
  }

 private:
  static constexpr std::size_t clone_index = 0;

  Body& clone() { return world_->body(clone_index); }
  static std::size_t index_of(std::size_t cube) { return cube + 1; }
  void note_impulses();
  double regular_piece_s(const Velocity& of_target, double h_s);
  double longest_after_hit_s(double regular_s);

  std::size_t n_cubes_ = 0;
  std::optional<BoxWorld> world_;
  Coupled coupled_;
  Pose target_;
  std::vector<Vector3d> impulse_n_s_;  // of the clone on each cube, over the last step
  double last_h_s_ = 0;
};

void BoxesSimulator::reset(const Scene& scene, const Pose& target) {
  n_cubes_ = scene.cubes.size();
  target_ = target;
  last_h_s_ = 0;
  impulse_n_s_.assign(n_cubes_, Vector3d::Zero());
  coupled_ = Coupled(scene);
  const boxes::ContactSurface surface{scene.friction, scene.contact_compliance_m_per_n,
                                      scene.coupling.decoupled};
  world_.emplace(surface, scene.gravity_m_s2, n_cubes_ + 1);
  Body clone;
  clone.driven = true;
  clone.set_size(scene.effector_size_m);
  clone.put(clone_start(scene, target), {});
  world_->add(clone);
  for (const Cube& cube : scene.cubes) {
    Body body;
    body.set_size(cube.size_m);
    body.mass_kg = cube.mass_kg;
    body.inertia_kg_m2 = box_inertia_kg_m2(cube.mass_kg, cube.size_m);
    body.put(upright_pose(cube.position_m, cube.yaw_rad), {});
    world_->add(body);
  }
  if (scene.contact_compliance_m_per_n == 0) world_->settle_at_start();  // else they sink first
}

void BoxesSimulator::step(const Pose& target, double h_s) {
  for (Vector3d& impulse_n_s : impulse_n_s_) impulse_n_s.setZero();
  const Velocity of_target = mean_velocity(target_, target, h_s);
  const Pose from = target_;
  double left_s = h_s;
  for (int i = 0; left_s > 0; ++i) {
    coupled_.follow(target_, of_target);
    const double regular_s = regular_piece_s(of_target, h_s);
    const double piece_s = left_s / std::ceil(left_s / regular_s - rounding);
    const double done_s = world_->advance(std::min(piece_s, longest_after_hit_s(regular_s)),
                                          {coupled_, regular_s, i < most_cuts});
    left_s = done_s > (1 - rounding) * left_s ? 0 : left_s - done_s;
    target_ = left_s > 0 ? interpolate(from, target, 1 - left_s / h_s) : target;
    coupled_.keep_on(target_, clone());
    note_impulses();
  }
  last_h_s_ = h_s;
}

// Of a step of h_s seconds.
double BoxesSimulator::regular_piece_s(const Velocity& of_target, double h_s) {
  const double travel_m =
      h_s * std::max(clone().tip_speed_m_s(clone().velocity), clone().tip_speed_m_s(of_target));
  const bool near = world_->near_driven(near_m + travel_m);
  const double n_swinging = near ? h_s * coupled_.fastest_per_s() / oscillation_rad : 0;
  const double n_turning = h_s * world_->fastest_turn_rad_s() / turn_rad;
  const double n = std::max(n_turning, n_swinging);
  return h_s / std::clamp(std::ceil(n), 1.0, most_pieces);
}

// How a push grows is known from the piece before, but not after a hit.
double BoxesSimulator::longest_after_hit_s(double regular_s) {
  return clone().pushed_s > 0 ? 2 * clone().pushed_s : regular_s / 8;
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
