#include "physics/boxes/CloneCoupling.h"

#include "physics/BoxInertia.h"

namespace heft::boxes {

using Eigen::Vector3d;

namespace {
// How many times more a push at the tip moves the clone than it turns the tip aside, at least.
constexpr double locked_ratio = 100;

bool is_locked(const Scene& scene) {
  const Coupling& coupling = scene.coupling;
  const double lever_m = scene.effector_size_m.norm() / 2;
  const bool stiff = coupling.torsional_stiffness_nm_per_rad >=
                     locked_ratio * coupling.stiffness_n_per_m * lever_m * lever_m;
  return stiff && rotation_vector(scene.clone_offset.orientation).norm() < 1e-9;
}
}  // namespace

Velocity mean_velocity_of(const Pose& from, const Pose& to, double dt_s) {
  if (from.orientation.coeffs() != to.orientation.coeffs()) return mean_velocity(from, to, dt_s);
  return {(to.position_m - from.position_m) / dt_s, Vector3d::Zero()};
}

CloneCoupling::CloneCoupling(const Scene& scene) : locked_(is_locked(scene)) {
  const Coupling& coupling = scene.coupling;
  const double m = coupling.clone_mass_kg, z = coupling.damping_ratio;
  const Vector3d inertia = box_inertia_kg_m2(m, scene.effector_size_m);
  for (std::size_t i = 0; i < 3; ++i) {
    translation_[i] = {CouplingScheme::exact, {m, coupling.stiffness_n_per_m, z}};
    rotation_[i] = {
        CouplingScheme::exact,
        {inertia[static_cast<Eigen::Index>(i)], coupling.torsional_stiffness_nm_per_rad, z}};
  }
}

void CloneCoupling::restart(const Body& clone, const Velocity& clone_velocity,
                            const Velocity& target_velocity) {
  const auto own = clone.pose.orientation.conjugate();
  const Vector3d own_turn = own * clone_velocity.angular_rad_s;
  const Vector3d own_target_turn = own * target_velocity.angular_rad_s;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    translation_[i].restart(clone_velocity.linear_m_s[e], target_velocity.linear_m_s[e]);
    rotation_[i].restart(own_turn[e], own_target_turn[e]);
  }
}

void CloneCoupling::begin(Body& clone, const Pose& from, const Pose& to, double h_s) {
  const Velocity of_target = mean_velocity_of(from, to, h_s);
  const Vector3d offset_m = clone.pose.position_m - from.position_m;
  double solver_mass_kg = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    const FreeStep free = translation_[i].begin(offset_m[e], of_target.linear_m_s[e], h_s);
    solver_mass_kg = free.solver_mass;
    clone.velocity.linear_m_s[e] = free.velocity;
  }
  if (locked_)
    clone.velocity.angular_rad_s = mean_velocity_of(clone.pose, to, h_s).angular_rad_s;
  else
    begin_turn(clone, from, of_target, h_s);
  clone.set_mass(solver_mass_kg, solver_inertia_kg_m2_);
}

void CloneCoupling::begin_turn(Body& clone, const Pose& from, const Velocity& of_target,
                               double h_s) {
  const auto& own = clone.pose.orientation;
  const Vector3d offset_rad = rotation_vector(from.orientation.conjugate() * own);
  const Vector3d target_turn = own.conjugate() * of_target.angular_rad_s;
  Vector3d turn;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    const FreeStep free = rotation_[i].begin(offset_rad[e], target_turn[e], h_s);
    solver_inertia_kg_m2_[e] = free.solver_mass;
    turn[e] = free.velocity;
  }
  clone.velocity.angular_rad_s = own * turn;
}

void CloneCoupling::end(Body& clone, const Pose& to) {
  const Vector3d turn = clone.pose.orientation.conjugate() * clone.velocity.angular_rad_s;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    translation_[i].end(clone.velocity.linear_m_s[e]);
    if (!locked_) rotation_[i].end(turn[e]);
  }
  if (locked_) clone.place({clone.pose.position_m, to.orientation});
}

}  // namespace heft::boxes
