// What views of a board tell of its print's shape. Not for other rooms: it speaks OpenCV.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tracking/calibration/CameraCalibration.h"

namespace heft {

/// The corners of one view and where calibration put the board in it.
struct FittedView {
  std::vector<cv::Point3f> on_board;  ///< z = 0
  std::vector<cv::Point2f> in_picture;
  cv::Mat turn, shift;
};

/// One step of least squares in camera, poses, stretch and shear together, from where calibration
/// ended without the last two.
PrintShape shape_of_print(const std::vector<FittedView>& views, const cv::Mat& matrix,
                          const cv::Mat& distortion);

}  // namespace heft
