#include "results/tracking/Grips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/Pose.h"
#include "base/Random.h"
#include "protocol/readers/Files.h"
#include "tracking/detection/MarkerBody.h"

namespace heft {

namespace {
constexpr std::string_view board_toml =
    "family = \"tag36h11\"\n[grid]\ncolumns = 6\nrows = 4\ntag_m = 0.040\npitch_m = 0.048\n";

constexpr std::string_view two_faces_toml =
    "size_m = [0.090, 0.085, 0.040]\nchamfer_m = 0.025\n[box]\ntag_m = 0.028\n"
    "tip_margin_m = 0.004\ntip = 40\ntop = 41\nupper_left = 42\nupper_right = 43\nbottom = 44\n";

std::string effector_toml(const EffectorPrint& print) {
  if (print.body == EffectorBody::two_faces) return std::string(two_faces_toml);
  return fmt::format(
      "family = \"tag36h11\"\nsize_m = [0.090, 0.040, 0.040]\n[box]\n"
      "tag_m = {}\ntip_margin_m = {}\ntop = 31\n{}",
      print.tag_m, print.tip_margin_m,
      print.only_top ? "" : "tip = 30\nleft = 32\nright = 33\nbottom = 34\n");
}

constexpr double stroke_reach_m = 0.07, stroke_m_s = 0.4;
constexpr double swipe_m_s = 0.5, swipe_ramp_s = 0.1, swipe_steady_s = 0.24;
constexpr double swipe_length_m = swipe_m_s * (swipe_steady_s + swipe_ramp_s);

// A hand turns a little as it moves.
Eigen::Quaterniond wobble(double t_s) {
  return rotation_from_vector(
      {0.05 * std::sin(4.1 * t_s), 0.04 * std::sin(3.3 * t_s + 1), 0.06 * std::sin(2.7 * t_s + 2)});
}

// How far a swipe has come, from -length / 2.
double swiped_m(double t_s) {
  const double end_s = 2 * swipe_ramp_s + swipe_steady_s;
  const double t = std::clamp(t_s, 0.0, end_s), left_s = end_s - t;
  const double half_acceleration = swipe_m_s / swipe_ramp_s / 2;
  if (t < swipe_ramp_s) return half_acceleration * t * t - swipe_length_m / 2;
  if (left_s < swipe_ramp_s) return swipe_length_m / 2 - half_acceleration * left_s * left_s;
  return swipe_m_s * (t - swipe_ramp_s / 2) - swipe_length_m / 2;
}

double along_m(Motion motion, double t_s) {
  if (motion == Motion::hold) return 0;
  if (motion == Motion::swipe) return swiped_m(t_s);
  return stroke_reach_m * std::sin(stroke_m_s / stroke_reach_m * t_s);
}
}  // namespace

Apparatus bench_apparatus(int width_px, const EffectorPrint& print) {
  return {default_camera(width_px, width_px == 640 ? 480 : width_px * 9 / 16),
          parse_board(std::string(board_toml), "board"),
          parse_effector(effector_toml(print), "effector")};
}

Pose random_grip(std::uint64_t seed, std::uint64_t number, Grip grip) {
  RandomStream random(seed, "grip", number);
  const auto within = [&](double half) { return half * (2 * random.uniform() - 1); };
  const double share = within(1);
  const double roll = grip == Grip::any ? 0.6 * share : std::copysign(0.7, share) + 0.3 * share;
  using Eigen::AngleAxisd, Eigen::Vector3d;
  const Eigen::Quaterniond turn =
      AngleAxisd(M_PI / 2 + within(grip == Grip::any ? 0.7 : 0.3), Vector3d::UnitZ()) *
      AngleAxisd(0.1 + within(0.15), Vector3d::UnitY()) * AngleAxisd(roll, Vector3d::UnitX());
  const double x_m = within(0.05), y_m = -0.02 + within(0.03), z_m = 0.04 + within(0.015);
  return {{x_m, y_m, z_m}, turn};
}

Take take(Motion motion, std::uint64_t seed, std::uint64_t number, Grip grip) {
  RandomStream random(seed, "direction", number);
  // People push sideways and away; fast swipes go sideways.
  const double yaw =
      motion == Motion::swipe ? 0.6 * (random.uniform() - 0.5) : M_PI * random.uniform();
  return {random_grip(seed, number, grip), {std::cos(yaw), std::sin(yaw), 0}, motion};
}

Pose Take::at(double t_s) const {
  Pose pose = grip;
  pose.position_m += along_m(motion, t_s) * direction;
  if (motion != Motion::hold) pose.orientation = (pose.orientation * wobble(t_s)).normalized();
  return pose;
}

double Take::speed_m_s(double t_s) const {
  constexpr double dt_s = 1e-4;
  return std::abs(along_m(motion, t_s + dt_s) - along_m(motion, t_s - dt_s)) / (2 * dt_s);
}

}  // namespace heft
