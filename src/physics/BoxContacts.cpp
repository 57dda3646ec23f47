#include "physics/BoxContacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/FacePolygon.h"

namespace heft {

namespace {
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Among axes that separate about equally well, the first box's faces are preferred to the second's
// and faces to edges, so that the choice does not flicker between steps.
constexpr double face_preference_m = 1e-5;
constexpr double edge_preference_m = 5e-5;
constexpr double parallel_edges = 1e-3;  // sine of their angle

struct Axis {
  enum class Kind { first_face, second_face, edges } kind = Kind::first_face;
  double gap_m = -std::numeric_limits<double>::infinity();
  Vector3d direction = Vector3d::UnitX();  // unit, from the first to the second
  int first = 0, second = 0;               // indices of the box axes it is made of
};

double reach_m(const Box& box, const Vector3d& direction) {
  return (box.axes.transpose() * direction).cwiseAbs().dot(box.half_m);
}

Axis widest_gap(const Box& a, const Box& b) {
  const Vector3d between = b.center_m - a.center_m;
  Axis best;
  const auto try_axis = [&](Axis::Kind kind, Vector3d direction, int first, int second,
                            double preference_m) {
    if (direction.dot(between) < 0) direction = -direction;
    const double gap_m = direction.dot(between) - reach_m(a, direction) - reach_m(b, direction);
    if (gap_m > best.gap_m + preference_m) best = {kind, gap_m, direction, first, second};
  };
  for (int i = 0; i < 3; ++i) try_axis(Axis::Kind::first_face, a.axes.col(i), i, 0, 0);
  for (int j = 0; j < 3; ++j)
    try_axis(Axis::Kind::second_face, b.axes.col(j), 0, j, face_preference_m);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vector3d cross = a.axes.col(i).cross(b.axes.col(j));
      const double sine = cross.norm();
      if (sine > parallel_edges) try_axis(Axis::Kind::edges, cross / sine, i, j, edge_preference_m);
    }
  }
  return best;
}

// The face of `box` that looks most against `normal`, in coordinates of the reference face.
FacePolygon facing_face(const Box& box, const Vector3d& normal, const Vector3d& face_center_m,
                        const Vector3d& u, const Vector3d& v) {
  Eigen::Index k = 0;
  const Vector3d along = box.axes.transpose() * normal;
  along.cwiseAbs().maxCoeff(&k);
  const Eigen::Index i = (k + 1) % 3, j = (k + 2) % 3;
  const Vector3d center_m =
      box.center_m - std::copysign(box.half_m[k], along[k]) * box.axes.col(k) - face_center_m;
  const Vector3d side_m = box.half_m[i] * box.axes.col(i),
                 other_m = box.half_m[j] * box.axes.col(j);
  FacePolygon face;
  int feature = 0;
  for (const auto& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const Vector3d corner_m = center_m + s * side_m + t * other_m;
    face.add({corner_m.dot(u), corner_m.dot(v), corner_m.dot(normal), feature++});
  }
  return face;
}

Contact face_contact(const Box& reference, const Box& other, const Vector3d& normal, int k,
                     double margin_m, bool reference_is_first) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const Vector3d u = reference.axes.col(i), v = reference.axes.col(j);
  const Vector3d face_center_m = reference.center_m + reference.half_m[k] * normal;
  FacePolygon face = facing_face(other, normal, face_center_m, u, v);
  face = clipped(face, &FaceCorner::u, 1, reference.half_m[i], 0);
  face = clipped(face, &FaceCorner::u, -1, reference.half_m[i], 1);
  face = clipped(face, &FaceCorner::v, 1, reference.half_m[j], 2);
  face = clipped(face, &FaceCorner::v, -1, reference.half_m[j], 3);
  std::size_t n = 0;
  for (std::size_t c = 0; c < face.n; ++c)
    if (face.corners[c].w < margin_m) face.corners[n++] = face.corners[c];
  face.n = n;
  keep_four(face);

  Contact contact;
  contact.normal = reference_is_first ? Vector3d(-normal) : normal;
  for (std::size_t c = 0; c < face.n; ++c) {
    const FaceCorner& corner = face.corners[c];
    const Vector3d on_reference_m = face_center_m + corner.u * u + corner.v * v;
    const Vector3d on_other_m = on_reference_m + corner.w * normal;
    auto& point = contact.points[static_cast<std::size_t>(contact.n_points++)];
    point = {reference_is_first ? on_reference_m : on_other_m,
             reference_is_first ? on_other_m : on_reference_m, corner.w,
             2 * corner.feature + (reference_is_first ? 0 : 1)};
  }
  return contact;
}

// The point in the middle of the edge along box axis k that reaches farthest towards `direction`.
Vector3d edge_middle_m(const Box& box, const Vector3d& direction, int k) {
  Vector3d middle_m = box.center_m;
  for (int i = 0; i < 3; ++i)
    if (i != k)
      middle_m += std::copysign(box.half_m[i], box.axes.col(i).dot(direction)) * box.axes.col(i);
  return middle_m;
}

// Two crossing edges touch where the lines through them come nearest.
Contact edge_contact(const Box& a, const Box& b, const Axis& axis) {
  const Vector3d u = a.axes.col(axis.first), v = b.axes.col(axis.second);
  const Vector3d p = edge_middle_m(a, axis.direction, axis.first);
  const Vector3d q = edge_middle_m(b, -axis.direction, axis.second);
  const double cosine = u.dot(v), along_u = u.dot(q - p), along_v = v.dot(q - p);
  const double denominator = 1 - cosine * cosine;
  const double s = (along_u - cosine * along_v) / denominator;
  const double t = (cosine * along_u - along_v) / denominator;
  Contact contact;
  contact.normal = -axis.direction;
  contact.points[0] = {p + s * u, q + t * v, axis.gap_m, -1 - 3 * axis.first - axis.second};
  contact.n_points = 1;
  return contact;
}
}  // namespace

Box box_at(const Pose& pose, const Vector3d& size_m) {
  return {size_m / 2, pose.position_m, pose.orientation.toRotationMatrix()};
}

Contact contact_between(const Box& first, const Box& second, double margin_m) {
  const double reach_m = first.half_m.norm() + second.half_m.norm() + margin_m;
  if ((first.center_m - second.center_m).squaredNorm() > reach_m * reach_m) return {};
  const Axis axis = widest_gap(first, second);
  if (axis.gap_m >= margin_m) return {};
  switch (axis.kind) {
    case Axis::Kind::first_face:
      return face_contact(first, second, axis.direction, axis.first, margin_m, true);
    case Axis::Kind::second_face:
      return face_contact(second, first, -axis.direction, axis.second, margin_m, false);
    case Axis::Kind::edges:
      return edge_contact(first, second, axis);
  }
  return {};
}

Contact contact_with_table(const Box& box, double margin_m) {
  if (box.center_m.z() - reach_m(box, Vector3d::UnitZ()) >= margin_m) return {};
  std::array<ContactPoint, 8> corners;
  for (int i = 0; i < 8; ++i) {
    const Vector3d signs(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    const Vector3d at_m = box.center_m + box.axes * signs.cwiseProduct(box.half_m);
    corners[static_cast<std::size_t>(i)] = {at_m, {at_m.x(), at_m.y(), 0}, at_m.z(), i};
  }
  std::partial_sort(corners.begin(), corners.begin() + 4, corners.end(),
                    [](const auto& x, const auto& y) { return x.distance_m < y.distance_m; });
  Contact contact;
  std::copy_n(corners.begin(), 4, contact.points.begin());
  while (contact.n_points < 4 &&
         contact.points[static_cast<std::size_t>(contact.n_points)].distance_m < margin_m)
    ++contact.n_points;
  return contact;
}

}  // namespace heft
