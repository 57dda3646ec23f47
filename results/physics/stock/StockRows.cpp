// Couplings by rows of Bullet's constraint solver.
#include <array>
#include <cmath>

#include "base/Pose.h"
#include "physics/bullet/RigidBox.h"
#include "results/physics/stock/StockWorld.h"

namespace heft {

namespace {
using Eigen::Vector3d;

// Six rows between the clone and the world: three of translation, three about the clone's axes.
class SoftRows : public btTypedConstraint {
 public:
  SoftRows(StockWorld& world, const Coupling& coupling)
      : btTypedConstraint(POINT2POINT_CONSTRAINT_TYPE, world.clone()) {
    axes_.fill({coupling.clone_mass_kg, coupling.stiffness_n_per_m, coupling.damping_ratio});
    for (std::size_t i = 0; i < 3; ++i)
      axes_[i + 3] = {world.clone_inertia_kg_m2()[static_cast<Eigen::Index>(i)],
                      coupling.torsional_stiffness_nm_per_rad, coupling.damping_ratio};
  }

  void aim(const TargetStep& target) { target_ = target; }

  void getInfo1(btConstraintInfo1* info) override {
    info->m_numConstraintRows = 6;
    info->nub = 0;
  }

  void getInfo2(btConstraintInfo2* info) override {
    const Pose clone = pose_of(getRigidBodyA());
    const Velocity of_target = mean_velocity(target_.from, target_.to, target_.h_s);
    const Vector3d offset_m = clone.position_m - target_.from.position_m;
    const Vector3d offset_rad =
        rotation_vector(target_.from.orientation.conjugate() * clone.orientation);
    const Eigen::Matrix3d own = clone.orientation.toRotationMatrix();
    for (int i = 0; i < 3; ++i) {
      const Vector3d world_axis = Vector3d::Unit(i), own_axis = own.col(i);
      write_axis(info->m_J1linearAxis + i * info->rowskip, world_axis);
      write_row(info, i, offset_m[i], of_target.linear_m_s[i]);
      write_axis(info->m_J1angularAxis + (i + 3) * info->rowskip, own_axis);
      write_row(info, i + 3, offset_rad[i], own_axis.dot(of_target.angular_rad_s));
    }
  }

  void setParam(int, btScalar, int) override {}
  btScalar getParam(int, int) const override { return 0; }

 private:
  static void write_axis(btScalar* row, const Vector3d& axis) {
    for (Eigen::Index i = 0; i < 3; ++i) row[i] = axis[i];
  }

  void write_row(btConstraintInfo2* info, int row, double offset, double target_velocity) const {
    const CouplingAxis& axis = axes_[static_cast<std::size_t>(row)];
    const double h_s = target_.h_s, hk = h_s * axis.stiffness;
    const double c = axis.damping_ratio * 2 * std::sqrt(axis.stiffness * axis.mass);
    info->m_constraintError[row * info->rowskip] = target_velocity - offset * hk / (hk + c) / h_s;
    // Bullet expects force mixing in units of the row's inverse mass.
    info->cfm[row * info->rowskip] = axis.mass / (h_s * (hk + c));
  }

  std::array<CouplingAxis, 6> axes_;
  TargetStep target_;
};

class RowCoupling : public StockCoupling {
 public:
  RowCoupling(StockWorld& world, const Coupling& coupling)
      : bullet_(world.bullet()), rows_(world, coupling) {
    bullet_.addConstraint(&rows_);
  }
  ~RowCoupling() override { bullet_.removeConstraint(&rows_); }

  void step(StockWorld& world, const TargetStep& target) override {
    rows_.aim(target);
    world.step(target.h_s);
  }

 private:
  btDiscreteDynamicsWorld& bullet_;
  SoftRows rows_;
};

// A spring from the clone to a kinematic body that touches nothing.
class SpringCoupling : public StockCoupling {
 public:
  SpringCoupling(StockWorld& world, const Coupling& coupling)
      : bullet_(world.bullet()),
        hand_(0, nullptr, &point_),
        spring_(hand_, world.clone(), btTransform::getIdentity(), btTransform::getIdentity()) {
    hand_.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    hand_.setActivationState(DISABLE_DEACTIVATION);
    bullet_.addRigidBody(&hand_, 0, 0);
    const double m = coupling.clone_mass_kg, k = coupling.stiffness_n_per_m;
    const double kappa = coupling.torsional_stiffness_nm_per_rad;
    for (int i = 0; i < 3; ++i) {
      set_axis(i, k, coupling.damping_ratio * 2 * std::sqrt(k * m));
      set_axis(i + 3, kappa,
               coupling.damping_ratio * 2 * std::sqrt(kappa * world.clone_inertia_kg_m2()[i]));
    }
    bullet_.addConstraint(&spring_, true);
  }
  ~SpringCoupling() override {
    bullet_.removeConstraint(&spring_);
    bullet_.removeRigidBody(&hand_);
  }

  void step(StockWorld& world, const TargetStep& target) override {
    hand_.setCenterOfMassTransform(to_bullet(target.from));
    hand_.setCenterOfMassTransform(to_bullet(target.to));  // its velocity is the difference
    world.step(target.h_s);
  }

 private:
  void set_axis(int axis, double stiffness, double damping) {
    spring_.setLimit(axis, 1, -1);  // free
    spring_.enableSpring(axis, true);
    spring_.setStiffness(axis, stiffness);
    spring_.setDamping(axis, damping);
    spring_.setEquilibriumPoint(axis, 0);
  }

  btDiscreteDynamicsWorld& bullet_;
  btSphereShape point_{0.001};
  btRigidBody hand_;
  btGeneric6DofSpring2Constraint spring_;
};
}  // namespace

std::unique_ptr<StockCoupling> soft_rows(StockWorld& world, const Coupling& coupling) {
  return std::make_unique<RowCoupling>(world, coupling);
}

std::unique_ptr<StockCoupling> six_dof_spring(StockWorld& world, const Coupling& coupling) {
  return std::make_unique<SpringCoupling>(world, coupling);
}

}  // namespace heft
