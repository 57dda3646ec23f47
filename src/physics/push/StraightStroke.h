// The movements that `push` and `quasi_static` model, along one line: the effector moves straight
// and level without rotation and pushes at most one cube, so squarely that it neither rotates nor
// tips. All other movements throw OutsideModel. Coordinates along the line are those of the clone's
// center, in meters from the effector's position at the start of the line.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "physics/DecouplingSimulator.h"

namespace heft {

class StraightStroke {
 public:
  StraightStroke() = default;
  /// @throws OutsideModel if the start of the scene is outside the model
  StraightStroke(const Scene& scene, const Pose& target);

  /// Adds the effector's next pose. The first that differs from the start sets the line's
  /// direction.
  /// @return its coordinate along the line
  /// @throws OutsideModel if it leaves the line or rotates
  double follow(const Pose& target);

  /// Starts a new line at this pose.
  void restart(const Pose& target);

  /// @throws OutsideModel if the cube does not stand on the table
  void place_cube(std::size_t cube, const Pose& pose);

  double clone_start() const { return clone_start_; }
  bool has_direction() const { return direction_.has_value(); }
  /// Unit vector; zero while the line has no direction.
  Eigen::Vector3d direction() const { return direction_.value_or(Eigen::Vector3d::Zero()); }

  const Scene& scene() const { return scene_; }

  /// The next cube along the line, and the clone's coordinate at which it touches the cube.
  std::optional<std::size_t> cube() const { return cube_; }
  /// Force at which that cube slides.
  double slide_n() const;
  double contact() const { return contact_; }

  /// Moves the cube so that the clone touches it at this coordinate.
  void move_cube_to(double contact);

  /// @param touching whether the clone pushes the cube
  /// @throws OutsideModel if the cube would rotate or tip, or the clone or cube touches another box
  void check(double clone, bool touching);

  /// @param force_n mean force of the clone on the cube over the last step
  WorldState state(double clone, double clone_m_s, double cube_m_s, double force_n) const;

 private:
  static constexpr double straight_m = 0.05e-3, straight_rad = 1e-3;
  static constexpr double still_m = 1e-9;  ///< smaller movements have no direction
  static constexpr double still_cosine = 1 - straight_rad * straight_rad / 8;  ///< of half of it

  [[noreturn]] void refuse(double off_m2) const;
  [[noreturn]] void refuse_place(double clone) const;
  void look_ahead();
  void set_direction(const Eigen::Vector3d& direction);
  void check_square() const;
  double turned_aside_m(double aside_m) const;
  double half_along(const Pose& pose, const Eigen::Vector3d& size_m) const;
  bool beside(const Pose& a, const Eigen::Vector3d& a_size_m, const Pose& b,
              const Eigen::Vector3d& b_size_m) const;

  Scene scene_;
  Pose start_;
  std::vector<Pose> cubes_;
  std::optional<Eigen::Vector3d> direction_;
  double clone_start_ = 0;
  std::optional<std::size_t> cube_;
  bool square_ = false;  ///< the push has been checked to be square
  double contact_ = 0;
  // Limits of the clone's coordinate by cubes behind it and further ones ahead, and of `contact_`
  // by cubes ahead of the pushed one.
  double behind_ = 0, blocked_ = 0, cube_blocked_ = 0;
};

inline double StraightStroke::follow(const Pose& target) {
  const Eigen::Vector3d moved_m = target.position_m - start_.position_m;
  if (!direction_ && moved_m.norm() >= still_m) set_direction(moved_m);
  const double along = moved_m.dot(direction());
  const double off_m2 = (moved_m - along * direction()).squaredNorm();
  const double turned = std::abs(start_.orientation.dot(target.orientation));
  if (off_m2 > straight_m * straight_m || turned < still_cosine) refuse(off_m2);
  return along;
}

inline void StraightStroke::move_cube_to(double contact) {
  cubes_[*cube_].position_m += (contact - contact_) * *direction_;
  contact_ = contact;
}

inline void StraightStroke::check(double clone, bool touching) {
  if (!direction_) return;
  if (clone < behind_ || clone > blocked_ || (cube_ && contact_ > cube_blocked_))
    refuse_place(clone);
  if (!touching || square_) return;
  check_square();
  square_ = true;
}

}  // namespace heft
