// The part of one box's face that lies over another box's face: corners, clipping, and which four
// corners to keep.
#pragma once

#include "base/Polygon.h"

namespace heft {

/// A corner in coordinates of the reference face: u, v along it from its center, w above it.
struct FaceCorner {
  double u = 0, v = 0, w = 0;  ///< m
  int feature = 0;             ///< equal in the next step for the same corner
};

using FacePolygon = Polygon<FaceCorner, 9>;  ///< a quadrilateral cut by four lines has eight

/// The part within sign * coordinate <= limit.
/// @param clip 0...3, which of the four lines; part of new corners' features
FacePolygon clipped(const FacePolygon& face, double FaceCorner::*coordinate, double sign,
                    double limit, int clip);

/// Reduces a polygon to the four corners that hold a body best: the deepest, the farthest from it,
/// and the farthest to either side of the line between these two.
void keep_four(FacePolygon& polygon);

}  // namespace heft
