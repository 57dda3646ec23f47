// How often intervals contain the true value, over simulated studies.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <optional>

#include "inference/Statistics.h"

namespace heft {

/// Number of simulated studies: few in an ordinary run, HEFT_STUDIES in the slow one.
inline int n_studies(int in_ordinary_runs) {
  const char* asked = std::getenv("HEFT_STUDIES");
  return asked ? std::atoi(asked) : in_ordinary_runs;
}

/// By how much a coverage of 95 % varies by chance with this number of studies: three standard
/// errors.
inline double by_chance_percent(int n) {
  return 3 * 100 * 0.218 / std::sqrt(static_cast<double>(n));
}

class Coverage {
 public:
  void add(const std::optional<Interval>& interval, double truth) {
    n_studies_ += 1;
    if (!interval) return;
    n_given_ += 1;
    n_held_ += interval->low <= truth + 1e-9 && truth - 1e-9 <= interval->high ? 1 : 0;
  }

  double percent() const { return 100.0 * n_held_ / n_given_; }  ///< of those given
  double given_percent() const { return 100.0 * n_given_ / n_studies_; }
  int n_given() const { return n_given_; }

 private:
  int n_studies_ = 0, n_given_ = 0, n_held_ = 0;
};

inline void expect_95(const Coverage& found, int studies) {
  const double chance = by_chance_percent(studies);
  EXPECT_GE(found.percent(), 93 - chance);
  EXPECT_LE(found.percent(), 98 + chance);
}

}  // namespace heft
