// Couplings by a force and a torque on the clone before Bullet's step.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "base/Pose.h"
#include "physics/bullet/RigidBox.h"
#include "results/physics/stock/StockWorld.h"

namespace heft {

namespace {
using Eigen::Vector3d;

// Force on one axis from the offset and the velocity relative to the target's, for a step of h_s.
using AxisForce = double (*)(const CouplingAxis& axis, double offset, double velocity, double h_s);

double damping(const CouplingAxis& axis) {
  return axis.damping_ratio * 2 * std::sqrt(axis.stiffness * axis.mass);
}

double as_written(const CouplingAxis& axis, double offset, double velocity, double) {
  return -axis.stiffness * offset - damping(axis) * velocity;
}

double at_the_end(const CouplingAxis& axis, double offset, double velocity, double h_s) {
  const double hk = h_s * axis.stiffness, c = damping(axis);
  return -axis.mass * (axis.stiffness * offset + (hk + c) * velocity) /
         (axis.mass + h_s * (c + hk));
}

// x(t) = A e^(l1 t) + B e^(l2 t); equal roots are separated by less than rounding.
double to_the_exact_velocity(const CouplingAxis& axis, double offset, double velocity, double h_s) {
  using Complex = std::complex<double>;
  const double omega = std::sqrt(axis.stiffness / axis.mass), z = axis.damping_ratio;
  const Complex spread = std::sqrt(Complex(std::abs(z * z - 1) < 1e-8 ? 1e-8 : z * z - 1));
  const Complex slow = omega * (-z + spread), fast = omega * (-z - spread);
  const Complex a = (velocity - fast * offset) / (slow - fast), b = offset - a;
  const Complex end = a * slow * std::exp(slow * h_s) + b * fast * std::exp(fast * h_s);
  return axis.mass * (end.real() - velocity) / h_s;
}

class ForceCoupling : public StockCoupling {
 public:
  ForceCoupling(const StockWorld& world, const Coupling& coupling, AxisForce axis_force,
                double longest_substep_s)
      : axis_force_(axis_force),
        longest_substep_s_(longest_substep_s),
        translation_{coupling.clone_mass_kg, coupling.stiffness_n_per_m, coupling.damping_ratio} {
    for (std::size_t i = 0; i < 3; ++i)
      rotation_[i] = {world.clone_inertia_kg_m2()[static_cast<Eigen::Index>(i)],
                      coupling.torsional_stiffness_nm_per_rad, coupling.damping_ratio};
  }

  void step(StockWorld& world, const TargetStep& target) override {
    const Pose clone = pose_of(world.clone());
    const Velocity relative = relative_velocity(velocity_of(world.clone()), target);
    const btVector3 force_n = to_bullet(
        force(clone.position_m - target.from.position_m, relative.linear_m_s, target.h_s));
    const btVector3 torque_nm = to_bullet(torque(clone, relative, target));
    // As stepSimulation(h, n), which holds a force over its substeps.
    const double n = std::max(1.0, std::ceil(target.h_s / longest_substep_s_ - 1e-6));
    for (double i = 0; i < n; ++i) {
      world.clone().applyCentralForce(force_n);
      world.clone().applyTorque(torque_nm);
      world.step(target.h_s / n);
    }
  }

 private:
  static Velocity relative_velocity(const Velocity& clone, const TargetStep& target) {
    const Velocity of_target = mean_velocity(target.from, target.to, target.h_s);
    return {clone.linear_m_s - of_target.linear_m_s, clone.angular_rad_s - of_target.angular_rad_s};
  }

  Vector3d force(const Vector3d& offset_m, const Vector3d& velocity_m_s, double h_s) const {
    Vector3d force_n;
    for (Eigen::Index i = 0; i < 3; ++i)
      force_n[i] = axis_force_(translation_, offset_m[i], velocity_m_s[i], h_s);
    return force_n;
  }

  // About the clone's own axes.
  Vector3d torque(const Pose& clone, const Velocity& relative, const TargetStep& target) const {
    const auto& own = clone.orientation;
    const Vector3d offset_rad = rotation_vector(target.from.orientation.conjugate() * own);
    const Vector3d turn_rad_s = own.conjugate() * relative.angular_rad_s;
    Vector3d torque_nm;
    for (Eigen::Index i = 0; i < 3; ++i)
      torque_nm[i] = axis_force_(rotation_[static_cast<std::size_t>(i)], offset_rad[i],
                                 turn_rad_s[i], target.h_s);
    return own * torque_nm;
  }

  AxisForce axis_force_;
  double longest_substep_s_;
  CouplingAxis translation_;
  std::array<CouplingAxis, 3> rotation_;
};

constexpr double no_substeps = 1e9, bullets_substep_s = 1.0 / 240;
}  // namespace

std::unique_ptr<StockCoupling> explicit_force(StockWorld& world, const Coupling& coupling) {
  return std::make_unique<ForceCoupling>(world, coupling, as_written, no_substeps);
}

std::unique_ptr<StockCoupling> held_force(StockWorld& world, const Coupling& coupling) {
  return std::make_unique<ForceCoupling>(world, coupling, as_written, bullets_substep_s);
}

std::unique_ptr<StockCoupling> stable_pd(StockWorld& world, const Coupling& coupling) {
  return std::make_unique<ForceCoupling>(world, coupling, at_the_end, no_substeps);
}

std::unique_ptr<StockCoupling> exact_velocity(StockWorld& world, const Coupling& coupling) {
  return std::make_unique<ForceCoupling>(world, coupling, to_the_exact_velocity, no_substeps);
}

}  // namespace heft
