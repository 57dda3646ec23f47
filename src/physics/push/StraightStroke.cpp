#include "physics/push/StraightStroke.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/Pose.h"
#include "base/math/Geometry.h"

namespace heft {

namespace {
using Eigen::Vector3d;

constexpr double infinite = std::numeric_limits<double>::infinity();

double half_width(const Pose& pose, const Vector3d& size_m, const Vector3d& axis) {
  return (pose.orientation.conjugate() * axis).cwiseAbs().dot(size_m) / 2;
}

Vector3d across(const Vector3d& direction) {
  return Vector3d::UnitZ().cross(direction);
}

// Whether an axis of the box is parallel to the direction.
bool is_square(const Pose& pose, const Vector3d& direction, double within_rad) {
  return (pose.orientation.conjugate() * direction).cwiseAbs().maxCoeff() > std::cos(within_rad);
}
}  // namespace

StraightStroke::StraightStroke(const Scene& scene, const Pose& target) : scene_(scene) {
  const Pose offset = scene.coupling.decoupled ? scene.clone_offset : Pose{};
  if (rotation_vector(offset.orientation).norm() > straight_rad)
    throw OutsideModel("the clone starts turned away from the effector");
  cubes_.resize(scene.cubes.size());
  restart(target);
  for (std::size_t i = 0; i < cubes_.size(); ++i) {
    place_cube(i, upright_pose(scene.cubes[i].position_m, scene.cubes[i].yaw_rad));
    const Vector3d size_m = scene.cubes[i].size_m.array() - straight_m;
    if (boxes_overlap(heft::clone_start(scene, target), scene.effector_size_m, cubes_[i], size_m))
      throw OutsideModel(fmt::format("the clone starts inside cube {}", i + 1));
  }
  const Vector3d start_m = target.orientation * offset.position_m;
  if (start_m.norm() < still_m) return;
  const Vector3d tip = target.orientation * Vector3d::UnitX();
  set_direction(start_m.dot(tip) < 0 ? Vector3d(-start_m) : start_m);
  clone_start_ = start_m.dot(*direction_);
  look_ahead();
}

void StraightStroke::restart(const Pose& target) {
  const double half_m = half_width(target, scene_.effector_size_m, Vector3d::UnitZ());
  if (target.position_m.z() - half_m < -straight_m)
    throw OutsideModel("the clone reaches into the table");
  start_ = target;
  direction_.reset();
  cube_.reset();
  clone_start_ = 0;
}

void StraightStroke::place_cube(std::size_t cube, const Pose& pose) {
  const double bottom_m =
      pose.position_m.z() - half_width(pose, scene_.cubes[cube].size_m, Vector3d::UnitZ());
  if (std::abs(bottom_m) > straight_m)
    throw OutsideModel(fmt::format("cube {} does not stand on the table", cube + 1));
  cubes_[cube] = pose;
  if (direction_) look_ahead();
}

void StraightStroke::set_direction(const Vector3d& direction) {
  direction_ = direction.normalized();
  if (std::abs(direction_->z()) > straight_rad)
    throw OutsideModel("the clone does not move level with the table");
  look_ahead();
}

void StraightStroke::refuse(double off_m2) const {
  if (off_m2 > straight_m * straight_m)
    throw OutsideModel(
        fmt::format("the effector moved {:.2g} mm off its straight line", std::sqrt(off_m2) * 1e3));
  throw OutsideModel("the effector turned");
}

double StraightStroke::half_along(const Pose& pose, const Vector3d& size_m) const {
  return half_width(pose, size_m, *direction_);
}

// Whether two boxes would collide if one moved along the line.
bool StraightStroke::beside(const Pose& a, const Vector3d& a_size_m, const Pose& b,
                            const Vector3d& b_size_m) const {
  const Vector3d between_m = b.position_m - a.position_m;
  for (const Vector3d& axis : {across(*direction_), Vector3d(Vector3d::UnitZ())})
    if (std::abs(between_m.dot(axis)) >=
        half_width(a, a_size_m, axis) + half_width(b, b_size_m, axis))
      return false;
  return true;
}

// Finds the next cube ahead of the clone and the limits of both movements.
void StraightStroke::look_ahead() {
  const auto along = [&](const Pose& pose) {
    return (pose.position_m - start_.position_m).dot(*direction_);
  };
  const double half_m = half_along(start_, scene_.effector_size_m);
  cube_.reset();
  square_ = false;
  contact_ = blocked_ = cube_blocked_ = infinite;
  behind_ = -infinite;
  for (std::size_t i = 0; i < cubes_.size(); ++i) {
    const Vector3d& size_m = scene_.cubes[i].size_m;
    if (!beside(start_, scene_.effector_size_m, cubes_[i], size_m)) continue;
    const double reach_m = half_m + half_along(cubes_[i], size_m), at = along(cubes_[i]);
    if (at < clone_start_) {
      behind_ = std::max(behind_, at + reach_m);
    } else if (at - reach_m < contact_) {
      blocked_ = contact_;
      contact_ = at - reach_m;
      cube_ = i;
    } else {
      blocked_ = std::min(blocked_, at - reach_m);
    }
  }
  if (!cube_) return;
  const Pose& pushed = cubes_[*cube_];
  const Vector3d& pushed_size_m = scene_.cubes[*cube_].size_m;
  for (std::size_t i = 0; i < cubes_.size(); ++i) {
    const Vector3d& size_m = scene_.cubes[i].size_m;
    if (i == *cube_ || along(cubes_[i]) < along(pushed)) continue;
    if (!beside(pushed, pushed_size_m, cubes_[i], size_m)) continue;
    const double gap_m = along(cubes_[i]) - along(pushed) - half_along(cubes_[i], size_m) -
                         half_along(pushed, pushed_size_m);
    cube_blocked_ = std::min(cube_blocked_, contact_ + gap_m);
  }
}

void StraightStroke::refuse_place(double clone) const {
  if (clone < behind_) throw OutsideModel("the clone moves backwards into a cube");
  throw OutsideModel("a second cube is touched");
}

double StraightStroke::slide_n() const {
  return scene_.table_friction(*cube_) * scene_.cubes[*cube_].mass_kg * scene_.gravity_m_s2;
}

// Displacement of the clone's edge by rotation under a push at that distance from its axis.
double StraightStroke::turned_aside_m(double aside_m) const {
  const double turn_rad = slide_n() * aside_m / scene_.coupling.torsional_stiffness_nm_per_rad;
  return turn_rad * scene_.effector_size_m.norm() / 2;
}

// Friction acts below the cube's center. The clone must push through its center, between its sides,
// and low enough that the cube does not tip.
void StraightStroke::check_square() const {
  const Pose& cube = cubes_[*cube_];
  const Vector3d& size_m = scene_.cubes[*cube_].size_m;
  const auto name = [&] { return fmt::format("cube {}", *cube_ + 1); };
  if (!is_square(cube, *direction_, straight_rad) || !is_square(start_, *direction_, straight_rad))
    throw OutsideModel(name() + " is not pushed squarely, face against face: it may turn");
  const Vector3d side = across(*direction_);
  const double aside_m = std::abs((cube.position_m - start_.position_m).dot(side));
  if (aside_m >= half_width(start_, scene_.effector_size_m, side))
    throw OutsideModel(name() + " is pushed beside its center: it may turn");
  if (scene_.coupling.decoupled && turned_aside_m(aside_m) > straight_m)
    throw OutsideModel(
        fmt::format("{} is pushed {:.2g} mm beside its center, and the torsional "
                    "spring is too soft to hold the clone straight",
                    name(), 1e3 * aside_m));
  const double lowest_m =
      start_.position_m.z() - half_width(start_, scene_.effector_size_m, Vector3d::UnitZ());
  if (scene_.table_friction(*cube_) * lowest_m > half_along(cube, size_m))
    throw OutsideModel(name() + " is pushed so high that it may tip");
}

WorldState StraightStroke::state(double clone, double clone_m_s, double cube_m_s,
                                 double force_n) const {
  WorldState state;
  state.clone.pose = {start_.position_m + clone * direction(), start_.orientation};
  state.clone.velocity.linear_m_s = clone_m_s * direction();
  state.cubes.resize(cubes_.size());
  for (std::size_t i = 0; i < cubes_.size(); ++i) state.cubes[i].pose = cubes_[i];
  if (!cube_) return state;
  state.cubes[*cube_].velocity.linear_m_s = cube_m_s * direction();
  if (force_n > 0) state.contacts.push_back({static_cast<int>(*cube_), force_n * direction()});
  return state;
}

}  // namespace heft
