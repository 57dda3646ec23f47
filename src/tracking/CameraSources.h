// The three cameras of the table in Camera.cpp.
#pragma once

#include <memory>
#include <string>

#include "tracking/Camera.h"

namespace heft {

/// @param number N of /dev/videoN
std::unique_ptr<Camera> open_live_camera(const std::string& number, const CameraRequest& request);

/// Times are the file's own where they increase, else picture number over rate.
std::unique_ptr<Camera> open_video_file(const std::string& path, const CameraRequest& request);

/// All pictures of a folder in natural order (frame_2 before frame_10). Times from its times.csv
/// (columns frame and t_s, frame is a file's name) or 30 pictures a second.
std::unique_ptr<Camera> open_picture_folder(const std::string& path, const CameraRequest& request);

}  // namespace heft
