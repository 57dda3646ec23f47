#include "tracking/pose/TagModel.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/PoseTypes.h"
#include "tracking/detection/FitMath.h"

namespace heft {

namespace {
// Objects beyond the white cell around the border, perhaps an edge of the box, must not blur into
// the compared pixels.
constexpr double most_beyond_cells = 0.45, far_in_blurs = 3;
constexpr double most_blur_cells = 0.45;
constexpr double least_blur_px = 0.29;  // a pixel's extent: 1 / sqrt(12)
constexpr double edge_in_blurs = 2.5;
constexpr double least_contrast = 0.002;  // relative to the light of displayed white
// The pattern is padded with its outermost cells, because four cells around a pixel are used.
constexpr int padding = 3;

// Weights of a tag's cells along one axis around a place: the part of the blur over each of four.
// The next cells are 1.5 cells away, 3.3 times the widest blur.
struct Weights {
  enum Column { weight, by_place, by_log_blur };
  int first;  ///< cell
  Eigen::Matrix<double, 4, 3> columns;
};

Weights weights_at(double place, double blur_cells) {
  Weights w;
  const int nearest_edge = static_cast<int>(place + (padding + 0.5)) - padding;
  w.first = nearest_edge - 2;
  const double sharp = 1 / blur_cells;
  Eigen::RowVector3d before(1, 0, 0);
  for (int i = 0; i < 3; ++i) {
    const double q = (place - (nearest_edge - 1 + i)) * sharp;
    const Normal normal = normal_at(q);
    const Eigen::RowVector3d here(normal.below, normal.density * sharp, -q * normal.density);
    w.columns.row(i) = before - here;
    before = here;
  }
  w.columns.row(3) = before;
  return w;
}

}  // namespace

TagPlane::TagPlane(const Pose& pose, const std::array<Eigen::Vector3d, 4>& c, int n_cells)
    : corner_m(pose * c[0]),
      right_m(pose.orientation * (c[1] - c[0]) / n_cells),
      down_m(pose.orientation * (c[3] - c[0]) / n_cells) {
  Eigen::Matrix3d sides;
  sides << right_m, down_m, corner_m;
  cell_of = sides.inverse();
}

TagHit::TagHit(const TagPlane& plane, const Eigen::Vector2d& ray) {
  const Eigen::Vector3d at_depth_1 = plane.cell_of.leftCols<2>() * ray + plane.cell_of.col(2);
  const double depth_m = 1 / at_depth_1.z();
  cell = depth_m * at_depth_1.head<2>();
  cell_by_slant = plane.cell_of.topLeftCorner<2, 2>() - cell * plane.cell_of.row(2).head<2>();
  point_m = depth_m * ray.homogeneous();
}

TagModel::TagModel(const DenseTag& tag, const ToneCurve& curve)
    : seen_(*tag.seen),
      pattern_(*tag.pattern),
      curve_(curve),
      blur_px_(std::max(least_blur_px, tag.seen->blur_px[0]),
               std::max(least_blur_px, tag.seen->blur_px[1])) {
  own_(dark) = curve.light(seen_.dark);
  own_(contrast) = curve.light(seen_.bright) - own_(dark);
  paint();
}

void TagModel::paint() {
  n_painted_ = pattern_.border_cells + 2 * padding;
  white_.resize(n_painted_, n_painted_);
  const int margin = pattern_.margin_cells(), last = pattern_.n_cells - 1;
  for (int row = 0; row < n_painted_; ++row)
    for (int column = 0; column < n_painted_; ++column)
      white_(row, column) = pattern_.is_white(std::clamp(column - padding + margin, 0, last),
                                              std::clamp(row - padding + margin, 0, last));
}

bool TagModel::is_clear() const {
  const double cell_px = std::sqrt(seen_.area_px2) / pattern_.border_cells;
  return own_(contrast) > least_contrast && blur_px_.maxCoeff() < most_blur_cells * cell_px;
}

TagPlane TagModel::plane(const Pose& pose) const {
  return {pose, seen_.corners_m, pattern_.border_cells};
}

TagHit TagModel::middle(const TagPlane& plane) const {
  const Eigen::Vector3d middle_m =
      plane.corner_m + pattern_.border_cells / 2.0 * (plane.right_m + plane.down_m);
  return TagHit(plane, middle_m.hnormalized());
}

// The variance added by motion along its direction, from that added across the borders.
void TagModel::smear_along(const Smear& smear, const Pose& pose) {
  const TagHit hit = middle(plane(pose));
  const Eigen::Vector3d v =
      smear.velocity.linear_m_s + smear.velocity.angular_rad_s.cross(hit.point_m - pose.position_m);
  const Eigen::Vector2d way = v.head<2>() - v.z() * hit.point_m.hnormalized();
  if (!(way.norm() > 0)) return;
  const Eigen::Vector2d across = (hit.cell_by_slant.rowwise().normalized() * way.normalized())
                                     .cwiseAbs2();  // of the motion, across each kind of border
  const double still = smear.still_blur_px * smear.still_blur_px;
  const Eigen::Vector2d added = blur_px_.cwiseAbs2().array() - still;
  const double variance = std::max(0.0, across.dot(added) / across.squaredNorm());
  blur_shape_ += variance / still * way.normalized() * way.normalized().transpose();
}

Eigen::Vector2d TagModel::beyond_cells(const TagPlane& plane) const {
  const TagHit hit = middle(plane);
  const double pixel_m = hit.point_m.z() / seen_.px_per_ray;
  Eigen::Vector2d beyond;
  for (int i = 0; i < 2; ++i)
    beyond(i) = std::clamp(pattern_.margin_cells() - far_in_blurs * blur_px_(i) * pixel_m *
                                                         hit.cell_by_slant.row(i).norm(),
                           0.0, most_beyond_cells);
  return beyond;
}

Eigen::Vector2d TagModel::near_cells(const TagPlane& plane) const {
  const TagHit hit = middle(plane);
  const double pixel_m = hit.point_m.z() / seen_.px_per_ray;
  const Eigen::Vector2d cell_by_px = pixel_m * hit.cell_by_slant.rowwise().norm();
  return (edge_in_blurs * cell_by_px.cwiseProduct(blur_px_)).cwiseMin(0.5);
}

bool TagModel::is_flat(const Eigen::Vector2d& cell, const Eigen::Vector2d& near) const {
  const auto is_white = [&](double right, double below) {
    const auto place = [&](double at) {
      return std::clamp(static_cast<int>(at + padding), 0, n_painted_ - 1);
    };
    return white_(place(cell.y() + below), place(cell.x() + right)) > 0;
  };
  const bool here = is_white(-near.x(), -near.y());
  return is_white(near.x(), -near.y()) == here && is_white(-near.x(), near.y()) == here &&
         is_white(near.x(), near.y()) == here;
}

void TagModel::change_own(const VectorOwn& change) {
  own_ += change;
  own_(log_blur) = std::clamp(own_(log_blur), -0.5, 0.5);
  wider_ = std::exp(own_(log_blur));
}

double TagModel::gray_level(const Eigen::Vector2d& ray, const TagPlane& plane, const Pose& pose,
                            double bias_px, VectorAll& by) const {
  const TagHit hit(plane, ray);
  // A pixel's size on the tag.
  const double pixel_m = hit.point_m.z() / seen_.px_per_ray;
  const Eigen::Vector2d cell_by_px = pixel_m * hit.cell_by_slant.rowwise().norm();
  const Eigen::Vector2d blur = wider_ * cell_by_px.cwiseProduct(blur_px_);
  const Weights across = weights_at(hit.cell.x(), blur.x());
  const Weights below = weights_at(hit.cell.y(), blur.y());
  // For slanted or smeared tags the blur is an inclined ellipse on the tag: two terms of Mehler's
  // series.
  const Eigen::Matrix2d shape = hit.cell_by_slant * blur_shape_ * hit.cell_by_slant.transpose();
  const double correlation = shape(0, 1) / std::sqrt(shape(0, 0) * shape(1, 1));
  const double slanted = correlation * blur.prod(), twice = correlation * correlation / 2;
  const int first_row = std::clamp(below.first + padding, 0, n_painted_ - 4);
  const int first_column = std::clamp(across.first + padding, 0, n_painted_ - 4);
  using enum Weights::Column;
  const Eigen::Matrix<double, 4, 3> rows =
      white_.block<4, 4>(first_row, first_column) * across.columns;
  const Eigen::Matrix3d sums = below.columns.transpose() * rows;
  const double b = sums(weight, weight) + slanted * sums(by_place, by_place) +
                   twice * sums(by_log_blur, by_log_blur);
  const Eigen::Vector2d by_cell(sums(weight, by_place), sums(by_place, weight));
  const double by_blur = sums(weight, by_log_blur) + sums(by_log_blur, weight);
  const Eigen::Vector2d slope = -(hit.cell_by_slant.transpose() * by_cell);
  const double shrinks = -slope.norm() * pixel_m;  // of white, per pixel of bias
  const double white = b + shrinks * bias_px;
  const double half = pattern_.border_cells / 2.0;
  const Eigen::Vector2d place = (hit.cell.array() - half) / half;
  const double brighter = 1 + own_(along) * place.x() + own_(down) * place.y();
  Eigen::Matrix<double, n_reflected, 1> powers;
  powers << place, place.cwiseAbs2(), place.prod();
  const double light = own_(dark) + own_(contrast) * white + own_.tail<n_reflected>().dot(powers);
  const Stored stored = curve_.stored(light * brighter);
  const double by_light = stored.by_light * brighter, by_b = by_light * own_(contrast);
  const Eigen::Vector3d by_point(by_b * slope.x(), by_b * slope.y(), -by_b * slope.dot(ray));
  const Eigen::Vector3d arm = hit.point_m - pose.position_m;
  by << arm.cross(by_point), by_point, by_b * shrinks, by_light, by_light * white,
      stored.by_light * light * place, by_b * by_blur, by_light * powers;
  return stored.value;
}

}  // namespace heft
