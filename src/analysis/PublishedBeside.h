// The paper's own figures beside those of a log, in one list.
#pragma once

#include <string>
#include <vector>

#include "analysis/Summary.h"

namespace heft {

struct PublishedFigure {
  std::string what;    ///< "C2 correct", "JND at 200 g"
  std::string unit;    ///< "%" or "g"
  std::string source;  ///< where the paper has it
  double published = 0;
  std::optional<double> published_sd{};
  /// By Student's t from its SD, or of 13 people exactly; none where the paper gives neither.
  std::optional<Interval> published_interval{};
  std::optional<double> found{}, found_sd{};
  std::optional<Interval> found_interval{};
  int n = 0;  ///< participants
};

/// Only where the log has what the paper measured: its masses, its conditions.
std::vector<PublishedFigure> published_beside(const Summary& summary);

}  // namespace heft
