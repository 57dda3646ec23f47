#include "physics/Drive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/Error.h"
#include "base/Pose.h"
#include "base/math/Geometry.h"
#include "physics/coupling/CouplingLaw.h"
#include "physics/techniques/Displacement.h"

namespace heft {

namespace {
constexpr double clear_m = 0.0005;
// Pose of the clone until the effector is first seen.
const Pose out_of_the_way{{0, 0, 10}, Eigen::Quaterniond::Identity()};

// ceil(dt * rate), robust against rounding just above a whole number.
double n_steps(double dt_s, double rate_hz) {
  return std::max(1.0, std::ceil(dt_s * rate_hz - 1e-6));
}

// The pose at fraction s of a cubic Hermite curve of dt_s seconds with these velocities at its
// ends; for orientations, the curve of the rotation vector from the first.
Pose interpolate_smoothly(const Pose& from, const Velocity& at_from, const Pose& to,
                          const Velocity& at_to, double dt_s, double s) {
  const double start_slope = s * (1 - s) * (1 - s) * dt_s, end_slope = s * s * (s - 1) * dt_s;
  const double fraction = s * s * (3 - 2 * s);
  const auto in_from = [&](const Velocity& velocity) -> Eigen::Vector3d {
    return from.orientation.conjugate() * velocity.angular_rad_s;
  };
  const Eigen::Vector3d turn_rad = rotation_vector(from.orientation.conjugate() * to.orientation);
  return {
      from.position_m + fraction * (to.position_m - from.position_m) +
          start_slope * at_from.linear_m_s + end_slope * at_to.linear_m_s,
      from.orientation * rotation_from_vector(fraction * turn_rad + start_slope * in_from(at_from) +
                                              end_slope * in_from(at_to))};
}

// Synthetic paths have zero velocity; measured velocities of a moving hand are never exactly zero.
bool is_zero(const Velocity& velocity) {
  return velocity.linear_m_s.isZero(0) && velocity.angular_rad_s.isZero(0);
}

void check(const TargetSample& sample) {
  if (!std::isfinite(sample.t_capture_s))
    throw Error("the capture time of an effector sample is not a finite number");
  if (!sample.tracked) return;
  const bool finite =
      sample.pose.position_m.allFinite() && sample.pose.orientation.coeffs().allFinite() &&
      sample.velocity.linear_m_s.allFinite() && sample.velocity.angular_rad_s.allFinite();
  if (!finite || std::abs(sample.pose.orientation.norm() - 1) > 1e-3) {
    throw Error(fmt::format(
        "the effector's pose or velocity at {} s is invalid: expected finite numbers and a unit "
        "quaternion; set tracked = false in a sample without a pose",
        sample.t_capture_s));
  }
}
}  // namespace

Pose predicted(const TargetSample& sample, double ahead_s) {
  if (ahead_s == 0) return sample.pose;
  const auto& [linear_m_s, angular_rad_s] = sample.velocity;
  return {sample.pose.position_m + ahead_s * linear_m_s,
          rotation_from_vector(ahead_s * angular_rad_s) * sample.pose.orientation};
}

TargetSample sample_of(double t_capture_s, const std::optional<Pose>& pose) {
  TargetSample sample;
  sample.t_capture_s = t_capture_s;
  sample.tracked = pose.has_value();
  if (pose) sample.pose = *pose;
  return sample;
}

Drive::Drive(std::unique_ptr<DecouplingSimulator> simulator, const Scene& scene, double rate_hz,
             const DriveInput& input)
    : simulator_(displaced(std::move(simulator), scene)),
      scene_(scene),
      rate_hz_(rate_hz),
      input_(input) {
  if (!(rate_hz > 0) || !std::isfinite(rate_hz))
    throw Error(fmt::format("the physics rate is {} Hz, expected more than 0", rate_hz));
  if (const auto why = instability(scene.coupling, rate_hz)) throw OutsideModel(*why);
  if (!(input.predict_s >= 0) || !std::isfinite(input.predict_s))
    throw Error(fmt::format("the prediction is {} s, expected 0 or more", input.predict_s));
}

const WorldState& Drive::advance(const TargetSample& measured) {
  check(measured);
  TargetSample sample = measured;
  if (sample.tracked) sample.pose = predicted(measured, input_.predict_s);
  if (started_)
    follow(sample);
  else
    start(sample);
  const Pose target = sample.tracked ? sample.pose : last_.pose;
  last_ = sample;
  last_.pose = target;
  started_ = true;
  read_state();
  if (sample.tracked && !solid_ && clear_of_cubes()) set_solid(true);
  return state_;
}

void Drive::start(const TargetSample& sample) {
  last_.pose = out_of_the_way;
  simulator_->reset(scene_, sample.tracked ? sample.pose : out_of_the_way);
  set_solid(sample.tracked);
}

// Where the effector was lost or jumped, the clone is put at its new place without pushing.
void Drive::follow(const TargetSample& sample) {
  const double dt_s = sample.t_capture_s - last_.t_capture_s;
  if (!(dt_s > 0)) {
    throw Error(fmt::format("the effector sample at {} s is not later than the last one at {} s",
                            sample.t_capture_s, last_.t_capture_s));
  }
  const bool continues = sample.tracked && last_.tracked && !sample.jump && dt_s <= longest_gap_s;
  if (!continues) set_solid(false);
  run(continues ? end_of_path(sample) : last_.pose, dt_s,
      continues ? std::optional(sample.velocity) : std::nullopt);
  if (sample.tracked && !continues) simulator_->teleport_clone(sample.pose, sample.velocity);
  mean_velocity_.reset();
  if (continues) mean_velocity_ = mean_velocity(last_.pose, sample.pose, dt_s);
}

// The target at the time of a sample that continues the last one.
Pose Drive::end_of_path(const TargetSample& sample) const {
  if (input_.mode == InputMode::path || input_.mode == InputMode::smooth) return sample.pose;
  if (input_.mode == InputMode::hold || !mean_velocity_) return last_.pose;
  TargetSample continued = last_;
  continued.velocity = *mean_velocity_;
  return predicted(continued, sample.t_capture_s - last_.t_capture_s);
}

void Drive::run(const Pose& target, double dt_s, const std::optional<Velocity>& at_target) {
  const double n = n_steps(dt_s, rate_hz_);
  const bool is_curved = input_.mode == InputMode::smooth && at_target &&
                         !(is_zero(last_.velocity) && is_zero(*at_target));
  for (double i = 1; i < n; ++i)
    simulator_->step(is_curved ? interpolate_smoothly(last_.pose, last_.velocity, target,
                                                      *at_target, dt_s, i / n)
                               : interpolate(last_.pose, target, i / n),
                     dt_s / n);
  simulator_->step(target, dt_s / n);  // exactly the target, without rounding by interpolation
}

void Drive::return_cube(int cube) {
  if (!started_ || cube < 0 || cube >= static_cast<int>(scene_.cubes.size()))
    throw Error(fmt::format("can't return cube {}: the scene has {} cubes{}", cube,
                            scene_.cubes.size(), started_ ? "" : " and has not started"));
  const Cube& start = scene_.cubes[static_cast<std::size_t>(cube)];
  simulator_->place_cube(cube, upright_pose(start.position_m, start.yaw_rad));
  read_state();
  if (solid_ && !clear_of_cubes()) set_solid(false);
}

void Drive::read_state() {
  state_ = simulator_->state();
  state_.clone_present = last_.tracked;
}

void Drive::set_solid(bool solid) {
  simulator_->set_clone_solid(solid);
  solid_ = solid;
}

bool Drive::clear_of_cubes() const {
  const Eigen::Vector3d size_m = scene_.effector_size_m + Eigen::Vector3d::Constant(2 * clear_m);
  for (std::size_t i = 0; i < state_.cubes.size(); ++i)
    if (boxes_overlap(state_.clone.pose, size_m, state_.cubes[i].pose, scene_.cubes[i].size_m))
      return false;
  return true;
}

}  // namespace heft
