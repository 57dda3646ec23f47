// Where tracking ends: one thing made worse at a time, pictures on their own, ours and what most
// people build side by side.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/StudyFiles.h"
#include "bench/tracking/Filming.h"

namespace heft {

/// What is in front of the camera, and the camera.
struct LimitScene {
  Apparatus apparatus;
  SyntheticSettings settings;
  Take take;
  double t_s = 0;
};

/// One thing that is made worse.
struct Limit {
  std::string name;   ///< in the CSV
  std::string label;  ///< of the axis, with its unit
  bool logarithmic = false;
  std::vector<double> values;  ///< from harmless on
  std::function<LimitScene(double value, std::uint64_t number)> scene;
};

/// All of them at 640x480, otherwise as in the other studies.
std::vector<Limit> limits();

struct LimitPoint {
  std::string limit;
  double value = 0;
  ErrorSummary ours, bias_left_in, plain;  ///< the second: ours without removing the edge bias
};

/// Writes limits.csv and limits.svg.
std::vector<LimitPoint> study_limits(const StudyOptions& options, StudyProgress& progress);

std::string limits_chart(const std::vector<LimitPoint>& points, const StudyOptions& options);

inline constexpr int limit_parts = 9;  ///< of progress

}  // namespace heft
