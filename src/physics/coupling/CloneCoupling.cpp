#include "physics/coupling/CloneCoupling.h"

#include "base/Pose.h"
#include "physics/scene/BoxInertia.h"

namespace heft {

using Eigen::Vector3d;

CloneCoupling::CloneCoupling(CouplingScheme scheme, const Scene& scene, bool locked)
    : locked_(locked) {
  const Coupling& coupling = scene.coupling;
  const double m = coupling.clone_mass_kg, z = coupling.damping_ratio;
  const Vector3d inertia = box_inertia_kg_m2(m, scene.effector_size_m);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    translation_[i] = {scheme, {m, coupling.stiffness_n_per_m, z}};
    rotation_[i] = {scheme, {inertia[e], coupling.torsional_stiffness_nm_per_rad, z}};
  }
}

void CloneCoupling::restart(const BodyState& clone, const Velocity& target_velocity) {
  const auto own = clone.pose.orientation.conjugate();
  const Vector3d own_turn = own * clone.velocity.angular_rad_s;
  const Vector3d own_target_turn = own * target_velocity.angular_rad_s;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    translation_[i].restart(clone.velocity.linear_m_s[e], target_velocity.linear_m_s[e]);
    rotation_[i].restart(own_turn[e], own_target_turn[e]);
  }
}

CoupledClone CloneCoupling::begin(const Pose& clone, const Pose& from, const Pose& to, double h_s) {
  const Velocity of_target = mean_velocity(from, to, h_s);
  const Vector3d offset_m = clone.position_m - from.position_m;
  CoupledClone free;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    const FreeStep step = translation_[i].begin(offset_m[e], of_target.linear_m_s[e], h_s);
    free.mass_kg = step.solver_mass;
    free.velocity.linear_m_s[e] = step.velocity;
  }
  if (locked_)
    free.velocity.angular_rad_s = mean_velocity(clone, to, h_s).angular_rad_s;
  else
    begin_turn(clone, from, of_target, h_s, free);
  return free;
}

void CloneCoupling::begin_turn(const Pose& clone, const Pose& from, const Velocity& of_target,
                               double h_s, CoupledClone& free) {
  const auto& own = clone.orientation;
  const Vector3d offset_rad = rotation_vector(from.orientation.conjugate() * own);
  const Vector3d target_turn = own.conjugate() * of_target.angular_rad_s;
  Vector3d turn;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    const FreeStep step = rotation_[i].begin(offset_rad[e], target_turn[e], h_s);
    free.inertia_kg_m2[e] = step.solver_mass;
    turn[e] = step.velocity;
  }
  free.velocity.angular_rad_s = own * turn;
}

void CloneCoupling::end(const BodyState& clone) {
  const Vector3d turn = clone.pose.orientation.conjugate() * clone.velocity.angular_rad_s;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    translation_[i].end(clone.velocity.linear_m_s[e]);
    if (!locked_) rotation_[i].end(turn[e]);
  }
}

}  // namespace heft
