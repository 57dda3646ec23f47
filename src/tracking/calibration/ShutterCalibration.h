// The read-out time of a rolling shutter, from its first row to its last, from pictures of a waved
// board. Each corner is projected with the board's pose at its own row's time,
//
//   pose(t + readout * row / rows),   along the mean velocity between the pictures before and after
//
// The read-out and every picture's pose are fitted together by least squares.
#pragma once

#include <string>
#include <vector>

#include "tracking/calibration/TagViews.h"

namespace heft {

/// The board in one picture.
struct TimedView {
  double t_s = 0;  ///< of its first row
  TagView view;
};

struct ShutterCalibration {
  double readout_s = 0, sd_s = 0;
  std::size_t n_pictures = 0;  ///< with one before and one after
  double fastest_m_s = 0;      ///< 90th percentile of the speed of the board's middle
  double rms_px = 0;
  /// Median change of the velocity from one interval between pictures to the next, relative to the
  /// sum of both speeds: 0 for uniform motion, 0.2 for a waved board, 0.8 for unrelated views.
  double unsteadiness = 0;
};

/// Pictures further apart do not determine the velocity between them.
inline constexpr double longest_between_s = 0.12;
inline constexpr std::size_t enough_waved_pictures = 40;

/// @param views in order of time
/// @throws Error if no picture has one shortly before and after it
ShutterCalibration calibrate_shutter(const MarkerBody& board, const Intrinsics& camera,
                                     const std::vector<TimedView>& views);

/// Reasons to distrust the result, with advice; empty if there are none.
std::vector<std::string> doubts(const ShutterCalibration& calibration);

/// Description of the result and its consequences.
std::string summary(const ShutterCalibration& calibration);

/// The speed at which the effector moves half a millimeter while its tenth of the rows is read,
/// which is the error of a tracker that ignores the read-out. None for 0.
double half_millimeter_m_s(double readout_s);

}  // namespace heft
