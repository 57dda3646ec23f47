#include "tracking/pose/PoseFilter.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/Pose.h"

namespace heft {

namespace {
// Accuracy of a pose at quality 1. With tags on two faces the quality is about 0.85 at 640 pixels.
constexpr double position_sd_m = 0.00018, turn_sd_rad = 0.0028;
// Process noise: spectral density of a hand's acceleration, at rest (tremor) and in motion, which
// the filter must follow immediately. Motion is detected by speed.
struct ProcessNoise {
  double at_rest, moving;
  double slow, fast;  // speeds between which it changes
};
constexpr ProcessNoise position_noise{5e-6, 20, 0.02, 0.08};  // m2/s3, m/s
constexpr ProcessNoise turn_noise{1e-3, 3e3, 0.15, 0.6};      // rad2/s3, rad/s
// ... or, before there is any speed, by innovations of this many standard deviations.
constexpr double innovation_starts = 2, innovation_full = 4;
constexpr double decay_s = 0.15;
constexpr double least_quality = 0.1;

// Position and velocity of one axis relative to the last estimate, with their covariance. The three
// axes of a quantity share it, because they are measured alike.
struct Covariance {
  double position, both = 0, velocity;

  void predict(double dt_s, double noise) {
    position += dt_s * (2 * both + dt_s * velocity) + noise * dt_s * dt_s * dt_s / 3;
    both += dt_s * velocity + noise * dt_s * dt_s / 2;
    velocity += noise * dt_s;
  }

  struct Gain {
    double position, velocity;
  };

  Gain correct(double measured_variance) {
    const double sum = position + measured_variance;
    const Gain gain{position / sum, both / sum};
    velocity -= gain.velocity * both;
    both *= 1 - gain.position;
    position *= 1 - gain.position;
    return gain;
  }
};

// Adaptive process noise: rises immediately and falls slowly, so that the filter never lags at the
// start of a motion.
class AdaptiveNoise {
 public:
  explicit AdaptiveNoise(const ProcessNoise& noise) : noise_(noise) {}

  double at_rest() const { return noise_.at_rest; }

  // @param innovation in standard deviations at rest
  // @return the density, interpolated logarithmically, because its limits differ by orders of
  // magnitude
  double update(double innovation, double speed, double dt_s) {
    const double now = std::max(ramp(innovation, innovation_starts, innovation_full),
                                ramp(speed, noise_.slow, noise_.fast));
    motion_ = std::max(now, motion_ * std::exp(-dt_s / decay_s));
    return noise_.at_rest * std::pow(noise_.moving / noise_.at_rest, motion_);
  }

 private:
  static double ramp(double value, double none, double all) {
    return std::clamp((value - none) / (all - none), 0.0, 1.0);
  }

  ProcessNoise noise_;
  double motion_ = 0;  // 0: at rest, 1: moving
};

// Three axes of one quantity.
class Axes {
 public:
  Axes(double measured_sd, const ProcessNoise& noise, double velocity_sd)
      : measured_sd_(measured_sd),
        noise_(noise),
        covariance_{measured_sd * measured_sd, 0, velocity_sd * velocity_sd} {}

  // @param off distance of the measured from the predicted position
  // @return distance of the estimated from the predicted position
  Eigen::Vector3d update(const Eigen::Vector3d& off, double dt_s, double quality) {
    const double sd = measured_sd_ / std::max(quality, least_quality);
    Covariance at_rest = covariance_;
    at_rest.predict(dt_s, noise_.at_rest());
    const double innovation = off.norm() / std::sqrt(3 * (at_rest.position + sd * sd));
    covariance_.predict(dt_s, noise_.update(innovation, velocity.norm(), dt_s));
    const auto gain = covariance_.correct(sd * sd);
    velocity += gain.velocity * off;
    now = velocity + (gain.position - gain.velocity * dt_s / 2) / dt_s * off;
    return gain.position * off;
  }

  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  // The reported velocity. During constant acceleration a constant-velocity filter's estimate lags
  // by this part of each innovation (the alpha-beta filter's lag: (alpha - beta / 2) / dt), half a
  // picture, which is visible when the hand reverses.
  Eigen::Vector3d now = Eigen::Vector3d::Zero();

 private:
  double measured_sd_;
  AdaptiveNoise noise_;
  Covariance covariance_;
};
}  // namespace

struct PoseFilter::Impl {
  struct State {
    double t_s;
    Pose pose;
    Axes position{position_sd_m, position_noise, 1.0};
    Axes turn{turn_sd_rad, turn_noise, 5.0};
  };
  std::optional<State> state;
};

PoseFilter::PoseFilter() : impl_(std::make_unique<Impl>()) {}
PoseFilter::~PoseFilter() = default;
PoseFilter::PoseFilter(PoseFilter&&) noexcept = default;
PoseFilter& PoseFilter::operator=(PoseFilter&&) noexcept = default;

FilteredPose PoseFilter::update(double t_s, const Pose& measured, double quality) {
  if (!impl_->state) {
    impl_->state = Impl::State{t_s, measured};
    return {measured, {}};
  }
  Impl::State& state = *impl_->state;
  const double dt_s = std::max(t_s - state.t_s, 1e-6);
  state.t_s = t_s;
  Axes &position = state.position, &turn = state.turn;
  const Eigen::Vector3d predicted_m = state.pose.position_m + dt_s * position.velocity;
  const Eigen::Quaterniond predicted =
      rotation_from_vector(dt_s * turn.velocity) * state.pose.orientation;
  const Eigen::Vector3d off_rad = rotation_vector(measured.orientation * predicted.conjugate());
  state.pose.position_m =
      predicted_m + position.update(measured.position_m - predicted_m, dt_s, quality);
  state.pose.orientation =
      (rotation_from_vector(turn.update(off_rad, dt_s, quality)) * predicted).normalized();
  return {state.pose, {position.now, turn.now}};
}

void PoseFilter::reset() {
  impl_->state.reset();
}

}  // namespace heft
