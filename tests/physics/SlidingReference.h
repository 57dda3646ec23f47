// An independent reference for boxes that slide without rotation. Steps are microseconds and
// contacts are stiff, overdamped springs; there are no constraints, impulses or events.
//
// All boxes are aligned with one heading. The load of a cube on the table or on another cube is its
// weight and that of the cubes on it. Coulomb friction is exact for one contact and iterated for
// several.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "base/PoseTypes.h"
#include "physics/scene/Scene.h"

namespace heft {

class SlidingReference {
 public:
  using Vec = Eigen::Vector2d;

  /// @param heading_rad with which all boxes are aligned
  /// @param effector_turned its long side is across the heading
  SlidingReference(const Scene& scene, double heading_rad, bool effector_turned, const Pose& hand)
      : scene_(scene), along_(std::cos(heading_rad), std::sin(heading_rad)) {
    const Eigen::Vector3d& e = scene.effector_size_m;
    bodies_.push_back({turned(hand.position_m), Vec::Zero(),
                       effector_turned ? Vec(e.y() / 2, e.x() / 2) : Vec(e.x() / 2, e.y() / 2),
                       scene.coupling.clone_mass_kg, 0, 0});
    for (const Cube& cube : scene.cubes) {
      Body body{
          turned(cube.position_m), Vec::Zero(), cube.size_m.head<2>() / 2, cube.mass_kg, 0, 0};
      for (std::size_t i = 0; i < scene.cubes.size(); ++i)
        if (scene.cubes[i].position_m.z() < cube.position_m.z() - 0.005) body.on = i + 1;
      bodies_.push_back(body);
    }
    for (std::size_t i = 1; i < bodies_.size(); ++i)
      for (std::size_t j = i; j > 0; j = bodies_[j].on)
        bodies_[j].load_n += scene.gravity_m_s2 * bodies_[i].mass_kg;
    hand_ = turned(hand.position_m);
  }

  /// The hand moves straight to this pose; dt_s is divided into steps of 2 us.
  void advance(const Pose& hand, double dt_s) {
    const int n = static_cast<int>(std::ceil(dt_s / step_s));
    const Vec velocity = (turned(hand.position_m) - hand_) / dt_s;
    for (int i = 0; i < n; ++i) step(velocity, dt_s / n);
    hand_ = turned(hand.position_m);
  }

  /// Across the table; body 0 is the clone.
  Vec position_m(std::size_t body) const {
    const Vec& at = bodies_[body].at_m;
    return {at.x() * along_.x() - at.y() * along_.y(), at.x() * along_.y() + at.y() * along_.x()};
  }

 private:
  static constexpr double step_s = 2e-6, wall_n_per_m = 1e7, wall_damping_ratio = 2;
  static constexpr int n_sweeps = 3;

  struct Body {
    Vec at_m, velocity_m_s, half_m;
    double mass_kg;
    std::size_t on;  ///< 0: the table
    double load_n;   ///< of it and all that it carries
  };
  // The friction impulse of a pair so far in this step.
  struct Rub {
    std::size_t first, second;  ///< second 0 and table: the table
    bool table;
    double limit_n_s;
    bool across_x, across_y;
    Vec impulse_n_s;
  };

  Vec turned(const Eigen::Vector3d& m) const {
    return {m.x() * along_.x() + m.y() * along_.y(), -m.x() * along_.y() + m.y() * along_.x()};
  }

  void step(const Vec& hand_velocity, double dt) {
    const Coupling& coupling = scene_.coupling;
    const double k = coupling.stiffness_n_per_m, m = coupling.clone_mass_kg;
    const double c = 2 * coupling.damping_ratio * std::sqrt(k * m);
    Body& clone = bodies_[0];
    const Vec pull = -k * (clone.at_m - hand_) - c * (clone.velocity_m_s - hand_velocity);
    clone.velocity_m_s += dt / m * pull;
    hand_ += dt * hand_velocity;
    rubs_.clear();
    for (std::size_t i = 1; i < bodies_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j)
        if (bodies_[i].on == 0 && bodies_[j].on == 0) press(i, j, dt);
      const double limit = scene_.friction * bodies_[i].load_n * dt;
      rubs_.push_back({i, bodies_[i].on, bodies_[i].on == 0, limit, true, true, Vec::Zero()});
    }
    for (int i = 0; i < n_sweeps; ++i)
      for (Rub& one : rubs_) rub(one);
    for (Body& body : bodies_) body.at_m += dt * body.velocity_m_s;
  }

  void press(std::size_t i, std::size_t j, double dt) {
    Body &a = bodies_[i], &b = bodies_[j];
    const Vec between = a.at_m - b.at_m, gap = between.cwiseAbs() - a.half_m - b.half_m;
    if (gap.x() >= 0 || gap.y() >= 0) return;
    const int axis = gap.x() > gap.y() ? 0 : 1;
    const double sign = between[axis] > 0 ? 1 : -1;
    const double shared_kg = 1 / (1 / a.mass_kg + 1 / b.mass_kg);
    const double damping = 2 * wall_damping_ratio * std::sqrt(wall_n_per_m * shared_kg);
    const double opening = sign * (a.velocity_m_s[axis] - b.velocity_m_s[axis]);
    const double force = -wall_n_per_m * gap[axis] - damping * opening;
    if (force <= 0) return;
    a.velocity_m_s[axis] += sign * force * dt / a.mass_kg;
    b.velocity_m_s[axis] -= sign * force * dt / b.mass_kg;
    rubs_.push_back({i, j, false, scene_.friction * force * dt, axis == 1, axis == 0, Vec::Zero()});
  }

  void rub(Rub& rub) {
    Body& a = bodies_[rub.first];
    Vec slip = a.velocity_m_s;
    double per_kg = 1 / a.mass_kg;
    if (!rub.table) {
      slip -= bodies_[rub.second].velocity_m_s;
      per_kg += 1 / bodies_[rub.second].mass_kg;
    }
    if (!rub.across_x) slip.x() = 0;
    if (!rub.across_y) slip.y() = 0;
    Vec impulse = rub.impulse_n_s - slip / per_kg;
    if (impulse.norm() > rub.limit_n_s) impulse *= rub.limit_n_s / impulse.norm();
    const Vec more = impulse - rub.impulse_n_s;
    rub.impulse_n_s = impulse;
    a.velocity_m_s += more / a.mass_kg;
    if (!rub.table) bodies_[rub.second].velocity_m_s -= more / bodies_[rub.second].mass_kg;
  }

  Scene scene_;
  Vec along_;
  Vec hand_;
  std::vector<Body> bodies_;
  std::vector<Rub> rubs_;
};

}  // namespace heft
