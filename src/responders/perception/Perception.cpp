#include "responders/perception/Perception.h"

#include <algorithm>
#include <cmath>

#include "responders/Responder.h"
#include "responders/perception/SeenGeometry.h"

namespace heft {

namespace {
// A touch interrupted for less than this is one touch; strokes are further apart.
constexpr double touch_break_s = 0.3;
constexpr double mm_per_m = 1000;
constexpr double usual_stroke_mm = 90;
constexpr double sliding_mm = 0.1;    // more between two frames: the cube slides
constexpr double least_share = 0.01;  // of the hand's motion that a cube is seen to share

double horizontal_mm(const Eigen::Vector3d& distance_m) {
  return mm_per_m * distance_m.head<2>().norm();
}
}  // namespace

Perception::Perception(const ResponderParameters& parameters, std::uint64_t seed,
                       const TrialView& trial)
    : parameters_(parameters),
      stage_(trial.stage),
      stream_(trial_stream(seed, "picture noise", trial)),
      looks_(trial.stage.slots_m.size()) {
  if (parameters.haptic_noise_mm <= 0) return;
  RandomStream stream = trial_stream(seed, "felt weight", trial);
  for (std::size_t i = 0; i < looks_.size(); ++i) felt_.push_back(stream.normal());
}

void Perception::see(const DisplayedFrame& frame) {
  const double since_last_s = last_frame_s_ ? frame.t_s - *last_frame_s_ : 0;
  last_frame_s_ = frame.t_s;
  if (!frame.tracked || !frame.clone) return;
  const auto cube = touched_cube(*frame.clone, frame.cubes, stage_);
  if (!cube) return;
  keep_touch(*cube, frame);
  const double gain =
      parameters_.integration_s > 0 ? 1 - std::exp(-since_last_s / parameters_.integration_s) : 1;
  touch_->smoothed_mm += gain * (reading_mm(cue_mm(frame)) - touch_->smoothed_mm);
  Look& look = looks_[static_cast<std::size_t>(*cube)].back();
  look.peak_mm = std::max(look.peak_mm, touch_->smoothed_mm);
  look.travel_mm = std::max(look.travel_mm, horizontal_mm(frame.effector.position_m -
                                                          touch_->effector_at_start.position_m));
  const Pose& pose = frame.cubes[static_cast<std::size_t>(*cube)];
  if (horizontal_mm(pose.position_m - touch_->cube.position_m) > sliding_mm) {
    look.sliding_mm += touch_->smoothed_mm;
    ++look.n_sliding;
  }
  touch_->cube = pose;
}

void Perception::keep_touch(int cube, const DisplayedFrame& frame) {
  const std::size_t i = static_cast<std::size_t>(cube);
  if (!touch_ || touch_->index != cube || frame.t_s > touch_->last_s + touch_break_s) {
    touch_ = Touch{cube, frame.t_s, 0, frame.effector, frame.cubes[i], frame.cubes[i]};
    looks_[i].push_back({});
  }
  touch_->last_s = frame.t_s;
}

double Perception::cue_mm(const DisplayedFrame& frame) const {
  if (parameters_.cue == Cue::offset || parameters_.cue == Cue::sliding_offset)
    return horizontal_mm(frame.clone->position_m - frame.effector.position_m);
  const Pose& cube = frame.cubes[static_cast<std::size_t>(touch_->index)];
  return horizontal_mm(frame.effector.position_m - touch_->effector_at_start.position_m) -
         horizontal_mm(cube.position_m - touch_->cube_at_start.position_m);
}

// A cue below the threshold is read as zero, without noise; decision noise is added later.
double Perception::reading_mm(double shown_mm) {
  if (shown_mm <= parameters_.just_visible_mm) return 0;
  const double noise_mm =
      std::hypot(parameters_.localization_noise_mm, parameters_.length_noise * shown_mm);
  return std::max(0.0, shown_mm + noise_mm * stream_.normal());
}

double Perception::heaviness_mm(const Look& look) const {
  const double shared_mm = look.travel_mm - look.peak_mm;
  if (parameters_.cue == Cue::moved)
    return shared_mm > parameters_.just_visible_mm ? 0 : usual_stroke_mm;
  if (parameters_.cue == Cue::cd_ratio && look.travel_mm > 0)
    return -usual_stroke_mm * std::log(std::max(shared_mm / look.travel_mm, least_share));
  if (parameters_.cue == Cue::sliding_offset && look.n_sliding > 0)
    return look.sliding_mm / look.n_sliding;
  return look.peak_mm;
}

// The seen cue and the felt weight, each by the inverse of its variance.
double Perception::with_felt_weight_mm(double seen_mm, double felt) const {
  const double seen_noise_mm =
      std::hypot(parameters_.localization_noise_mm, parameters_.length_noise * seen_mm);
  const double seen_variance = seen_noise_mm * seen_noise_mm;
  const double felt_variance = parameters_.haptic_noise_mm * parameters_.haptic_noise_mm;
  const double weight = felt_variance / (felt_variance + seen_variance);
  const double felt_mm = parameters_.haptic_mm + parameters_.haptic_noise_mm * felt;
  return weight * seen_mm + (1 - weight) * felt_mm;
}

std::vector<double> Perception::percepts_mm() const {
  std::vector<double> percepts_mm;
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    double sum_mm = 0;
    for (const Look& look : looks_[i]) sum_mm += heaviness_mm(look);
    const double seen_mm = looks_[i].empty() ? 0 : sum_mm / static_cast<double>(looks_[i].size());
    percepts_mm.push_back(felt_.empty() ? seen_mm : with_felt_weight_mm(seen_mm, felt_[i]));
  }
  return percepts_mm;
}

std::vector<int> Perception::not_looked_at() const {
  std::vector<int> cubes;
  for (std::size_t i = 0; i < looks_.size(); ++i)
    if (looks_[i].empty()) cubes.push_back(static_cast<int>(i));
  return cubes;
}

void Perception::forget() {
  touch_.reset();
  for (auto& looks : looks_) looks.clear();
}

}  // namespace heft
