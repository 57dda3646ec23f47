// Geometry visible in displayed poses: extents of boxes, contacts, free paths.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/PoseTypes.h"
#include "experiment/Stage.h"

namespace heft {

/// Half the size of the axis-aligned box around a turned box.
Eigen::Vector3d half_extents_m(const Eigen::Quaterniond& orientation,
                               const Eigen::Vector3d& size_m);

/// Index of the cube that the clone's tip seems to touch: the nearest one in front of it, within a
/// few millimeters. None if there is none.
std::optional<int> touched_cube(const Pose& clone, std::span<const Pose> cubes, const Stage& stage);

/// The frames in which a cube seems to be touched, and the one before each, from which an eye
/// counts time: they give the percepts of all. None: no cube is touched.
std::vector<DisplayedFrame> frames_with_touches(std::span<const DisplayedFrame> frames,
                                                const Stage& stage);

/// A rectangle on the table, world axes.
struct Footprint {
  Eigen::Vector2d least_m, most_m;
};

/// Whether a rectangle is clear of every cube except one.
bool clear_of_others(const Footprint& area, std::span<const Pose> cubes, int but,
                     const Stage& stage);

}  // namespace heft
