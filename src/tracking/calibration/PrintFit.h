// The shape of a board's print from views of it. Private to the folder: it uses OpenCV's types.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tracking/calibration/CameraCalibration.h"

namespace heft {

/// The corners of one view and the calibrated pose of the board.
struct FittedView {
  std::vector<cv::Point3f> on_board;  ///< z = 0
  std::vector<cv::Point2f> in_picture;
  cv::Mat turn, shift;
};

/// One least-squares step in camera, poses, stretch and shear together, starting from a calibration
/// without the last two.
PrintShape shape_of_print(const std::vector<FittedView>& views, const cv::Mat& matrix,
                          const cv::Mat& distortion);

}  // namespace heft
