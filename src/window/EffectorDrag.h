// An effector that a finger or the mouse drags over the table: where it is taken, how it follows,
// how it is turned. It keeps its height; the pointer is where its ray meets that.
#pragma once

#include <memory>
#include <optional>

#include "experiment/Stage.h"
#include "view/ArView.h"
#include "view/screens/Page.h"

namespace heft {

class EffectorDrag {
 public:
  /// @param setup whose effector there is
  explicit EffectorDrag(const ViewSetup& setup);

  /// The height that pointers are to be told at.
  double height_m() const { return effector_->pose.position_m.z(); }

  /// Whether a pointer there is over it. @param at_m board frame, at height_m()
  bool is_at(const Eigen::Vector3d& at_m) const;

  /// The pointer has it from now on, if it is over it and no other pointer has it.
  void take(Taps::Pointer pointer, const Eigen::Vector3d& at_m);
  /// It goes where the pointer that has it goes, as far as its working area reaches.
  void move(Taps::Pointer pointer, const Eigen::Vector3d& at_m);
  void let_go(Taps::Pointer pointer);
  void let_go() { holder_.reset(); }
  bool is_held_by(Taps::Pointer pointer) const { return holder_ == pointer; }

  /// Turns it about the vertical, counterclockwise as seen from above.
  void turn(double notches);

  /// It was taken once: whoever did knows how.
  bool was_taken() const { return was_taken_; }

 private:
  std::shared_ptr<DraggedEffector> effector_;
  Eigen::Vector2d half_m_, reach_m_;
  std::optional<Taps::Pointer> holder_;
  Eigen::Vector3d from_pointer_m_{0, 0, 0};
  bool was_taken_ = false;
};

}  // namespace heft
