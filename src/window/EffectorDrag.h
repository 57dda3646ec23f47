// The dragged effector: taken by a finger or the mouse, moved over the table at constant height,
// and turned. The pointer's position is where its ray meets that height.
#pragma once

#include <memory>
#include <optional>

#include "experiment/Stage.h"
#include "view/ArView.h"
#include "view/screens/Page.h"

namespace heft {

class EffectorDrag {
 public:
  /// @param setup with the effector
  explicit EffectorDrag(const ViewSetup& setup);

  /// Height at which pointers are projected.
  double height_m() const { return effector_->pose.position_m.z(); }

  /// Whether a point is over the effector. @param at_m board frame, at height_m()
  bool is_at(const Eigen::Vector3d& at_m) const;

  /// Takes the effector if the pointer is over it and no other pointer has it.
  void take(Taps::Pointer pointer, const Eigen::Vector3d& at_m);
  /// Moves the effector with the pointer that has it, within the working area.
  void move(Taps::Pointer pointer, const Eigen::Vector3d& at_m);
  void let_go(Taps::Pointer pointer);
  void let_go() { holder_.reset(); }
  bool is_held_by(Taps::Pointer pointer) const { return holder_ == pointer; }

  /// Turns it about the vertical axis, counterclockwise as seen from above.
  void turn(double notches);

  /// Whether it was ever taken, after which no hint is needed.
  bool was_taken() const { return was_taken_; }

 private:
  std::shared_ptr<DraggedEffector> effector_;
  Eigen::Vector2d half_m_, reach_m_;
  std::optional<Taps::Pointer> holder_;
  Eigen::Vector3d from_pointer_m_{0, 0, 0};
  bool was_taken_ = false;
};

}  // namespace heft
