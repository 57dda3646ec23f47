// A body's pose from every pixel of its tags: their inner cell edges lie where they should as
// exactly as their borders do, and pull the other way where edges are biased. Each pixel is
// compared with what it should show (TagModel). Unknown are the pose and the edge bias, and of each
// tag its light and the blur. Gauss-Newton from the pose of the borders, Huber weights. Tags that
// fingers cover in part count with what is clear of them; tags that are not what they should be are
// left out.
#pragma once

#include <optional>
#include <span>

#include "base/Image.h"
#include "tracking/camera/RollingShutter.h"
#include "tracking/detection/ToneCurve.h"
#include "tracking/pose/BodyPose.h"
#include "tracking/pose/TagModel.h"

namespace heft {

/// @param noise sd of the picture's, gray levels  @param smear none: it stands still
/// @param rows of a rolling shutter, before which the body moves; none: all are seen at once
/// @return the start with another pose, bias and covariance; none where pixels don't bear it:
/// of no tag: blurred over cells, not explained, or leading far from the start
std::optional<BodyFit> align_densely(const Image& gray, const Intrinsics& camera,
                                     std::span<const DenseTag> tags, const BodyFit& start,
                                     const BiasPrior& prior, const ToneCurve& curve, double noise,
                                     const std::optional<Smear>& smear = {},
                                     const std::optional<RowsHeld>& rows = {});

}  // namespace heft
