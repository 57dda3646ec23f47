// A world without physics: cubes slide along y, and a pushed cube holds the clone back by
// min(penetration, lag per gram times mass), as in slow pushing. Counts what a careful hand avoids.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiment/Stage.h"
#include "experiment/TrialPlan.h"

namespace heft::fake {

inline Stage row_of(int n_cubes, double rate_hz = 15, double pitch_m = 0.08) {
  Stage stage;
  stage.display_rate_hz = rate_hz;
  for (int i = 0; i < n_cubes; ++i)
    stage.slots_m.emplace_back((i - (n_cubes - 1) / 2.0) * pitch_m, 0, stage.cube_size_m / 2);
  return stage;
}

class World {
 public:
  World(const Stage& stage, const std::string& condition, std::vector<double> masses_g,
        bool clone_drawn = true)
      : stage_(stage),
        condition_(condition),
        masses_g_(std::move(masses_g)),
        clone_drawn_(clone_drawn),
        touching_(masses_g_.size(), false),
        n_pushes_(masses_g_.size(), 0) {
    for (const auto& slot : stage.slots_m) cubes_.push_back(Pose{slot, {1, 0, 0, 0}});
  }

  void move_effector(const Pose& effector) {
    rising_ = effector.position_m.z() > effector_.position_m.z();
    effector_ = clone_ = effector;
    for (std::size_t i = 0; i < cubes_.size(); ++i) touch(i);
  }

  DisplayedFrame picture(double t_s) const {
    DisplayedFrame frame{
        .t_s = t_s, .tracked = true, .effector = effector_, .clone = {}, .cubes = {}};
    if (clone_drawn_) frame.clone = clone_;
    if (shown_) frame.cubes = cubes_;
    return frame;
  }

  void show_cubes() { shown_ = true; }
  const std::vector<Pose>& cubes() const { return cubes_; }
  std::vector<Pose>& cubes() { return cubes_; }
  /// Times that a cube was hit other than by the tip from the front.
  int n_side_hits() const { return n_side_hits_; }
  /// Steps in which the effector rose while a cube still held the clone.
  int n_lifts_in_touch() const { return n_lifts_in_touch_; }
  const std::vector<int>& n_pushes() const { return n_pushes_; }
  int n_returned() const { return n_returned_; }

 private:
  static constexpr double lag_m_per_g = 157e-6;  // 0.8 * 9.81 / 50 N/m
  // A cube further away returns when it is untouched and its place is clear.
  static constexpr double half_depth_m = 0.15;
  static constexpr double clear_m = 0.02;

  void touch(std::size_t i) {
    Eigen::Vector3d& cube_m = cubes_[i].position_m;
    const Eigen::Vector3d half_m =
        effector_.orientation.toRotationMatrix().cwiseAbs() * stage_.effector_size_m / 2;
    const double half_cube_m = stage_.cube_size_m / 2;
    const auto near = [&](const Eigen::Vector3d& place_m, double margin_m) {
      const Eigen::Vector3d apart_m = (effector_.position_m - place_m).cwiseAbs();
      return (apart_m.array() < half_m.array() + half_cube_m + margin_m).all();
    };
    const double tip_m = effector_.position_m.y() + half_m.y();
    const double depth_m = tip_m - (cube_m.y() - half_cube_m);
    // The clone stays in front of a cube that holds it, however far the effector goes through.
    const bool held =
        touching_[i] && depth_m > 0 && near({cube_m.x(), effector_.position_m.y(), cube_m.z()}, 0);
    if (!shown_ || !(held || near(cube_m, 0))) {
      touching_[i] = false;
      if (cube_m.y() > half_depth_m && !near(stage_.slots_m[i], clear_m)) put_back(i);
      return;
    }
    if (touching_[i] && rising_) ++n_lifts_in_touch_;
    if (!touching_[i]) begin_touch(i, depth_m);
    const double most_m = condition_ == "C1" ? 0 : lag_m_per_g * masses_g_[i];
    cube_m.y() += std::max(0.0, depth_m - most_m);
    if (condition_ == "C2")
      clone_.position_m.y() = effector_.position_m.y() - std::min(depth_m, most_m);
  }

  void begin_touch(std::size_t i, double depth_m) {
    touching_[i] = true;
    ++n_pushes_[i];
    // The tip moves less than this between two calls.
    if (depth_m > 0.01) ++n_side_hits_;
  }

  void put_back(std::size_t i) {
    cubes_[i].position_m = stage_.slots_m[i];
    ++n_returned_;
  }

  Stage stage_;
  std::string condition_;
  std::vector<double> masses_g_;
  bool clone_drawn_;
  bool shown_ = false;
  std::vector<Pose> cubes_;
  Pose effector_, clone_;
  std::vector<bool> touching_;
  std::vector<int> n_pushes_;
  bool rising_ = false;
  int n_side_hits_ = 0;
  int n_lifts_in_touch_ = 0;
  int n_returned_ = 0;
};

}  // namespace heft::fake
