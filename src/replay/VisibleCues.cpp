#include "replay/VisibleCues.h"

#include <algorithm>

namespace heft {

namespace {
// A contact interrupted for less than this is one push, as in the log.
constexpr double push_gap_s = 0.2;
// Movement of the hand before the direction of its push is known.
constexpr double least_way_m = 1e-3;
}  // namespace

void CueMeter::add(const DisplayedFrame& frame, std::optional<int> contact_slot,
                   const std::vector<double>& masses_g) {
  // Cubes appear or are rearranged.
  if (frame.cubes.size() != cubes_.size() || masses_g != masses_g_) finish();
  follow_cubes(frame.cubes, masses_g);
  const bool touches = contact_slot && *contact_slot <= static_cast<int>(cubes_.size());
  if (push_ && (frame.t_s > push_->last_s + push_gap_s ||
                (touches && push_->cube + 1 != static_cast<std::size_t>(*contact_slot))))
    end_push();
  if (touches && frame.clone) follow_push(frame, static_cast<std::size_t>(*contact_slot - 1));
}

// A cube that is reset to its start has not moved there.
void CueMeter::follow_cubes(const std::vector<Pose>& cubes, const std::vector<double>& masses_g) {
  if (cubes_.empty()) {
    masses_g_ = masses_g;
    for (const Pose& cube : cubes) cubes_.push_back({cube.position_m, cube.position_m});
    return;
  }
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    Cube& followed = cubes_[i];
    const Eigen::Vector3d& now_m = cubes[i].position_m;
    if (now_m != followed.start_m) followed.path_m += (now_m - followed.last_m).norm();
    followed.last_m = now_m;
  }
}

void CueMeter::follow_push(const DisplayedFrame& frame, std::size_t cube) {
  const Eigen::Vector2d effector_m = frame.effector.position_m.head<2>();
  if (!push_) push_ = Push{cube, frame.t_s, effector_m};
  push_->last_s = frame.t_s;
  cubes_[cube].pushed = true;
  const Eigen::Vector2d way_m = effector_m - push_->effector_at_start_m;
  if (way_m.norm() < least_way_m) return;
  const Eigen::Vector2d behind_m = effector_m - frame.clone->position_m.head<2>();
  push_->lag_m = std::max(push_->lag_m, behind_m.dot(way_m.normalized()));
}

void CueMeter::end_push() {
  VisibleCues& cues = cues_[masses_g_.at(push_->cube)];
  ++cues.n_pushes;
  cues.lag_m += push_->lag_m;
  cues.largest_lag_m = std::max(cues.largest_lag_m, push_->lag_m);
  push_.reset();
}

void CueMeter::finish() {
  if (push_) end_push();
  for (std::size_t i = 0; i < cubes_.size(); ++i) {
    if (!cubes_[i].pushed) continue;
    VisibleCues& cues = cues_[masses_g_.at(i)];
    ++cues.n_cubes;
    cues.path_m += cubes_[i].path_m;
    cues.end_m += (cubes_[i].last_m - cubes_[i].start_m).norm();
  }
  cubes_.clear();
}

}  // namespace heft
