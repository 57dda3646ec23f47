#include "tracking/MarkerBody.h"

#include <cmath>

namespace heft {

Eigen::Vector3d print_scale(const MarkerBody& body) {
  const double along_m = body.measured_ruler_m.value_or(ruler_m);
  return Eigen::Vector3d(along_m, body.measured_across_m.value_or(along_m), along_m) / ruler_m;
}

FaceFrame face_frame(const Eigen::Vector3d& size_m, BoxFace face) {
  static const std::array<Eigen::Vector3d, 6> outwards{
      {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, -1, 0}, {0, 0, -1}, {-1, 0, 0}}};  // as box_faces
  const Eigen::Vector3d& normal = outwards[static_cast<std::size_t>(face)];
  const bool is_end = face == BoxFace::tip || face == BoxFace::back;
  const Eigen::Vector3d up = is_end ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d right = up.cross(normal);
  return {normal.cwiseProduct(size_m) / 2,
          right,
          up,
          {right.cwiseAbs().dot(size_m), up.cwiseAbs().dot(size_m)}};
}

Tag tag_on(const FaceFrame& face, int id, const Eigen::Vector2d& center_m, double side_m) {
  const double half_m = side_m / 2;
  const auto corner = [&](double x, double y) {
    return face.at(center_m + Eigen::Vector2d(x, y) * half_m);
  };
  return {id, {corner(-1, 1), corner(1, 1), corner(1, -1), corner(-1, -1)}};
}

Eigen::Vector3d tag_normal(const Tag& tag) {
  const auto& c = tag.corners_m;  // of the diagonals: also for corners that are no exact square
  return (c[1] - c[3]).cross(c[0] - c[2]).normalized();
}

Eigen::Vector3d tag_center_m(const Tag& tag) {
  const auto& c = tag.corners_m;
  return (c[0] + c[1] + c[2] + c[3]) / 4;
}

Pose body_from_tag(const Tag& tag) {
  const auto& c = tag.corners_m;
  const Eigen::Vector3d out = tag_normal(tag);
  const Eigen::Vector3d across = (c[1] + c[2] - c[0] - c[3]).normalized();
  const Eigen::Vector3d right = (across - across.dot(out) * out).normalized();
  Eigen::Matrix3d axes;
  axes << right, out.cross(right), out;
  return {tag_center_m(tag), Eigen::Quaterniond(axes)};
}

}  // namespace heft
