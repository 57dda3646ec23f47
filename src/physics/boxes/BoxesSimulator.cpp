// `boxes`: the decoupling technique on a contact solver for a few boxes on a table. Law:
// physics/coupling/CouplingLaw.h; contacts: boxes/BoxWorld.h.
//
// Exact coupling in translation. The orientation is locked to the effector where the torsional
// spring is stiff enough (as the paper's), otherwise coupled exactly about each axis. Coulomb
// friction on its disk.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/Pose.h"
#include "physics/DecouplingSimulator.h"
#include "physics/boxes/BoxWorld.h"
#include "physics/coupling/CouplingLaw.h"
#include "physics/scene/Scene.h"

namespace heft {

namespace {
using boxes::Body;
using boxes::BoxWorld;
using boxes::Motion;
using Eigen::Vector3d;

// Near boxes a step is divided into pieces, because forces and lever arms are constant over a
// piece. Limits of the phase of the clone's oscillator and of the rotation of a box in one piece;
// max_pieces takes precedence.
constexpr double oscillation_rad = 0.4, rotation_rad = 0.05;
// Rate for a coupled clone, which has no oscillator but throws cubes ahead and meets them again.
constexpr double coupled_per_s = 190;
constexpr double proximity_m = 5e-3;
constexpr double max_pieces = 32;
constexpr double rounding = 1e-9;
constexpr int max_event_pieces = 24;  // of a step; further pieces use speculative contacts

// Smallest ratio of the tip's displacement by translation to that by rotation for a locked
// orientation. With the paper's spring and effector it corresponds to 68 N m/rad, where 10 cm of
// translation go with 0.1 mm of rotation.
constexpr double locked_ratio = 482;

// Whether the torsional spring is so stiff that rotation adds nothing to the lag. A clone that is
// released with an angular offset rotates in any case.
bool orientation_is_locked(const Scene& scene) {
  const Coupling& coupling = scene.coupling;
  const double lever_m = scene.effector_size_m.norm() / 2;
  const bool stiff = coupling.torsional_stiffness_nm_per_rad >=
                     locked_ratio * coupling.stiffness_n_per_m * lever_m * lever_m;
  return stiff && rotation_vector(scene.clone_offset.orientation).norm() < 1e-9;
}

// Drives the clone by the coupling, with a target that moves at a constant velocity.
class CloneDriver : public boxes::Driver {
 public:
  CloneDriver() = default;
  explicit CloneDriver(const Scene& scene)
      : decoupled_(scene.coupling.decoupled),
        locked_(orientation_is_locked(scene)),
        mass_kg_(scene.coupling.clone_mass_kg),
        inertia_kg_m2_(box_inertia_kg_m2(mass_kg_, scene.effector_size_m)),
        coupling_(scene.coupling) {}

  /// Sets the coordinates that are not free to the target's, without rounding.
  void constrain(const Pose& target, Body& clone) const {
    if (!decoupled_)
      clone.set_pose(target);
    else if (locked_)
      clone.set_pose({clone.pose.position_m, target.orientation});
  }
  /// Largest rate of its oscillator or decay, 1/s.
  double max_rate_per_s() const {
    if (!decoupled_) return coupled_per_s;
    const double z = std::max(1.0, coupling_.damping_ratio);
    return std::sqrt(coupling_.stiffness_n_per_m / mass_kg_) * (z + std::sqrt(z * z - 1));
  }
  void set_target(const Pose& from, const Velocity& velocity) {
    from_ = from;
    velocity_ = velocity;
  }

  void set_motion(Body& clone, const boxes::StepTime& time) const override {
    Motion& step = clone.step;
    step.mean = step.end = velocity_;
    step.inverse_mass = 0;
    step.rotates = false;
    if (!decoupled_) {
      clone.velocity = velocity_;
      return;
    }
    if (time.h_s > 0)
      set_translation(clone, time, step);
    else
      step.inverse_mass = 1 / mass_kg_;
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
    if (clone.force_duration_s > h_s / 2 && h_s * max_rate_per_s() < 1) {
      // The contact force changes linearly from the middle of the last step, with this slope per
      // newton of difference.
      const double growth_per_s = 2 / (h_s + clone.force_duration_s);
      const double mean_by_growth = growth_per_s * axis.offset_by_growth / h_s;
      const double end_by_growth = growth_per_s * axis.velocity_by_growth;
      mean_per_kg += mean_by_growth / h_s;
      end_per_kg += end_by_growth / h_s;
      step.mean.linear_m_s -= mean_by_growth * clone.mean_force_n;
      step.end.linear_m_s -= end_by_growth * clone.mean_force_n;
    }
    end_per_kg = std::max(0.0, end_per_kg);  // negative for a stiff spring in a long step
    step.inverse_mass = end_per_kg + mean_weight * (mean_per_kg - end_per_kg);
    step.mean_per_constrained = mean_per_kg / step.inverse_mass;
  }

  // The same about each body axis.
  void set_rotation(const Body& clone, const boxes::StepTime& time, Motion& step) const {
    const double h_s = time.h_s, mean_weight = time.mean_weight();
    const auto& own = clone.pose.orientation;
    const Vector3d offset_rad = rotation_vector(from_.orientation.conjugate() * own);
    const Vector3d relative_rad_s =
        own.conjugate() * (clone.velocity.angular_rad_s - velocity_.angular_rad_s);
    Vector3d mean_rad_s = Vector3d::Zero(), end_rad_s = mean_rad_s, inverse_inertia,
             mean_per_constrained;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto e = static_cast<Eigen::Index>(i);
      const double kappa = coupling_.torsional_stiffness_nm_per_rad;
      const CouplingAxis axis{inertia_kg_m2_[e], kappa, coupling_.damping_ratio};
      if (!(h_s > 0)) {
        inverse_inertia[e] = mean_per_constrained[e] = 1 / axis.mass;
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
      inverse_inertia[e] = end_per_kg_m2 + mean_weight * (mean_per_kg_m2 - end_per_kg_m2);
      mean_per_constrained[e] = mean_per_kg_m2 / inverse_inertia[e];
    }
    const Eigen::Matrix3d axes = clone.shape.axes;
    step.mean.angular_rad_s += axes * mean_rad_s;
    step.end.angular_rad_s += axes * end_rad_s;
    step.inverse_inertia = axes * inverse_inertia.asDiagonal() * axes.transpose();
    step.mean_rotation_per_constrained =
        axes * mean_per_constrained.asDiagonal() * axes.transpose();
    step.rotates = true;
  }

  // Response of one axis, cached because most steps have equal length.
  struct CachedStep {
    double h_s = 0;
    OscillatorStep step;
    const OscillatorStep& of(const CouplingAxis& axis, double for_s) {
      if (std::abs(for_s - h_s) > 1e-12 * for_s) {  // rounding of time differences
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
  mutable std::array<CachedStep, 4> steps_;
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
  void add_impulses();
  double max_piece_s(const Velocity& target_velocity, double h_s);
  double max_piece_after_impact_s(double regular_s);

  std::size_t n_cubes_ = 0;
  std::optional<BoxWorld> world_;
  CloneDriver clone_driver_;
  Pose target_;
  std::vector<Vector3d> impulse_n_s_;  // of the clone on each cube, over the last step
  double last_h_s_ = 0;
};

void BoxesSimulator::reset(const Scene& scene, const Pose& target) {
  n_cubes_ = scene.cubes.size();
  target_ = target;
  last_h_s_ = 0;
  impulse_n_s_.assign(n_cubes_, Vector3d::Zero());
  clone_driver_ = CloneDriver(scene);
  const boxes::ContactSurface surface{scene.friction, scene.contact_compliance_m_per_n,
                                      scene.coupling.decoupled};
  world_.emplace(surface, scene.gravity_m_s2, n_cubes_ + 1);
  Body clone;
  clone.driven = true;
  clone.set_size(scene.effector_size_m);
  clone.reset(clone_start(scene, target), {});
  world_->add(clone);
  for (const Cube& cube : scene.cubes) {
    Body body;
    body.set_size(cube.size_m);
    body.mass_kg = cube.mass_kg;
    body.table_friction = cube.table_friction;
    body.inertia_kg_m2 = box_inertia_kg_m2(cube.mass_kg, cube.size_m);
    body.reset(upright_pose(cube.position_m, cube.yaw_rad), {});
    world_->add(body);
  }
  if (scene.contact_compliance_m_per_n == 0)
    world_->sleep_resting_bodies();  // compliant ones sink first
}

void BoxesSimulator::step(const Pose& target, double h_s) {
  for (Vector3d& impulse_n_s : impulse_n_s_) impulse_n_s.setZero();
  const Velocity target_velocity = mean_velocity(target_, target, h_s);
  const Pose from = target_;
  double left_s = h_s;
  for (int i = 0; left_s > 0; ++i) {
    clone_driver_.set_target(target_, target_velocity);
    const double regular_s = max_piece_s(target_velocity, h_s);
    const double piece_s = left_s / std::ceil(left_s / regular_s - rounding);
    const double done_s = world_->advance(std::min(piece_s, max_piece_after_impact_s(regular_s)),
                                          {clone_driver_, regular_s, i < max_event_pieces});
    left_s = done_s > (1 - rounding) * left_s ? 0 : left_s - done_s;
    target_ = left_s > 0 ? interpolate(from, target, 1 - left_s / h_s) : target;
    clone_driver_.constrain(target_, clone());
    add_impulses();
  }
  last_h_s_ = h_s;
}

double BoxesSimulator::max_piece_s(const Velocity& target_velocity, double h_s) {
  const double travel_m = h_s * std::max(clone().point_speed_bound_m_s(clone().velocity),
                                         clone().point_speed_bound_m_s(target_velocity));
  const bool near = world_->driven_body_within(proximity_m + travel_m);
  const double n_oscillation = near ? h_s * clone_driver_.max_rate_per_s() / oscillation_rad : 0;
  const double n_rotation = h_s * world_->max_angular_speed_rad_s() / rotation_rad;
  const double n = std::max(n_rotation, n_oscillation);
  return h_s / std::clamp(std::ceil(n), 1.0, max_pieces);
}

// The slope of the contact force is known from the piece before, but not after an impact.
double BoxesSimulator::max_piece_after_impact_s(double regular_s) {
  return clone().force_duration_s > 0 ? 2 * clone().force_duration_s : regular_s / 8;
}

void BoxesSimulator::add_impulses() {
  for (std::size_t cube = 0; cube < n_cubes_; ++cube)
    if (!world_->body(index_of(cube)).asleep)
      impulse_n_s_[cube] += world_->impulse_n_s(clone_index, index_of(cube));
}

void BoxesSimulator::teleport_clone(const Pose& target, const Velocity& velocity) {
  target_ = target;
  clone().reset(target, velocity);
  world_->forget_contacts(clone_index);
}

void BoxesSimulator::place_cube(int cube, const Pose& pose) {
  const std::size_t i = index_of(static_cast<std::size_t>(cube));
  world_->body(i).reset(pose, {});
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
