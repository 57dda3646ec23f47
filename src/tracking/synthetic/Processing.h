// What a camera's processor makes of a picture before anybody gets it, all by OpenCV: colors
// interpolated between a mosaic's, sharpening, JPEG.
#pragma once

#include "base/Image.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {

/// @param picture in three channels
/// @throws Error when the codecs' module is not there
Image processed(Image picture, const Optics& optics);

}  // namespace heft
