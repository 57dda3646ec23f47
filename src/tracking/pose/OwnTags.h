// Which of a picture's tags belong to a body: a second print of the same tags may be in view.
#pragma once

#include <optional>
#include <vector>

#include "tracking/detection/TagDetector.h"
#include "tracking/pose/BodyPose.h"

namespace heft {

/// Whether the body's origin is above the table's plane; true if no table is known. A spare print
/// of an effector's tags on the table would put the effector half into the table.
bool is_above(const std::optional<Pose>& camera_from_table, const Pose& camera_from_body);

/// The tags that fit one pose of the body, each once; all of them if none is there twice and none
/// would put the body below the table. Every tag proposes its pose; the one that the most corners
/// agree with is taken, and one near the expected pose counts as an agreeing tag more.
std::vector<TagObservation> own_tags(const std::vector<TagObservation>& tags,
                                     const std::optional<Pose>& expected,
                                     const std::optional<Pose>& camera_from_table);

/// Number of detected tags in a part of the picture with the body's ids that are elsewhere than its
/// pose puts them.
int n_elsewhere(const std::vector<DetectedTag>& tags, const Region& part, const Intrinsics& camera,
                const MarkerBody& body, const Pose& camera_from_body);

}  // namespace heft
