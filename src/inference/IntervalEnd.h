// Where a profile interval ends: see MaximumLikelihood.h.
#pragma once

#include <optional>

#include "inference/Likelihood.h"

namespace heft {

/// One side of a profile interval: walks out from the estimate until the likelihood has fallen far
/// enough, and back to where it just has.
class IntervalEnd {
 public:
  IntervalEnd(Likelihood& likelihood, const Maximum& best, Eigen::Index parameter, double direction)
      : likelihood_(likelihood), best_(best), parameter_(parameter), direction_(direction) {
    const ParameterBounds& bounds = likelihood.bounds(parameter);
    limit_ = direction < 0 ? bounds.low : bounds.high;
  }

  /// @param first_step where the end may be
  void search(double first_step);

  std::optional<double> end() const { return end_; }
  /// Whether all the way to infinity nothing was lost.
  bool is_flat() const {
    return !end_ && last_.log_likelihood > best_.log_likelihood - same_log_likelihood;
  }
  /// Better than the estimate, if that was met on the way.
  const Maximum& likeliest() const { return likeliest_; }

 private:
  bool is_too_far(double to) const;
  // The root of the fall is nearly a straight line for any likelihood.
  double excess(const Maximum& there) const;
  // Where the fall is just enough, by regula falsi (its Illinois variant).
  double between(Maximum inner, Maximum outer);

  Likelihood& likelihood_;
  const Maximum& best_;
  Eigen::Index parameter_;
  double direction_, limit_ = 0;
  Maximum last_ = best_, likeliest_ = best_;  // after best_
  std::optional<double> end_;
};

}  // namespace heft
