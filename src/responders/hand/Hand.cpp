#include "responders/hand/Hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/Pose.h"
#include "responders/Responder.h"
#include "responders/perception/SeenGeometry.h"

namespace heft {

double minimum_jerk(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10 + u * (-15 + 6 * u));
}

double minimum_jerk_duration_s(double distance_m, double peak_speed_m_s) {
  return 15.0 / 8.0 * distance_m / peak_speed_m_s;
}

void HandPath::begin_at(double t_s) {
  start_ = end();
  moves_.clear();
  end_s_ = std::max(end_s_, t_s);
}

void HandPath::stop_at(double t_s) {
  start_ = at(t_s);
  moves_.clear();
  end_s_ = t_s;
}

void HandPath::move(const Pose& to, double peak_speed_m_s) {
  const double distance_m = (to.position_m - end().position_m).norm();
  if (distance_m == 0) return;
  const double duration_s = minimum_jerk_duration_s(distance_m, peak_speed_m_s);
  moves_.push_back({end_s_, duration_s, end(), to});
  end_s_ += duration_s;
}

Pose HandPath::at(double t_s) const {
  const auto later = std::ranges::upper_bound(moves_, t_s, {}, &HandMove::start_s);
  if (later == moves_.begin()) return start_;
  const HandMove& move = *(later - 1);
  return interpolate(move.from, move.to, minimum_jerk((t_s - move.start_s) / move.duration_s));
}

namespace {
constexpr double away_rad = std::numbers::pi / 2;  // the tip, +x of the effector, points to +y
constexpr double approach_gap_m = 0.012;           // a push starts this far in front of its cube
constexpr double clearance_m = 0.015;  // over cubes, and behind a cube before the hand lifts
constexpr double side_margin_m = 0.003;

Eigen::Vector3d tip_from_center_m(const Stage& stage, double yaw_rad) {
  return stage.effector_size_m.x() / 2 * Eigen::Vector3d(std::cos(yaw_rad), std::sin(yaw_rad), 0);
}

double near_faces_y_m(const Stage& stage) {
  return stage.slots_m.front().y() - stage.cube_size_m / 2;
}
}  // namespace

Pose resting_pose(const Stage& stage, double hover_m) {
  const double middle_m = (stage.slots_m.front().x() + stage.slots_m.back().x()) / 2;
  const Eigen::Vector3d tip_place_m(middle_m, near_faces_y_m(stage) - stage.start_distance_m,
                                    stage.effector_size_m.z() / 2 + hover_m);
  return upright_pose(tip_place_m - tip_from_center_m(stage, away_rad), away_rad);
}

Hand::Hand(const ResponderParameters& parameters, std::uint64_t seed, const TrialView& trial)
    : parameters_(parameters),
      stage_(trial.stage),
      stream_(trial_stream(seed, "hand", trial)),
      home_(resting_pose(trial.stage, parameters.hover_m)),
      path_(home_) {}

void Hand::explore(std::span<const int> cubes) {
  std::vector<int> order(cubes.begin(), cubes.end());
  stream_.shuffle(std::span(order));
  for (int cube : order) {
    const double whole = std::floor(parameters_.strokes_per_cube);
    const bool one_more = stream_.coin(parameters_.strokes_per_cube - whole);
    to_push_.insert(to_push_.end(), static_cast<std::size_t>(whole) + (one_more ? 1 : 0), cube);
  }
}

bool Hand::done(double t_s) const {
  return to_push_.empty() && at_home_ && t_s >= path_.end_s();
}

void Hand::see(const DisplayedFrame& frame) {
  if (frame.t_s < path_.end_s()) {
    if (has_seen_enough(frame)) stop(frame.t_s);
    return;
  }
  path_.begin_at(frame.t_s);
  // Missing cubes appear only once the hand is out of their way.
  if (frame.cubes.empty()) return go_home(frame.cubes);
  if (pushed_) return back_off(frame.cubes);
  if (const auto stroke = next_stroke(frame.cubes)) return push(*stroke, frame.cubes);
  go_home(frame.cubes);
}

std::optional<Hand::Stroke> Hand::next_stroke(std::span<const Pose> cubes) {
  while (!to_push_.empty()) {
    const int cube = to_push_.front();
    to_push_.pop_front();
    if (const auto stroke = stroke_on(cube, cubes)) return stroke;
  }
  return std::nullopt;
}

// None if the cube cannot be pushed now.
std::optional<Hand::Stroke> Hand::stroke_on(int cube, std::span<const Pose> cubes) {
  const double length_m = varied(parameters_.stroke_length_m);
  const double peak_speed_m_s = varied(parameters_.stroke_peak_speed_m_s);
  const double lateral_m = error(parameters_.lateral_error_m);
  const double yaw_rad = error(parameters_.yaw_error_rad);
  const Pose& at = cubes[static_cast<std::size_t>(cube)];
  // In a narrow place the hand aims more carefully, off center if necessary.
  const double aside_m = stage_.cube_size_m / 4;
  for (Stroke stroke :
       {aimed(cube, at, lateral_m, yaw_rad, length_m), aimed(cube, at, 0, 0, length_m),
        aimed(cube, at, aside_m, 0, length_m), aimed(cube, at, -aside_m, 0, length_m)}) {
    stroke.peak_speed_m_s = peak_speed_m_s;
    if (possible(stroke, cubes)) return stroke;
  }
  return std::nullopt;
}

Hand::Stroke Hand::aimed(int cube, const Pose& at, double lateral_m, double yaw_rad,
                         double length_m) const {
  const Eigen::Vector3d tip_place_m(at.position_m.x() + lateral_m, near_face_m(at) - approach_gap_m,
                                    home_.position_m.z());
  const double heading_rad = away_rad + yaw_rad;
  Stroke stroke;
  stroke.cube = cube;
  stroke.start = stroke.end =
      upright_pose(tip_place_m - tip_from_center_m(stage_, heading_rad), heading_rad);
  stroke.end.position_m.y() += length_m;
  return stroke;
}

// The cube is on the table, the end within reach, and no other cube in the way.
bool Hand::possible(const Stroke& stroke, std::span<const Pose> cubes) const {
  const Pose& cube = cubes[static_cast<std::size_t>(stroke.cube)];
  const bool on_table = std::abs(cube.position_m.z() - stage_.cube_size_m / 2) < stage_.cube_size_m;
  const bool within_reach = tip_m(stroke.end) <= near_faces_y_m(stage_) + parameters_.reach_m;
  const Eigen::Vector3d half_m = half_extents_m(stroke.start.orientation, stage_.effector_size_m);
  const double half_width_m = half_m.x() + side_margin_m;
  const Eigen::Vector3d& from_m = stroke.start.position_m;
  // From the effector's tail to the far face of the cube.
  const Footprint swept{{from_m.x() - half_width_m, from_m.y() - half_m.y()},
                        {from_m.x() + half_width_m, tip_m(stroke.end) + stage_.cube_size_m}};
  return on_table && within_reach && clear_of_others(swept, cubes, stroke.cube, stage_);
}

void Hand::push(const Stroke& stroke, std::span<const Pose> cubes) {
  if (at_home_) path_.wait(parameters_.pause_s);
  travel_to(stroke.start, cubes);
  pushed_ = stroke;
  pushed_->begins_s = path_.end_s();
  pushed_->cube_start_m = cubes[static_cast<std::size_t>(stroke.cube)].position_m;
  path_.move(stroke.end, stroke.peak_speed_m_s);
  path_.wait(parameters_.hold_s);
  at_home_ = false;
}

// During a push: the clone far enough behind, or the cube far enough from where it was.
bool Hand::has_seen_enough(const DisplayedFrame& frame) const {
  const double gap_m = parameters_.stop_gap_m, motion_m = parameters_.stop_motion_m;
  if (!pushed_ || pushed_->stopped || frame.t_s < pushed_->begins_s) return false;
  if (!frame.tracked || frame.cubes.empty()) return false;
  const Eigen::Vector3d& cube_m = frame.cubes[static_cast<std::size_t>(pushed_->cube)].position_m;
  const auto apart_m = [](const Eigen::Vector3d& a_m, const Eigen::Vector3d& b_m) {
    return (a_m - b_m).head<2>().norm();
  };
  return (gap_m > 0 && frame.clone &&
          apart_m(frame.clone->position_m, frame.effector.position_m) >= gap_m) ||
         (motion_m > 0 && apart_m(cube_m, pushed_->cube_start_m) >= motion_m);
}

void Hand::stop(double t_s) {
  path_.stop_at(t_s);
  path_.wait(parameters_.hold_s);
  pushed_->end = path_.end();
  pushed_->stopped = true;
}

// Straight back until the tip and the clone have left the cube, then up. Not further back: a cube
// that was pushed too far returns to its place, and the effector's tail would drag it along.
void Hand::back_off(std::span<const Pose> cubes) {
  const double inside_m =
      tip_m(path_.end()) - near_face_m(cubes[static_cast<std::size_t>(pushed_->cube)]);
  const double stroke_m = tip_m(pushed_->end) - tip_m(pushed_->start);
  Pose behind = path_.end();
  behind.position_m.y() -= clearance_m + (inside_m < stroke_m ? std::max(0.0, inside_m) : 0);
  path_.move(behind, parameters_.travel_peak_speed_m_s);
  behind.position_m.z() = safe_height_m(cubes);
  path_.move(behind, parameters_.travel_peak_speed_m_s);
  path_.wait(parameters_.pause_s);
  pushed_.reset();
}

Eigen::Vector3d Hand::half_extents_of(const Pose& cube) const {
  return half_extents_m(cube.orientation, Eigen::Vector3d::Constant(stage_.cube_size_m));
}

// Distance of a cube's near edge from the participant.
double Hand::near_face_m(const Pose& cube) const {
  return cube.position_m.y() - half_extents_of(cube).y();
}

// Distance of the tip.
double Hand::tip_m(const Pose& effector) const {
  return (effector * Eigen::Vector3d(stage_.effector_size_m.x() / 2, 0, 0)).y();
}

// Height of the effector's center that clears all cubes.
double Hand::safe_height_m(std::span<const Pose> cubes) const {
  double top_m = stage_.cube_size_m;
  for (const Pose& cube : cubes)
    top_m = std::max(top_m, cube.position_m.z() + half_extents_of(cube).z());
  return top_m + stage_.effector_size_m.z() / 2 + clearance_m;
}

// Up, over, and down.
void Hand::travel_to(const Pose& place, std::span<const Pose> cubes) {
  Pose up = path_.end(), over = place;
  up.position_m.z() = over.position_m.z() = safe_height_m(cubes);
  for (const Pose& pose : {up, over, place}) path_.move(pose, parameters_.travel_peak_speed_m_s);
}

void Hand::go_home(std::span<const Pose> cubes) {
  if (at_home_) return;
  travel_to(home_, cubes);
  at_home_ = true;
  pushed_.reset();
}

// Limited to two standard deviations, because the tails would not be human.
double Hand::error(double sd) {
  return sd * std::clamp(stream_.normal(), -2.0, 2.0);
}

double Hand::varied(double mean) {
  return mean * (1 + error(parameters_.stroke_variation));
}

}  // namespace heft
