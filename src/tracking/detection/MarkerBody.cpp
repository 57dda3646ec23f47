#include "tracking/detection/MarkerBody.h"

#include <algorithm>
#include <cmath>

namespace heft {

Eigen::Vector2d print_scale(const MarkerBody& body) {
  const double across_m = body.measured_ruler_m.value_or(ruler_m);
  return Eigen::Vector2d(across_m, body.measured_across_m.value_or(across_m)) / ruler_m;
}

namespace {
MarkerBody scaled(MarkerBody body, double across, double down) {
  const bool is_board = body.size_m.isZero();
  body.size_m = body.size_m.cwiseProduct(Eigen::Vector3d(down, across, across));
  body.chamfer_m *= across;
  for (Tag& tag : body.tags) {
    const bool on_end = std::abs(tag_normal(tag).x()) > 0.9;
    const Eigen::Vector3d along_axes = is_board ? Eigen::Vector3d(across, down, across)
                                       : on_end ? Eigen::Vector3d(down, across, down)
                                                : Eigen::Vector3d(down, across, across);
    for (Eigen::Vector3d& corner_m : tag.corners_m) corner_m = corner_m.cwiseProduct(along_axes);
  }
  return body;
}
}  // namespace

MarkerBody as_printed(const MarkerBody& designed) {
  const Eigen::Vector2d scale = print_scale(designed);
  return scaled(designed, scale.x(), scale.y());
}

MarkerBody as_designed(const MarkerBody& printed) {
  const Eigen::Vector2d scale = print_scale(printed);
  return scaled(printed, 1 / scale.x(), 1 / scale.y());
}

std::span<const BoxFace> faces_of(const BoxShape& box) {
  return std::span(box_faces).first(box.chamfer_m > 0 ? 8 : 6);
}

namespace {
// Outward direction, middle and width of a long side's face between chamfers.
struct LongFace {
  Eigen::Vector3d outwards, center_m;
  double width_m;
};

LongFace long_face(const BoxShape& box, BoxFace face) {
  const double width = box.size_m.y(), height = box.size_m.z(), cut = box.chamfer_m;
  const double slant = std::sqrt(0.5), side_z = -cut / 2;
  const double upper_y = (width - cut) / 2, upper_z = (height - cut) / 2;
  switch (face) {
    case BoxFace::top:
      return {{0, 0, 1}, {0, 0, height / 2}, width - 2 * cut};
    case BoxFace::left:
      return {{0, 1, 0}, {0, width / 2, side_z}, height - cut};
    case BoxFace::right:
      return {{0, -1, 0}, {0, -width / 2, side_z}, height - cut};
    case BoxFace::upper_left:
      return {{0, slant, slant}, {0, upper_y, upper_z}, cut / slant};
    case BoxFace::upper_right:
      return {{0, -slant, slant}, {0, -upper_y, upper_z}, cut / slant};
    default:
      return {{0, 0, -1}, {0, 0, -height / 2}, width};
  }
}
}  // namespace

FaceFrame face_frame(const BoxShape& box, BoxFace face) {
  const double length = box.size_m.x();
  if (face == BoxFace::tip || face == BoxFace::back) {
    const double sign = face == BoxFace::tip ? 1 : -1;
    return {{sign * length / 2, 0, 0},
            {0, sign, 0},
            {0, 0, 1},
            {box.size_m.y(), box.size_m.z()},
            box.chamfer_m};
  }
  const auto [outwards, center_m, width_m] = long_face(box, face);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitX();
  return {center_m, up.cross(outwards), up, {width_m, length}};
}

Eigen::Vector3d FaceFrame::normal() const {
  return right.cross(up);
}

Eigen::Vector3d FaceFrame::at(const Eigen::Vector2d& point_m) const {
  return center_m + point_m.x() * right + point_m.y() * up;
}

Eigen::Vector2d FaceFrame::flat(const Eigen::Vector3d& point_m) const {
  return {(point_m - center_m).dot(right), (point_m - center_m).dot(up)};
}

std::vector<Eigen::Vector2d> FaceFrame::outline_m() const {
  const double x = size_m.x() / 2, y = size_m.y() / 2;
  if (cut_m <= 0) return {{-x, y}, {x, y}, {x, -y}, {-x, -y}};
  return {{-x + cut_m, y}, {x - cut_m, y}, {x, y - cut_m}, {x, -y}, {-x, -y}, {-x, y - cut_m}};
}

double FaceFrame::inside_m(const Eigen::Vector2d& point_m) const {
  const Eigen::Vector2d half_m = size_m / 2, in_m = half_m - point_m.cwiseAbs();
  const double below_cut_m = in_m.x() + half_m.y() - point_m.y() - cut_m;
  return std::min(in_m.minCoeff(), cut_m > 0 ? below_cut_m * std::sqrt(0.5) : in_m.x());
}

Tag tag_on(const FaceFrame& face, int id, const Eigen::Vector2d& center_m, double side_m) {
  const double half_m = side_m / 2;
  const auto corner = [&](double x, double y) {
    return face.at(center_m + Eigen::Vector2d(x, y) * half_m);
  };
  return {id, {corner(-1, 1), corner(1, 1), corner(1, -1), corner(-1, -1)}};
}

Eigen::Vector3d tag_normal(const Tag& tag) {
  const auto& c = tag.corners_m;  // of the diagonals, also for inexact squares
  return (c[1] - c[3]).cross(c[0] - c[2]).normalized();
}

Eigen::Vector3d tag_center_m(const Tag& tag) {
  const auto& c = tag.corners_m;
  return (c[0] + c[1] + c[2] + c[3]) / 4;
}

MarkerBody with_scaled_tags(MarkerBody body, double scale) {
  for (Tag& tag : body.tags) {
    const Eigen::Vector3d center_m = tag_center_m(tag);
    for (Eigen::Vector3d& corner_m : tag.corners_m)
      corner_m = center_m + scale * (corner_m - center_m);
  }
  return body;
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
