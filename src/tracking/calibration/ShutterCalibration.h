// How long a rolling shutter takes from its first row to its last, from pictures of a board that is
// waved. Each corner is projected with the board's pose at its own row's time,
//
//   pose(t + readout * row / rows),   along the mean velocity between the pictures before and after
//
// and the read-out that leaves the least is found together with every picture's pose.
#pragma once

#include <string>
#include <vector>

#include "tracking/calibration/TagViews.h"

namespace heft {

/// What one picture showed of the board.
struct TimedView {
  double t_s = 0;  ///< of its first row
  TagView view;
};

struct ShutterCalibration {
  double readout_s = 0, sd_s = 0;
  std::size_t n_pictures = 0;  ///< with one before and one after
  double fastest_m_s = 0;      ///< of the board's middle, its 90th percentile
  double rms_px = 0;
};

/// Pictures that are further apart say nothing of the velocity between them.
inline constexpr double longest_between_s = 0.12;
inline constexpr std::size_t enough_waved_pictures = 40;

/// @param views in order of time
/// @throws Error where no picture has one shortly before and after it
ShutterCalibration calibrate_shutter(const MarkerBody& board, const Intrinsics& camera,
                                     const std::vector<TimedView>& views);

/// Why it should not be trusted and what to do about it; empty: it can be.
std::vector<std::string> doubts(const ShutterCalibration& calibration);

/// How the result came about, and what it means.
std::string summary(const ShutterCalibration& calibration);

/// Half a millimeter: the speed at which the effector moves so far while its own tenth of the rows
/// is read, which is what a tracker that is not told of the read-out is off by. None for 0.
double half_millimeter_m_s(double readout_s);

}  // namespace heft
