// Processing within a camera, by OpenCV: colors interpolated from a mosaic, sharpening, JPEG.
#pragma once

#include "base/Image.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {

/// @param picture with three channels
/// @throws Error if the codecs' module is missing
Image processed(Image picture, const Optics& optics);

}  // namespace heft
