#include "view/Patch.h"

#include <algorithm>
#include <array>

namespace heft {

namespace {
constexpr int most_cuts = 11;  // both sides, both borders, and up to eight pieces between them

// Where a side is divided, as shares of it.
struct Cuts {
  std::array<double, most_cuts> at{};
  int n = 0;

  void add(double share) { at[static_cast<std::size_t>(n++)] = share; }
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
}  // namespace

void draw_patch(Rasterizer& rasterizer, const Viewpoint& viewpoint, const Patch& patch,
                std::uint8_t inside, std::uint8_t border) {
  const Cuts along = cuts(patch.along_m.norm(), patch.border_m, patch.pieces);
  const Cuts across = cuts(patch.across_m.norm(), patch.border_m, patch.pieces);
  using Row = std::array<Corner, most_cuts>;
  const auto row_at = [&](int j) {
    Row row;
    const Eigen::Vector3d start_m =
        patch.corner_m + across.at[static_cast<std::size_t>(j)] * patch.across_m;
    for (std::size_t i = 0; i < static_cast<std::size_t>(along.n); ++i)
      row[i] = viewpoint.corner(start_m + along.at[i] * patch.along_m);
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

}  // namespace heft
