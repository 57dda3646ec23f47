// A view into a video file: every frame as it is drawn, one after the other. Pages of text are
// not in it; nothing on them is measured.
#pragma once

#include <memory>

#include "view/ArView.h"

namespace heft {

/// setup.file names the video: .mp4 (MPEG-4) or .avi (Motion JPEG, which stays readable however the
/// program ends). It plays at setup.rate_hz and is complete once the view is gone.
/// @throws Error for another ending, a file that exists already, or one that can't be written
std::unique_ptr<ArView> make_video_view(const ViewSetup& setup);

}  // namespace heft
