#include "window/EffectorDrag.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace heft {

namespace {
// A finger this far beside the effector still takes it.
constexpr double around_m = 0.01;
constexpr double turn_rad = 5 * std::numbers::pi / 180;  // per notch of the wheel
}  // namespace

EffectorDrag::EffectorDrag(const ViewSetup& setup)
    : effector_(setup.dragged),
      half_m_(setup.stage.effector_size_m.head<2>() / 2),
      reach_m_(setup.area_m / 2) {}

bool EffectorDrag::is_at(const Eigen::Vector3d& at_m) const {
  const Pose& pose = effector_->pose;
  const Eigen::Vector3d in_box_m = pose.orientation.conjugate() * (at_m - pose.position_m);
  return ((in_box_m.head<2>().cwiseAbs() - half_m_).array() <= around_m).all();
}

void EffectorDrag::take(Taps::Pointer pointer, const Eigen::Vector3d& at_m) {
  if (holder_ || !is_at(at_m)) return;
  holder_ = pointer;
  from_pointer_m_ = effector_->pose.position_m - at_m;
  was_taken_ = true;
}

void EffectorDrag::move(Taps::Pointer pointer, const Eigen::Vector3d& at_m) {
  if (!is_held_by(pointer)) return;
  const Eigen::Vector2d to_m = (at_m + from_pointer_m_).head<2>();
  effector_->pose.position_m.head<2>() = to_m.cwiseMax(-reach_m_).cwiseMin(reach_m_);
}

void EffectorDrag::let_go(Taps::Pointer pointer) {
  if (is_held_by(pointer)) holder_.reset();
}

void EffectorDrag::turn(double notches) {
  Eigen::Quaterniond& orientation = effector_->pose.orientation;
  const Eigen::AngleAxisd turned(notches * turn_rad, Eigen::Vector3d::UnitZ());
  orientation = (turned * orientation).normalized();
}

}  // namespace heft
