#include "results/tracking/limits/Bound.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/Pose.h"
#include "results/tracking/Filming.h"
#include "tracking/camera/ImageConversion.h"
#include "tracking/camera/Intrinsics.h"

namespace heft {

namespace {
constexpr double step_m = 0.0001;        // an eighth of a pixel at 640 across
constexpr double rounding = 1.0 / 12;    // variance of levels
constexpr double margin_share = 0.0625;  // half a cell of most families' tags, beyond the border

SyntheticSettings without_noise(SyntheticSettings settings) {
  settings.optics.noise = 0;
  return settings;
}

// A tag's plane in the camera's frame, and how far a tag reaches on it.
struct FacedTag {
  Eigen::Vector3d corner_m, right_m, down_m, normal;

  FacedTag(const Pose& camera_from_body, const Tag& tag)
      : corner_m(camera_from_body * tag.corners_m[0]),
        right_m(camera_from_body.orientation * (tag.corners_m[1] - tag.corners_m[0])),
        down_m(camera_from_body.orientation * (tag.corners_m[3] - tag.corners_m[0])),
        normal(camera_from_body.orientation * tag_normal(tag)) {}

  bool faces_camera() const { return normal.dot(corner_m) < 0; }

  std::optional<Eigen::Vector3d> hit(const Eigen::Vector2d& ray) const {
    const Eigen::Vector3d along = ray.homogeneous();
    const Eigen::Vector3d point = along * (normal.dot(corner_m) / normal.dot(along));
    for (const Eigen::Vector3d& side : {right_m, down_m}) {
      const double share = (point - corner_m).dot(side) / side.squaredNorm();
      if (!(share > -margin_share && share < 1 + margin_share)) return std::nullopt;
    }
    return point;
  }
};

double level(const Image& gray, int x, int y) {
  return gray.pixels[static_cast<std::size_t>(y) * gray.row_bytes() + static_cast<std::size_t>(x)];
}

}  // namespace

TipBound::TipBound(const Apparatus& apparatus, const SyntheticSettings& settings)
    : apparatus_(apparatus),
      settings_(settings),
      camera_(apparatus, without_noise(settings), 1),
      variance_(settings.optics.noise * settings.optics.noise + rounding) {}

Image TipBound::shifted(const Pose& board_from_effector, const Eigen::Vector3d& by_m) {
  Pose pose = board_from_effector;
  pose.position_m += settings_.camera_from_board.orientation.inverse() * by_m;
  return gray_of(camera_.picture([&](double) { return pose; }, 0, 0));
}

// How levels change over the picture comes from four renderings, how the picture moves with the
// pose from geometry.
TipBound::Matrix6 TipBound::information(const Pose& board_from_effector) {
  const Eigen::Vector3d right(step_m, 0, 0), down(0, step_m, 0);
  const std::array images{shifted(board_from_effector, right), shifted(board_from_effector, -right),
                          shifted(board_from_effector, down), shifted(board_from_effector, -down)};
  const Pose pose = settings_.camera_from_board * board_from_effector;
  const Intrinsics& camera = apparatus_.camera;
  Matrix6 sum = Matrix6::Zero();
  for (const Tag& tag : apparatus_.effector.tags) {
    const FacedTag seen(pose, tag);
    if (!seen.faces_camera()) continue;
    for (int y = 0; y < camera.height_px; ++y)
      for (int x = 0; x < camera.width_px; ++x) {
        const Eigen::RowVector2d change(level(images[0], x, y) - level(images[1], x, y),
                                        level(images[2], x, y) - level(images[3], x, y));
        if (change.isZero()) continue;
        const auto point_m = seen.hit(undistort(camera, Eigen::Vector2d(x, y)));
        if (!point_m) continue;
        const Eigen::Matrix<double, 2, 3> moves =
            project_with_derivative(camera, *point_m).pixel_by_point;
        const Eigen::RowVector2d slope = change / (2 * step_m) * moves.leftCols<2>().inverse();
        Eigen::Matrix<double, 1, 6> by;
        by << -slope * moves * cross_matrix(*point_m - pose.position_m), slope * moves;
        sum += by.transpose() * by / variance_;
      }
  }
  return sum;
}

std::optional<double> TipBound::tip_variance_m2(const Pose& board_from_effector) {
  const Eigen::LDLT<Matrix6> solver(information(board_from_effector));
  if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 0)) return std::nullopt;
  const Pose pose = settings_.camera_from_board * board_from_effector;
  Eigen::Matrix<double, 3, 6> tip_by_pose;
  tip_by_pose << -cross_matrix(pose.orientation * tip_of(apparatus_.effector)),
      Eigen::Matrix3d::Identity();
  return (tip_by_pose * solver.solve(tip_by_pose.transpose())).trace();
}

}  // namespace heft
