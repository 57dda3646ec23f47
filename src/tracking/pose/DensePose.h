// A body's pose from every pixel of its tags. Inner cell edges are as accurate as borders, and an
// edge bias moves them the other way. Each pixel is compared with its model (TagModel). Unknown are
// the pose, the edge bias, and the light and blur of each tag. Gauss-Newton from the borders' pose,
// Huber weights. The clear part of tags under fingers is used; tags that do not match are left out.
#pragma once

#include <optional>
#include <span>

#include "base/Image.h"
#include "tracking/detection/ToneCurve.h"
#include "tracking/pose/BodyPose.h"
#include "tracking/pose/RollingShutter.h"
#include "tracking/pose/TagModel.h"

namespace heft {

/// @param noise SD of the picture's, gray levels  @param smear none: no motion
/// @param rows of a rolling shutter with a moving body; none: all rows at the same time
/// @return the start with another pose, bias and covariance; none if the pixels do not support it:
///   no tag, blurred over cells, not explained, or far from the start
std::optional<BodyFit> align_densely(const Image& gray, const Intrinsics& camera,
                                     std::span<const DenseTag> tags, const BodyFit& start,
                                     const BiasPrior& prior, const ToneCurve& curve, double noise,
                                     const std::optional<Smear>& smear = {},
                                     const std::optional<RowsHeld>& rows = {});

}  // namespace heft
