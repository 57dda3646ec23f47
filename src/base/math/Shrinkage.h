// Estimates of what mostly is not there.
#pragma once

#include <algorithm>
#include <cmath>

namespace heft {

/// How much of an estimate is to be believed where it is usually nothing: what exceeds a standard
/// deviation, the more the further it does (empirical Bayes: the positive-part estimator of James &
/// Stein, 1961). @param in_sds the estimate, in its standard deviations
inline double believed_fraction(double in_sds) {
  const double size = std::max(1.0, std::abs(in_sds));
  return 1 - 1 / (size * size);
}

}  // namespace heft
