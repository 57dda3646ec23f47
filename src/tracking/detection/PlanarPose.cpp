#include "tracking/detection/PlanarPose.h"

#include <opencv2/calib3d.hpp>

#include "base/PoseTypes.h"
#include "tracking/camera/ImageConversion.h"

namespace heft {

Eigen::Matrix3d square_to(const std::array<Eigen::Vector2d, 4>& c) {
  const Eigen::Vector2d d1 = c[1] - c[2], d2 = c[3] - c[2], sum = c[0] - c[1] + c[2] - c[3];
  const double area = d1.x() * d2.y() - d2.x() * d1.y();
  const double g = (sum.x() * d2.y() - d2.x() * sum.y()) / area;
  const double h = (d1.x() * sum.y() - sum.x() * d1.y()) / area;
  Eigen::Matrix3d m;
  m.col(0) << c[1] - c[0] + g * c[1], g;
  m.col(1) << c[3] - c[0] + h * c[3], h;
  m.col(2) << c[0], 1;
  return m;
}

namespace {
// The corners' plane: origin in their middle, z along its normal. OpenCV 4.6 mirrors points whose z
// is not 0.
Pose plane_of(const std::array<Eigen::Vector3d, 4>& corners_m) {
  const Eigen::Vector3d right = (corners_m[1] - corners_m[0]).normalized();
  const Eigen::Vector3d out = (corners_m[2] - corners_m[0]).cross(corners_m[3] - corners_m[1]);
  Eigen::Matrix3d axes;
  axes.col(0) = right;
  axes.col(2) = out.normalized();
  axes.col(1) = axes.col(2).cross(right);
  return {(corners_m[0] + corners_m[1] + corners_m[2] + corners_m[3]) / 4,
          Eigen::Quaterniond(axes).normalized()};
}
}  // namespace

std::vector<Pose> planar_poses(const std::array<Eigen::Vector3d, 4>& corners_m,
                               const std::array<Eigen::Vector2d, 4>& rays) {
  const Pose source_from_plane = plane_of(corners_m);
  const Eigen::Quaterniond plane_from_source = source_from_plane.orientation.conjugate();
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> seen;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d flat = plane_from_source * (corners_m[i] - source_from_plane.position_m);
    points.emplace_back(flat.x(), flat.y(), 0);
    seen.emplace_back(rays[i].x(), rays[i].y());
  }
  std::vector<cv::Mat> rotations, translations;
  try {
    cv::solvePnPGeneric(points, seen, cv::Matx33d::eye(), cv::noArray(), rotations, translations,
                        false, cv::SOLVEPNP_IPPE);
  } catch (const cv::Exception&) {
    return {};  // OpenCV throws for collinear corners
  }
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const Pose camera_from_plane = pose_from(rotations[i], translations[i]);
    const Eigen::Quaterniond turn = camera_from_plane.orientation * plane_from_source;
    const Pose pose{camera_from_plane.position_m - turn * source_from_plane.position_m,
                    turn.normalized()};
    const bool finite = pose.position_m.allFinite() && pose.orientation.coeffs().allFinite();
    if (finite && (pose * corners_m[0]).z() > 0) poses.push_back(pose);
  }
  return poses;
}

}  // namespace heft
