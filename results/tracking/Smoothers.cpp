#include <Eigen/LU>
#include <array>
#include <cmath>
#include <optional>

#include "base/Pose.h"
#include "results/tracking/TrackingStudy.h"
#include "tracking/pose/PoseFilter.h"

namespace heft {

namespace {
using Vector6 = Eigen::Matrix<double, 6, 1>;

class Unfiltered final : public Smoother {
 public:
  Pose update(double, const Pose& measured, double) override { return measured; }
};

class OurFilter final : public Smoother {
 public:
  Pose update(double t_s, const Pose& measured, double quality) override {
    const FilteredPose filtered = filter_.update(t_s, measured, quality);
    velocity_ = filtered.velocity;
    return filtered.pose;
  }
  Velocity velocity() const override { return velocity_; }

 private:
  PoseFilter filter_;
  Velocity velocity_;
};

// Filters that work number by number: position, and the turn from the first pose.
class NumberSmoother : public Smoother {
 public:
  Pose update(double t_s, const Pose& measured, double) override {
    if (!first_) first_ = measured;
    Vector6 numbers;
    numbers << measured.position_m,
        rotation_vector(measured.orientation * first_->orientation.conjugate());
    const Vector6 smooth = last_s_ ? next(numbers, t_s - *last_s_) : begin(numbers);
    last_s_ = t_s;
    return {smooth.head<3>(),
            (rotation_from_vector(smooth.tail<3>()) * first_->orientation).normalized()};
  }

 protected:
  virtual Vector6 begin(const Vector6& measured) = 0;
  virtual Vector6 next(const Vector6& measured, double dt_s) = 0;

 private:
  std::optional<Pose> first_;
  std::optional<double> last_s_;
};

class OneEuro : public NumberSmoother {
 public:
  /// @param beta Hz per m/s, and per ten rad/s
  OneEuro(double least_cutoff_hz, double beta) : least_(least_cutoff_hz), beta_(beta) {}

 private:
  static double fraction(double cutoff_hz, double dt_s) {
    return 1 / (1 + 1 / (2 * M_PI * cutoff_hz * dt_s));
  }
  Vector6 begin(const Vector6& measured) override { return value_ = measured; }
  Vector6 next(const Vector6& measured, double dt_s) override {
    constexpr double derivative_cutoff_hz = 1;
    slope_ += fraction(derivative_cutoff_hz, dt_s) * ((measured - value_) / dt_s - slope_);
    const double moving = slope_.head<3>().norm(), turning = slope_.tail<3>().norm() / 10;
    value_.head<3>() += fraction(least_ + beta_ * moving, dt_s) * (measured - value_).head<3>();
    value_.tail<3>() += fraction(least_ + beta_ * turning, dt_s) * (measured - value_).tail<3>();
    return value_;
  }

  double least_, beta_;
  Vector6 value_, slope_ = Vector6::Zero();
};

// All three numbers of a kind share their covariance.
class Kalman final : public NumberSmoother {
 public:
  explicit Kalman(double acceleration_m_s2) {
    constexpr double rad_per_m = 10;  // a hand turns that much as it moves
    kinds_[0] = {acceleration_m_s2, 0.15e-3};
    kinds_[1] = {acceleration_m_s2 * rad_per_m, 1.5e-3};
  }

 private:
  struct Kind {
    double acceleration = 0, measured_sd = 0;
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  };

  Vector6 begin(const Vector6& measured) override {
    for (Kind& kind : kinds_)
      kind.covariance = Eigen::Vector2d(kind.measured_sd * kind.measured_sd, 0.01).asDiagonal();
    return value_ = measured;
  }
  Vector6 next(const Vector6& measured, double dt_s) override {
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d gain = gain_of(kinds_[static_cast<std::size_t>(k)], dt_s);
      auto value = value_.segment<3>(3 * k);
      auto slope = slope_.segment<3>(3 * k);
      value += dt_s * slope;
      const Eigen::Vector3d off = measured.segment<3>(3 * k) - value;
      value += gain(0) * off;
      slope += gain(1) * off;
    }
    return value_;
  }
  static Eigen::Vector2d gain_of(Kind& kind, double dt_s) {
    Eigen::Matrix2d step = Eigen::Matrix2d::Identity();
    step(0, 1) = dt_s;
    const Eigen::Vector2d pushed(dt_s * dt_s / 2, dt_s);
    Eigen::Matrix2d& p = kind.covariance;
    p = step * p * step.transpose() +
        kind.acceleration * kind.acceleration * pushed * pushed.transpose();
    const Eigen::Vector2d gain = p.col(0) / (p(0, 0) + kind.measured_sd * kind.measured_sd);
    p -= (gain * p.row(0)).eval();
    return gain;
  }

  std::array<Kind, 2> kinds_;
  Vector6 value_, slope_ = Vector6::Zero();
};

// One-Euro that does not look at speed, at film_rate_hz.
class Exponential final : public OneEuro {
 public:
  explicit Exponential(double fraction_of_new)
      : OneEuro(fraction_of_new / (1 - fraction_of_new) * film_rate_hz / (2 * M_PI), 0) {}
};

template <typename Filter, typename... Settings>
SmootherEntry entry(const char* family, const char* setting, Settings... settings) {
  return {family, setting,
          [=]() -> std::unique_ptr<Smoother> { return std::make_unique<Filter>(settings...); }};
}
}  // namespace

const std::vector<SmootherEntry>& smoothers() {
  static const std::vector table{entry<Unfiltered>("none", ""),
                                 entry<OurFilter>("heft", ""),
                                 entry<Exponential>("exponential", "0.7", 0.7),
                                 entry<Exponential>("exponential", "0.4", 0.4),
                                 entry<Exponential>("exponential", "0.2", 0.2),
                                 entry<OneEuro>("One-Euro", "1 Hz beta 1", 1.0, 1),
                                 entry<OneEuro>("One-Euro", "1 Hz beta 10", 1.0, 10),
                                 entry<OneEuro>("One-Euro", "1 Hz beta 100", 1.0, 100),
                                 entry<Kalman>("Kalman", "0.1 m/s2", 0.1),
                                 entry<Kalman>("Kalman", "1 m/s2", 1.0),
                                 entry<Kalman>("Kalman", "10 m/s2", 10.0)};
  return table;
}

}  // namespace heft
