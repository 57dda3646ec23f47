// Where boxes touch, or would meet next. No masses and no forces live here.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "base/PoseTypes.h"
#include "base/math/Geometry.h"

namespace heft {

// The part of one box's face that lies over another box's face: corners, clipping, and which four
// corners to keep.

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

struct Box {
  Eigen::Vector3d half_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: its x, y and z in the world
};

Box box_at(const Pose& pose, const Eigen::Vector3d& size_m);

struct ContactPoint {
  Eigen::Vector3d on_first_m, on_second_m;
  double distance_m = 0;  ///< along the normal; negative where the boxes overlap
  int feature = 0;        ///< equal in the next step if the same corner or edge touches
};

/// Where two bodies meet: at most four points that share a normal.
struct Contact {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, from the second to the first
  std::array<ContactPoint, 4> points;
  int n_points = 0;

  std::span<const ContactPoint> all() const {
    return {points.data(), static_cast<std::size_t>(n_points)};
  }
};

/// Contact of two boxes nearer than margin_m: points at positive distances too, so that a solver
/// can stop the boxes where they meet instead of pushing them apart afterwards.
Contact contact_between(const Box& first, const Box& second, double margin_m);

/// The same for a first box on its way along travel_m, as seen from the second: if the boxes meet
/// on the way, the contact is the one there, brought back to where the first box is now. Finds the
/// face that is hit, however far away or beside the other box it still is; does not look at
/// turning.
Contact contact_on_the_way(const Box& first, const Box& second, const Eigen::Vector3d& travel_m,
                           double margin_m);

/// The share of travel_m, of the first box, after which the boxes begin to overlap; none if they do
/// not, or do from the start. Does not look at turning.
std::optional<double> meeting(const Box& first, const Box& second, const Eigen::Vector3d& travel_m);

/// The share of travel_m, of the first box, after which the boxes no longer overlap; none if they
/// do not overlap or still do at its end. Does not look at turning.
std::optional<double> parting(const Box& first, const Box& second, const Eigen::Vector3d& travel_m);

/// Contact of a box (first) with the table plane z = 0 (second): its lowest corners.
Contact contact_with_table(const Box& box, double margin_m);

}  // namespace heft
