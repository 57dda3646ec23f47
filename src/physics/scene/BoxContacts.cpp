#include "physics/scene/BoxContacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/math/Geometry.h"

namespace heft {

namespace {
using Eigen::Matrix3d;
using Eigen::Vector3d;

// A corner in coordinates of the reference face: u, v along it from its center, w above it.
struct FaceCorner {
  double u = 0, v = 0, w = 0;  ///< m
  int feature = 0;             ///< identifies a corner from step to step
};

using FacePolygon = Polygon<FaceCorner, 9>;  ///< a quadrilateral cut by four lines has eight

// The part of a face with sign * coordinate <= limit. clip, the index 0...3 of the clipping line,
// is part of new corners' features.
FacePolygon clipped(const FacePolygon& face, double FaceCorner::*coordinate, double sign,
                    double limit, int clip) {
  return clipped(
      face, [&](const FaceCorner& corner) { return limit - sign * (corner.*coordinate); },
      [&](const FaceCorner& from, const FaceCorner& to, double s) -> FaceCorner {
        return {from.u + s * (to.u - from.u), from.v + s * (to.v - from.v),
                from.w + s * (to.w - from.w),
                16 * (4 * (from.feature % 16) + to.feature % 16) + 4 + clip};
      });
}

// Reduces a polygon to four corners: the deepest, the farthest from it, and the farthest to each
// side of the line between these two.
void keep_four(FacePolygon& polygon) {
  if (polygon.size() <= 4) return;
  const auto begin = polygon.begin(), end = polygon.end();
  const auto pick = [&](auto from, auto score) {
    std::iter_swap(from, std::max_element(from, end, [&](const FaceCorner& x, const FaceCorner& y) {
                     return score(x) < score(y);
                   }));
    return *from;
  };
  const FaceCorner p = pick(begin, [](const FaceCorner& c) { return -c.w; });
  const FaceCorner q =
      pick(begin + 1, [&](const FaceCorner& c) { return std::hypot(c.u - p.u, c.v - p.v); });
  const auto side = [&](const FaceCorner& c) {
    return (q.u - p.u) * (c.v - p.v) - (q.v - p.v) * (c.u - p.u);
  };
  pick(begin + 2, side);
  pick(begin + 3, [&](const FaceCorner& c) { return -side(c); });
  polygon.keep_first(4);
}

// Among axes with nearly equal gaps, faces of the first box are preferred to those of the second,
// and faces to edges, so that the choice is stable from step to step.
constexpr double face_preference_m = 1e-5;
constexpr double edge_preference_m = 5e-5;
constexpr double parallel_edges = 1e-3;  // sine of their angle

struct Axis {
  enum class Kind { first_face, second_face, edges } kind = Kind::first_face;
  double gap_m = -std::numeric_limits<double>::infinity();
  Vector3d direction = Vector3d::UnitX();  // unit, from the first to the second
  int first = 0, second = 0;               // indices of the box axes that define it
};

double reach_m(const Box& box, const Vector3d& direction) {
  return (box.axes.transpose() * direction).cwiseAbs().dot(box.half_m);
}

// Separating axes in the frame of the first box (Gottschalk, Lin and Manocha 1996). Returns early
// when a gap is wider than enough_m.
Axis widest_gap(const Box& a, const Box& b, double enough_m) {
  const Vector3d between = a.axes.transpose() * (b.center_m - a.center_m);
  const Matrix3d turn = a.axes.transpose() * b.axes;
  const Matrix3d reach = turn.cwiseAbs();
  Axis best;
  const auto try_axis = [&](Axis::Kind kind, double gap_m, int first, int second,
                            double preference_m) {
    if (gap_m > best.gap_m + preference_m) best = {kind, gap_m, Vector3d::UnitX(), first, second};
  };
  for (int i = 0; i < 3; ++i)
    try_axis(Axis::Kind::first_face,
             std::abs(between[i]) - a.half_m[i] - reach.row(i).dot(b.half_m), i, 0, 0);
  for (int j = 0; j < 3; ++j)
    try_axis(Axis::Kind::second_face,
             std::abs(turn.col(j).dot(between)) - b.half_m[j] - reach.col(j).dot(a.half_m), 0, j,
             face_preference_m);
  if (best.gap_m >= enough_m) return best;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const double sine_squared = 1 - turn(i, j) * turn(i, j);
      if (!(sine_squared > parallel_edges * parallel_edges)) continue;
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double apart_m = std::abs(between[i2] * turn(i1, j) - between[i1] * turn(i2, j));
      const double reaches_m = a.half_m[i1] * reach(i2, j) + a.half_m[i2] * reach(i1, j) +
                               b.half_m[j1] * reach(i, j2) + b.half_m[j2] * reach(i, j1);
      try_axis(Axis::Kind::edges, (apart_m - reaches_m) / std::sqrt(sine_squared), i, j,
               edge_preference_m);
    }
  }
  switch (best.kind) {
    case Axis::Kind::first_face:
      best.direction = a.axes.col(best.first);
      break;
    case Axis::Kind::second_face:
      best.direction = b.axes.col(best.second);
      break;
    case Axis::Kind::edges:
      best.direction = a.axes.col(best.first).cross(b.axes.col(best.second)).normalized();
  }
  if (best.direction.dot(b.center_m - a.center_m) < 0) best.direction = -best.direction;
  return best;
}

// The fractions of travel_m of `a` between which the boxes overlap, that is, along every axis.
// leave < enter if they never do.
struct Passage {
  double enter = -1, leave = 2;
};

Passage passage(const Box& a, const Box& b, const Vector3d& travel_m) {
  const Vector3d between_m = b.center_m - a.center_m;
  Passage passage;
  const auto cut = [&](const Vector3d& axis) {
    const double squared = axis.squaredNorm();
    if (squared < parallel_edges * parallel_edges) return;
    const double reach = reach_m(a, axis) + reach_m(b, axis);
    const double at = between_m.dot(axis), by = travel_m.dot(axis);
    if (std::abs(by) < 1e-12) {
      if (std::abs(at) >= reach) passage.leave = -2;
      return;
    }
    const double in = (at - std::copysign(reach, by)) / by,
                 out = (at + std::copysign(reach, by)) / by;
    passage.enter = std::max(passage.enter, in);
    passage.leave = std::min(passage.leave, out);
  };
  for (int i = 0; i < 3; ++i) {
    cut(a.axes.col(i));
    cut(b.axes.col(i));
    for (int j = 0; j < 3; ++j) cut(a.axes.col(i).cross(b.axes.col(j)));
  }
  return passage;
}

// The face of `box` most opposed to `normal`, in coordinates of the reference face.
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
  const auto far = std::remove_if(face.begin(), face.end(),
                                  [&](const FaceCorner& c) { return !(c.w < margin_m); });
  face.keep_first(static_cast<std::size_t>(far - face.begin()));
  keep_four(face);

  Contact contact;
  contact.normal = reference_is_first ? Vector3d(-normal) : normal;
  for (const FaceCorner& corner : face) {
    const Vector3d on_reference_m = face_center_m + corner.u * u + corner.v * v;
    const Vector3d on_other_m = on_reference_m + corner.w * normal;
    auto& point = contact.points[static_cast<std::size_t>(contact.n_points++)];
    point = {reference_is_first ? on_reference_m : on_other_m,
             reference_is_first ? on_other_m : on_reference_m, corner.w,
             2 * corner.feature + (reference_is_first ? 0 : 1)};
  }
  return contact;
}

// Middle of the edge along box axis k that is farthest towards `direction`.
Vector3d edge_middle_m(const Box& box, const Vector3d& direction, int k) {
  Vector3d middle_m = box.center_m;
  for (int i = 0; i < 3; ++i)
    if (i != k)
      middle_m += std::copysign(box.half_m[i], box.axes.col(i).dot(direction)) * box.axes.col(i);
  return middle_m;
}

// Two crossing edges touch at the points where their lines are nearest.
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

// Fraction of travel_m of the first box at which the boxes begin to overlap; none if they do not,
// or overlap from the start.
std::optional<double> meeting(const Box& first, const Box& second, const Vector3d& travel_m) {
  const auto [enter, leave] = passage(first, second, travel_m);
  if (enter <= 0 || enter > 1 || enter >= std::min(leave, 1.0)) return std::nullopt;
  return enter;
}
}  // namespace

Box box_at(const Pose& pose, const Vector3d& size_m) {
  return {size_m / 2, pose.position_m, pose.orientation.toRotationMatrix()};
}

Contact contact_between(const Box& first, const Box& second, double margin_m) {
  const double reach_m = first.half_m.norm() + second.half_m.norm() + margin_m;
  if ((first.center_m - second.center_m).squaredNorm() > reach_m * reach_m) return {};
  const Axis axis = widest_gap(first, second, margin_m);
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

Contact contact_on_the_way(const Box& first, const Box& second, const Vector3d& travel_m,
                           double margin_m) {
  const auto fraction = meeting(first, second, travel_m);
  if (!fraction) return contact_between(first, second, margin_m);
  const Vector3d moved_m = *fraction * travel_m;
  Box there = first;
  there.center_m += moved_m;
  Contact contact = contact_between(there, second, margin_m);
  for (ContactPoint& point : contact.points) {
    point.on_first_m -= moved_m;
    point.distance_m -= contact.normal.dot(moved_m);
  }
  return contact;
}

std::optional<double> parting(const Box& first, const Box& second, const Vector3d& travel_m) {
  const auto [enter, leave] = passage(first, second, travel_m);
  if (leave <= enter || leave <= 0 || leave >= 1) return std::nullopt;
  return leave;
}

Contact contact_with_table(const Box& box, double margin_m) {
  const double half_height_m = box.axes.row(2).cwiseAbs().dot(box.half_m);
  if (box.center_m.z() - half_height_m >= margin_m) return {};
  const auto corner_m = [&](int i) -> Vector3d {
    const Vector3d signs(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    return box.center_m + box.axes * signs.cwiseProduct(box.half_m);
  };
  struct Corner {
    double height_m;
    int index;
  };
  std::array<Corner, 8> corners;
  for (int i = 0; i < 8; ++i) corners[static_cast<std::size_t>(i)] = {corner_m(i).z(), i};
  std::partial_sort(corners.begin(), corners.begin() + 4, corners.end(),
                    [](const Corner& x, const Corner& y) { return x.height_m < y.height_m; });
  Contact contact;
  for (const auto& [height_m, i] : std::span(corners).first(4)) {
    if (height_m >= margin_m) break;
    const Vector3d at_m = corner_m(i);
    contact.points[static_cast<std::size_t>(contact.n_points++)] = {
        at_m, {at_m.x(), at_m.y(), 0}, height_m, i};
  }
  return contact;
}

}  // namespace heft
