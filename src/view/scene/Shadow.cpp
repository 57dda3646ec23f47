// draw_shadow of SceneDrawing.h. A shadow is a flat polygon of full darkness on the table, with
// rings around it that fade out.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/math/Geometry.h"
#include "view/scene/SceneDrawing.h"

namespace heft {

namespace {
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double lean = 0.22;             // of the shadow per meter of height, away from the lamp
constexpr double contact_blur_m = 0.009;  // width of the fading rim below a standing box
constexpr double blur_per_height = 0.6;   // growth of the rim as the box is lifted
constexpr double fading_height_m = 0.03;  // a box at this height has a shadow half as dark
constexpr std::array rim_darkness{1.0, 0.52, 0.17, 0.0};  // from the polygon outward

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

std::array<Vector3d, 8> corners_of(const Pose& board_from_box, const Vector3d& size_m) {
  std::array<Vector3d, 8> corners_m;
  for (unsigned i = 0; i < 8; ++i) {
    const Vector3d sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    corners_m[i] = board_from_box * Vector3d(sign.cwiseProduct(size_m) / 2);
  }
  return corners_m;
}

using Footprint = Polygon<Vector2d, 8>;  // convex, on the table, counterclockwise

// The convex hull by gift wrapping, which suffices for eight points.
Footprint hull_of(const std::array<Vector2d, 8>& points_m) {
  const auto first = std::ranges::min_element(points_m, [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  Footprint hull;
  const Vector2d* at = &*first;
  do {
    hull.add(*at);
    const Vector2d* next = nullptr;
    for (const Vector2d& candidate : points_m) {
      if ((candidate - *at).norm() < 1e-6) continue;
      const double turn = next ? cross(*next - *at, candidate - *at) : -1;
      if (turn < -1e-12 ||
          (std::abs(turn) <= 1e-12 && (candidate - *at).norm() > (*next - *at).norm()))
        next = &candidate;
    }
    at = next;
  } while (at && (*at - *first).norm() > 1e-6 && hull.size() < 8);
  return hull;
}

Footprint footprint_of(const std::array<Vector3d, 8>& corners_m) {
  std::array<Vector2d, 8> points_m;
  for (std::size_t i = 0; i < 8; ++i)
    points_m[i] =
        corners_m[i].head<2>() + lean * std::max(0.0, corners_m[i].z()) * Vector2d(0.64, 0.77);
  return hull_of(points_m);
}

// A corner moved outward by a distance is rounded by three directions.
struct RimCorner {
  Vector2d start_m, outward;
};
using Outline = Polygon<RimCorner, 24>;

Outline outline_of(const Footprint& footprint_m) {
  const std::size_t n = footprint_m.size();
  const auto outward = [&](std::size_t i) {
    const Vector2d side = footprint_m[(i + 1) % n] - footprint_m[i % n];
    return Vector2d(side.y(), -side.x()).normalized();
  };
  Outline outline;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d before = outward(i + n - 1), after = outward(i);
    for (const Vector2d& direction : {before, Vector2d((before + after).normalized()), after})
      outline.add({footprint_m[i], direction});
  }
  return outline;
}

void shade_polygon(Rasterizer& rasterizer, const Viewpoint& viewpoint,
                   std::span<const Corner> polygon) {
  viewpoint.triangles(polygon, [&](const Corner& a, const Corner& b, const Corner& c) {
    rasterizer.shade({RasterCorner{a.pixel, a.darkness}, RasterCorner{b.pixel, b.darkness},
                      RasterCorner{c.pixel, c.darkness}});
  });
}

using Ring = Polygon<Corner, 24>;

Ring ring_at(const Viewpoint& viewpoint, const Outline& outline, double distance_m,
             double darkness) {
  Ring ring;
  for (const RimCorner& corner : outline) {
    const Vector2d place_m = corner.start_m + distance_m * corner.outward;
    ring.add(viewpoint.corner({place_m.x(), place_m.y(), 0}, darkness));
  }
  return ring;
}
}  // namespace

void draw_shadow(Rasterizer& rasterizer, const Viewpoint& viewpoint, const Pose& board_from_box,
                 const Vector3d& size_m, double strength) {
  const auto corners_m = corners_of(board_from_box, size_m);
  const auto z_m = [](const Vector3d& corner_m) { return corner_m.z(); };
  if (z_m(std::ranges::max(corners_m, {}, z_m)) < 0) return;  // completely below the table
  const double height_m = std::max(0.0, z_m(std::ranges::min(corners_m, {}, z_m)));
  const Footprint footprint_m = footprint_of(corners_m);
  if (footprint_m.size() < 3) return;
  const Outline outline = outline_of(footprint_m);
  const std::size_t n = outline.size();
  const double blur_m = contact_blur_m + blur_per_height * height_m;
  const double darkness = strength * fading_height_m / (fading_height_m + height_m);
  Ring inner = ring_at(viewpoint, outline, 0, darkness * rim_darkness[0]);
  for (std::size_t i = 2; i < n; ++i)
    shade_polygon(rasterizer, viewpoint, std::array{inner[0], inner[i - 1], inner[i]});
  for (std::size_t k = 1; k < rim_darkness.size(); ++k) {
    const double outward = static_cast<double>(k) / (rim_darkness.size() - 1);
    const Ring outer = ring_at(viewpoint, outline, outward * blur_m, darkness * rim_darkness[k]);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t next = (i + 1) % n;
      shade_polygon(rasterizer, viewpoint,
                    std::array{inner[i], inner[next], outer[next], outer[i]});
    }
    inner = outer;
  }
}

}  // namespace heft
