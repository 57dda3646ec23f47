// Contact detection between boxes, also swept along a path, and with the table. Geometry only.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "base/PoseTypes.h"

namespace heft {

struct Box {
  Eigen::Vector3d half_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: its x, y and z in the world
};

/// @param size_m edge lengths along the box's own axes
Box box_at(const Pose& pose, const Eigen::Vector3d& size_m);

struct ContactPoint {
  Eigen::Vector3d on_first_m, on_second_m;
  double distance_m = 0;  ///< along the normal; negative where the boxes overlap
  int feature = 0;        ///< identifies a corner or edge from step to step
};

/// Contact of two bodies: up to four points with a common normal.
struct Contact {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, from the second to the first
  std::array<ContactPoint, 4> points;
  int n_points = 0;

  std::span<const ContactPoint> all() const {
    return {points.data(), static_cast<std::size_t>(n_points)};
  }
};

/// Contact of two boxes nearer than margin_m (separating-axis test and clipping). It includes
/// points at positive distances, so that a solver can stop the boxes before they overlap.
Contact contact_between(const Box& first, const Box& second, double margin_m);

/// The same for a first box that moves by travel_m relative to the second, without rotation. If the
/// boxes meet on the way, the contact is found there and moved back to the current position, which
/// selects the face that will be hit.
Contact contact_on_the_way(const Box& first, const Box& second, const Eigen::Vector3d& travel_m,
                           double margin_m);

/// Fraction of travel_m of the first box at which the boxes stop overlapping, without rotation;
/// none if they do not overlap, or still do at its end.
std::optional<double> parting(const Box& first, const Box& second, const Eigen::Vector3d& travel_m);

/// Contact of a box (first) with the table plane z = 0 (second): its lowest corners.
Contact contact_with_table(const Box& box, double margin_m);

}  // namespace heft
