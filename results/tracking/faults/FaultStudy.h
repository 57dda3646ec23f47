// How well poses are found by cameras that are not ideal, at both picture sizes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "results/tracking/TrackingStudy.h"

namespace heft {

/// An effector held still before the ideal camera, and what is to be changed of it.
struct FaultScene {
  Apparatus apparatus;  ///< as its files have it
  SyntheticSettings settings;
  double speed_m_s = 0;   ///< straight on over the table
  bool has_times = true;  ///< false: lost pictures leave no gap in the times
};

struct Fault {
  std::string name;   ///< in the CSV
  std::string label;  ///< of the axis, with its unit
  std::vector<double> values;
  std::function<void(FaultScene& scene, double value)> change;
};

/// More than limits tell: at both sizes, with what comes after the lens, and with wrong files.
std::vector<Fault> faults();

/// Films a board that is waved under a rolling shutter and finds its read-out: ShutterStudy.cpp.
Goal find_readout(bool quick);

/// Writes faults.svg.
void draw_faults(const std::vector<FaultPoint>& points, const StudyOptions& options);

}  // namespace heft
