#include "tracking/synthetic/FilmedHand.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace heft {

namespace {
using Eigen::Vector2d;
using Eigen::Vector2f;
using Eigen::Vector3d;
using Eigen::Vector3f;

// Four neighboring pixels of a row at a time: the hand takes most of a picture's rendering time.
using Four = Eigen::Array4f;
struct FourVectors {
  Four x, y, z;
};

inline Four dot(const Vector3f& a, const FourVectors& b) {
  return a.x() * b.x + a.y() * b.y + a.z() * b.z;
}

inline Four clamped(const Four& value) {
  return value.max(0.0F).min(1.0F);
}

// Eigen's is an approximation that differs between processors.
inline Four root(const Four& value) {
  Four roots;
  for (int i = 0; i < 4; ++i) roots[i] = std::sqrt(value[i]);
  return roots;
}

struct Plane {
  Vector3f normal;
  float offset_m;
  float above_m(const Vector3f& point_m) const { return normal.dot(point_m) - offset_m; }
  Four above_m(const FourVectors& points_m) const { return dot(normal, points_m) - offset_m; }
};
}  // namespace

// Objects that occlude the skin or are occluded by it, in the camera's frame; float suffices.
struct FilmedHand::Surroundings {
  Plane table;
  std::array<Plane, 3> seen_faces;  // of the box; hidden ones have a zero normal
  Vector3f lamp;

  Surroundings(const SeenBody& effector, const Vector3d& half_m);

  // A point outside of a visible face is in front of the box, any other is not.
  template <typename Point>
  auto before_box_m(const Point& point_m) const {
    return larger(larger(seen_faces[0].above_m(point_m), seen_faces[1].above_m(point_m)),
                  seen_faces[2].above_m(point_m));
  }

 private:
  static float larger(float a, float b) { return std::max(a, b); }
  static Four larger(const Four& a, const Four& b) { return a.max(b); }
};

namespace {
Plane plane_through(const Vector3d& point_m, const Vector3d& normal) {
  return {normal.cast<float>(), static_cast<float>(normal.dot(point_m))};
}
}  // namespace

FilmedHand::Surroundings::Surroundings(const SeenBody& effector, const Vector3d& half_m)
    : table(plane_through(effector.camera_from_board.position_m,
                          effector.camera_from_board.orientation * Vector3d::UnitZ())),
      lamp(Shading(effector.camera_from_board).towards_lamp()) {
  const Eigen::Quaterniond camera_from_body =
      effector.camera_from_board.orientation * effector.board_from_body.orientation;
  const Vector3d center_m = effector.in_camera(Vector3d::Zero());
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    Vector3d normal = camera_from_body * Vector3d::Unit(axis);
    if (normal.dot(center_m) > 0) normal = -normal;  // the nearer of the two faces
    seen_faces[i] = plane_through(center_m + half_m[axis] * normal, normal);
    const bool looks_away = -seen_faces[i].offset_m <= 0;  // the camera is at 0
    if (looks_away) seen_faces[i] = {Vector3f::Zero(), 1};
  }
}

// For four pixels: coverage by skin, and the lamp's light on it.
struct FilmedHand::SkinInRow {
  Four coverage, lamp;
};

struct FilmedHand::SeenCone {
  Vector3f from_m, to_m;
  float from_radius_m, to_radius_m;
  Vector2f from_px, to_px;
  float from_radius_px, to_radius_px;

  PixelBox box() const;
  std::pair<int, int> columns_in_row(int y, const PixelBox& area) const;
  float distance_m() const { return from_m.norm() + to_m.norm() - from_radius_m - to_radius_m; }
  bool may_be(Side side, const Surroundings& surroundings) const;
  SkinInRow skin_at(int x, int y, Side side, const Surroundings& near) const;
  void draw(Side side, const Surroundings& near, LightPicture& picture) const;
};

PixelBox FilmedHand::SeenCone::box() const {
  const auto reach = [](const Vector2f& center, float radius) {
    const Vector2d middle = center.cast<double>(), r = Vector2d::Constant(radius + 1);
    const std::array<Vector2d, 2> corners{middle - r, middle + r};
    return pixels_around(corners);
  };
  return reach(from_px, from_radius_px).around(reach(to_px, to_radius_px));
}

// A row has much less of a slanted cone than its bounding box: the part between the lines beside
// its axis.
std::pair<int, int> FilmedHand::SeenCone::columns_in_row(int y, const PixelBox& area) const {
  const Vector2f along = to_px - from_px;
  if (std::abs(along.y()) < 1) return {area.x0, area.x1};
  const float middle = from_px.x() + (static_cast<float>(y) - from_px.y()) * along.x() / along.y();
  const float reach =
      (std::max(from_radius_px, to_radius_px) + 1) * along.norm() / std::abs(along.y());
  const auto column = [&](float x) {
    return static_cast<int>(
        std::clamp(x, static_cast<float>(area.x0), static_cast<float>(area.x1)));
  };
  return {column(middle - reach), column(middle + reach + 1)};
}

// Saves most cones one of the two drawings.
bool FilmedHand::SeenCone::may_be(Side side, const Surroundings& surroundings) const {
  const float from = surroundings.before_box_m(from_m), to = surroundings.before_box_m(to_m);
  if (side == Side::before_box) return from > -from_radius_m || to > -to_radius_m;
  return !std::ranges::any_of(surroundings.seen_faces, [&](const auto& face) {
    return face.above_m(from_m) > from_radius_m && face.above_m(to_m) > to_radius_m;
  });
}

// x from the box's back end towards the tip; the thumb on top, a right hand's fingers around the
// right side.
FilmedHand::FilmedHand(const Vector3d& box_size_m, bool left) : half_m_(box_size_m / 2) {
  const double y = half_m_.y(), z = half_m_.z();
  const double grip = std::min(0.034, 0.36 * box_size_m.x());  // extent of the fingers over the box
  const auto add = [&](const Vector3d& from, const Vector3d& to, double from_radius,
                       double to_radius) {
    const Vector3d back(-half_m_.x(), 0, 0), mirrored(1, left ? -1 : 1, 1);
    cones_.push_back({back + from.cwiseProduct(mirrored), back + to.cwiseProduct(mirrored),
                      from_radius, to_radius});
  };
  add({-0.24, 0.02, 0.05}, {-0.60, 0.05, 0.16}, 0.033, 0.045);         // the rest of the arm
  add({-0.115, 0, 0.012}, {-0.24, 0.02, 0.05}, 0.026, 0.033);          // forearm
  add({-0.026, 0.016, -0.004}, {-0.115, 0.004, 0.012}, 0.024, 0.026);  // palm
  add({-0.026, -0.014, -0.002}, {-0.115, -0.004, 0.012}, 0.024, 0.025);
  add({-0.050, 0.026, 0.010}, {-0.012, 0.6 * y, z + 0.010}, 0.015, 0.011);  // thumb
  add({-0.012, 0.6 * y, z + 0.010}, {0.8 * grip, 0.2 * y, z + 0.008}, 0.011, 0.0085);
  for (int finger = 0; finger < 4; ++finger) {
    const double down = z * (0.75 - 0.55 * finger);
    const double reach = grip * (1 - 0.1 * finger);
    const double side = -y - 0.009;
    add({-0.034, -0.030, 0.5 * down}, {0.3 * reach, side, down}, 0.011, 0.0095);
    add({0.3 * reach, side, down}, {reach, side + 0.002, down - 0.002}, 0.0095, 0.0075);
  }
}

// The arm is cut where it would come too near to the camera, beyond the picture's edge.
FilmedHand::Ball FilmedHand::far_enough(const Cone& cone, const Vector3d& from_m,
                                        const Vector3d& to_m) {
  if (to_m.z() >= nearest_m) return {to_m, cone.to_radius_m};
  const double s = (from_m.z() - nearest_m) / (from_m.z() - to_m.z());
  return {from_m + s * (to_m - from_m),
          cone.from_radius_m + s * (cone.to_radius_m - cone.from_radius_m)};
}

std::vector<FilmedHand::SeenCone> FilmedHand::seen(const SeenBody& effector,
                                                   const Lens& lens) const {
  std::vector<SeenCone> all;
  for (const Cone& cone : cones_) {
    const Vector3d from_m = effector.in_camera(cone.from_m);
    if (from_m.z() < nearest_m) continue;
    const auto [to_m, to_radius_m] = far_enough(cone, from_m, effector.in_camera(cone.to_m));
    all.push_back({from_m.cast<float>(), to_m.cast<float>(), static_cast<float>(cone.from_radius_m),
                   static_cast<float>(to_radius_m), lens.pixel(from_m).cast<float>(),
                   lens.pixel(to_m).cast<float>(),
                   static_cast<float>(cone.from_radius_m * lens.px_per_m(from_m.z())),
                   static_cast<float>(to_radius_m * lens.px_per_m(to_m.z()))});
  }
  std::ranges::stable_sort(all, std::less{}, &SeenCone::distance_m);
  return all;
}

PixelBox FilmedHand::extent(const SeenBody& effector, const Lens& lens) const {
  PixelBox box;
  for (const SeenCone& cone : seen(effector, lens)) box = box.around(cone.box());
  return box;
}

void FilmedHand::draw(Side side, const SeenBody& effector, const Lens& lens,
                      LightPicture& picture) const {
  const Surroundings surroundings(effector, half_m_);
  for (const SeenCone& cone : seen(effector, lens))
    if (cone.may_be(side, surroundings)) cone.draw(side, surroundings, picture);
}

// For each pixel: the nearest point of the axis, its position across the cone, and thus the skin's
// point and normal. Pixels without skin get no coverage.
inline FilmedHand::SkinInRow FilmedHand::SeenCone::skin_at(int x, int y, Side side,
                                                           const Surroundings& near) const {
  const Vector2f along_px = to_px - from_px;
  const Vector3f along_m = to_m - from_m;
  const Four start_x = Four(0, 1, 2, 3) + (static_cast<float>(x) - from_px.x());
  const float start_y = static_cast<float>(y) - from_px.y();
  const float per_length2 = 1 / std::max(1e-6F, along_px.squaredNorm());
  const Four s = clamped((start_x * along_px.x() + start_y * along_px.y()) * per_length2);
  const Four aside_x = start_x - s * along_px.x(), aside_y = start_y - s * along_px.y();
  const Four radius_px = from_radius_px + s * (to_radius_px - from_radius_px);
  const Four distance_px = root(aside_x.square() + aside_y.square());
  const Four within = clamped(radius_px + 0.5F - distance_px);
  if ((within <= 0).all()) return {Four::Zero(), Four::Zero()};

  const Four per_radius = radius_px.max(distance_px).inverse();
  const Four across = distance_px * per_radius;
  const FourVectors normal{aside_x * per_radius, aside_y * per_radius,
                           -root((1 - across.square()).max(0.0F))};
  const Four radius_m = from_radius_m + s * (to_radius_m - from_radius_m);
  const FourVectors point_m{from_m.x() + s * along_m.x() + radius_m * normal.x,
                            from_m.y() + s * along_m.y() + radius_m * normal.y,
                            from_m.z() + s * along_m.z() + radius_m * normal.z};
  const float px_per_m = from_radius_px / from_radius_m;
  const Four before = clamped(near.before_box_m(point_m) * px_per_m + 0.5F);
  const Four above_table = clamped(near.table.above_m(point_m) * px_per_m + 0.5F);
  return {within * above_table * (side == Side::before_box ? before : 1 - before),
          dot(near.lamp, normal).max(0.0F)};
}

// Much of the hand is hidden by its other parts.
inline bool all_covered(std::span<const Light> pixels) {
  return std::ranges::all_of(pixels, [](const Light& light) { return light[3] >= 1; });
}

void FilmedHand::SeenCone::draw(Side side, const Surroundings& near, LightPicture& picture) const {
  const PixelBox area = box().within(picture.box);
  const Light dark = solid(material::skin) * Shading::ambient;
  const Light lit = solid(material::skin) * Shading::direct;
  for (int y = area.y0; y < area.y1; ++y) {
    Light* row = picture.row(y) - picture.box.x0;
    const auto [x0, x1] = columns_in_row(y, area);
    for (int x = x0; x < x1; x += 4) {
      const int n = std::min(4, x1 - x);
      if (all_covered({row + x, static_cast<std::size_t>(n)})) continue;
      const SkinInRow skin = skin_at(x, y, side, near);
      for (int i = 0; i < n; ++i)
        if (skin.coverage[i] > 0)
          row[x + i] = over(row[x + i], skin.coverage[i] * (dark + skin.lamp[i] * lit));
    }
  }
}

}  // namespace heft
