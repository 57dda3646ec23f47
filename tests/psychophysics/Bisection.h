// A test procedure that is not one of Heft's: bisects the interval of a threshold.
#pragma once

#include "psychophysics/Procedure.h"

namespace heft::test {

class Bisection {
 public:
  Bisection(double low, double high, double width) : low_(low), high_(high), width_(width) {}

  double next_level(const RandomStream&) const { return (low_ + high_) / 2; }
  Update respond(const Response& response, double shown) {
    (response.positive ? high_ : low_) = shown;
    ++n_trials_;
    return {{}, finish()};
  }
  std::optional<StopReason> finish() const {
    return high_ - low_ <= width_ ? std::optional(StopReason::precision) : std::nullopt;
  }
  std::vector<Estimate> estimates() const {
    return {{.method = "bisection",
             .value = (low_ + high_) / 2,
             .low = low_,
             .high = high_,
             .n_trials = n_trials_}};
  }

 private:
  double low_, high_, width_;
  int n_trials_ = 0;
};

}  // namespace heft::test
