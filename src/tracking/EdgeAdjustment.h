// The least-squares core of BodyPose.h: one start, all edges, Levenberg-Marquardt.
#pragma once

#include <vector>

#include "tracking/BodyPose.h"

namespace heft {

/// The pose and bias with the smallest robust cost near `start`, with rms_px and cost filled in.
BodyFit adjust(const std::vector<TagObservation>& tags, const Pose& start, const BiasPrior& prior);

/// Root mean square distance of a tag's measured points from its edges, pixels.
double tag_rms_px(const TagObservation& tag, const BodyFit& fit);

}  // namespace heft
