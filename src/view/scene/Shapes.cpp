#include "view/scene/Shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace heft {

namespace {
using Eigen::Vector3d;

constexpr double edge_line_m = 0.0009;
constexpr double ambient = 0.62;  // light on a face that the lamp does not reach

// Direction to the lamp: above the table, behind the participant's left shoulder.
Vector3d to_lamp() {
  return Vector3d(-0.40, -0.48, 0.78).normalized();
}

double light_on(const Vector3d& normal) {
  return ambient + (1 - ambient) * std::max(0.0, normal.dot(to_lamp())) / to_lamp().z();
}

Surface lit(const std::array<int, 3>& bgr, double light, const BoxLook& look) {
  Surface surface{{}, look.opacity, look.object};
  for (std::size_t c = 0; c < 3; ++c)
    surface.bgr[c] = static_cast<std::uint8_t>(std::clamp(std::lround(bgr[c] * light), 0l, 255l));
  return surface;
}

// One number for the whole box, so that neighboring faces are divided alike.
int pieces_of_box(const Viewpoint& viewpoint, const Pose& board_from_box, const Vector3d& half_m) {
  int most = 1;
  for (int k = 0; k < 3; ++k) {
    for (const auto& [s, t] : {std::pair{-1, -1}, {-1, 1}, {1, -1}, {1, 1}}) {
      Vector3d from_m = half_m;
      from_m[(k + 1) % 3] *= s;
      from_m[(k + 2) % 3] *= t;
      Vector3d to_m = from_m;
      to_m[k] *= -1;
      most = std::max(most, viewpoint.pieces(board_from_box * from_m, board_from_box * to_m));
    }
  }
  return most;
}

// A flat parallelogram with a border along its sides: a face of a box, a sheet of paper.
struct BorderedQuad {
  Vector3d corner_m, along_m, across_m;  // board frame: a corner, two sides from it
  double border_m = 0;                   // width of the line
  int pieces = 1;                        // in each direction, to follow the lens distortion
};

constexpr int most_cuts = 11;  // both sides, both borders, and up to eight pieces between them

// Fractions at which a side is divided.
struct Cuts {
  std::array<double, most_cuts> at{};
  int n = 0;

  void add(double fraction) { at[static_cast<std::size_t>(n++)] = fraction; }
};

Cuts cuts(double side_m, double border_m, int pieces) {
  const double border = std::min(border_m / side_m, 0.25);
  Cuts cuts;
  cuts.add(0);
  for (int i = 0; i <= pieces; ++i) cuts.add(border + (1 - 2 * border) * i / pieces);
  cuts.add(1);
  return cuts;
}

void fill_quad(Rasterizer& rasterizer, const Viewpoint& viewpoint,
               const std::array<Corner, 4>& quad, std::uint8_t surface) {
  const auto raster = [](const Corner& corner) {
    return RasterCorner{corner.pixel, 1 / corner.camera_m.z()};
  };
  viewpoint.triangles(quad, [&](const Corner& a, const Corner& b, const Corner& c) {
    rasterizer.fill({raster(a), raster(b), raster(c)}, surface);
  });
}

void draw_quad(Rasterizer& rasterizer, const Viewpoint& viewpoint, const BorderedQuad& quad,
               std::uint8_t inside, std::uint8_t border) {
  const Cuts along = cuts(quad.along_m.norm(), quad.border_m, quad.pieces);
  const Cuts across = cuts(quad.across_m.norm(), quad.border_m, quad.pieces);
  using Row = std::array<Corner, most_cuts>;
  const auto row_at = [&](int j) {
    Row row;
    const Vector3d start_m = quad.corner_m + across.at[static_cast<std::size_t>(j)] * quad.across_m;
    for (std::size_t i = 0; i < static_cast<std::size_t>(along.n); ++i)
      row[i] = viewpoint.corner(start_m + along.at[i] * quad.along_m);
    return row;
  };
  Row lower = row_at(0);
  for (int j = 1; j < across.n; ++j) {
    const Row upper = row_at(j);
    for (std::size_t i = 1; i < static_cast<std::size_t>(along.n); ++i) {
      const bool outer = j == 1 || j == across.n - 1 || i == 1 || i + 1 == std::size_t(along.n);
      fill_quad(rasterizer, viewpoint, {lower[i - 1], lower[i], upper[i], upper[i - 1]},
                outer ? border : inside);
    }
    lower = upper;
  }
}
}  // namespace

void draw_box(Rasterizer& rasterizer, const Viewpoint& viewpoint, const Pose& board_from_box,
              const Vector3d& size_m, const BoxLook& look) {
  const Eigen::Matrix3d axes = board_from_box.orientation.toRotationMatrix();
  const int pieces = pieces_of_box(viewpoint, board_from_box, size_m / 2);
  for (int face = 0; face < 6; ++face) {
    const int k = face / 2, i = (k + 1) % 3, j = (k + 2) % 3;
    const Vector3d normal = (face % 2 ? 1 : -1) * axes.col(k);
    const Vector3d center_m = board_from_box.position_m + normal * size_m[k] / 2;
    if (!viewpoint.faces_camera(center_m, normal)) continue;
    const Vector3d along_m = axes.col(i) * size_m[i], across_m = axes.col(j) * size_m[j];
    const double light = light_on(normal);
    draw_quad(rasterizer, viewpoint,
              {center_m - (along_m + across_m) / 2, along_m, across_m, edge_line_m, pieces},
              rasterizer.add_surface(lit(look.face_bgr, light, look)),
              rasterizer.add_surface(lit(look.edge_bgr, light, look)));
  }
}

void draw_sheet(Rasterizer& rasterizer, const Viewpoint& viewpoint, const Eigen::Vector2d& size_m,
                double border_m, std::uint8_t inside, std::uint8_t border) {
  const Vector3d along_m(size_m.x(), 0, 0), across_m(0, size_m.y(), 0);
  const Vector3d corner_m = -(along_m + across_m) / 2;
  const int pieces = std::max(viewpoint.pieces(corner_m, corner_m + along_m),
                              viewpoint.pieces(corner_m, corner_m + across_m));
  draw_quad(rasterizer, viewpoint, {corner_m, along_m, across_m, border_m, pieces}, inside, border);
}

}  // namespace heft
