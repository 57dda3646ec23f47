// A body's pose from every pixel of its tags: their inner cell edges lie where they should as
// exactly as their borders do, and pull the other way where edges are biased. Each pixel is
// compared with
//
//   tone_curve((dark + contrast * B(s) + reflected(s)) * (1 + gradient . s))
//
// B being the tag's cells, 0 black and 1 white, blurred by a normal distribution; s the place on
// the tag that the pixel's ray hits; reflected a lamp's gloss, a polynomial of second degree, since
// light that lies over a tag like a hill looks like larger cells to a plane. Unknown are the pose
// and the edge bias, and of each tag its light and the blur. Gauss-Newton from the pose of the
// borders, Huber weights. Tags that fingers cover in part count with what is clear of them; tags
// that are not what they should be are left out.
#pragma once

#include <optional>
#include <span>

#include "base/Image.h"
#include "tracking/BodyPose.h"
#include "tracking/RollingShutter.h"
#include "tracking/TagFamily.h"
#include "tracking/ToneCurve.h"

namespace heft {

struct DenseTag {
  const TagObservation* seen;
  const TagPattern* pattern;
};

/// A body that moves while the shutter is open: its cells are smeared along its way.
struct Smear {
  Velocity velocity;         ///< of the body's origin, in the camera's frame
  double still_blur_px = 0;  ///< of what stands still
};

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
