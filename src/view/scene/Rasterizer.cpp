#include "view/scene/Rasterizer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "base/Error.h"

namespace heft {

namespace {
using Eigen::Vector2d;

// A value that varies linearly over a triangle.
struct Ramp {
  double at_origin = 0, per_column = 0, per_row = 0;

  double at(int x, int y) const { return at_origin + per_column * x + per_row * y; }
};

std::optional<Ramp> ramp_over(const RasterTriangle& triangle,
                              const std::array<Vector2d, 3>& corners, double scale) {
  const Vector2d a = corners[1] - corners[0], b = corners[2] - corners[0];
  const double twice_area = a.x() * b.y() - a.y() * b.x();
  if (!(std::abs(twice_area) > 1e-9)) return {};  // seen edge on, or not a number
  const double da = scale * (triangle[1].value - triangle[0].value) / twice_area;
  const double db = scale * (triangle[2].value - triangle[0].value) / twice_area;
  Ramp ramp;
  ramp.per_column = da * b.y() - db * a.y();
  ramp.per_row = db * a.x() - da * b.x();
  ramp.at_origin =
      scale * triangle[0].value - ramp.per_column * corners[0].x() - ramp.per_row * corners[0].y();
  return ramp;
}

// Samples are a quarter of a pixel from the pixel's center in x and y.
std::array<Vector2d, 3> in_samples(const RasterTriangle& triangle) {
  std::array<Vector2d, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = 2 * triangle[i].pixel + Vector2d::Constant(0.5);
  return corners;
}

// Samples count nearness in steps of 256, with the surface number in the lower bits. The range
// starts at 1 / max_nearness = 1.6 cm from the lens; at half a meter a step is 0.002 mm.
constexpr double max_nearness = 64, nearness_scale = 2147483648.0 / max_nearness;
constexpr std::uint32_t surface_bits = 0xff;

// Unsigned numbers wrap around: a sum within range is right, whatever its terms.
std::uint32_t wrapped(double value) {
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::clamp(value, -9e18, 9e18)));
}

using Four = std::array<std::int32_t, 4>;

// Row functions take everything by value, so that the compiler knows that the written pixels alias
// none of it, and vectorizes them.
void draw_row(std::span<std::int32_t> samples, std::uint32_t near, std::uint32_t slope,
              std::uint32_t surface) {
  for (std::int32_t& sample : samples) {
    sample = std::max(sample, static_cast<std::int32_t>((near & ~surface_bits) | surface));
    near += slope;
  }
}

constexpr double darkness_scale = 255 * 65536.0;

// Multiplies the remaining light by the added filter.
void dim_row(std::span<std::uint8_t> darkness, std::uint32_t added, std::uint32_t slope) {
  added += 32768;  // to round
  for (std::uint8_t& dark : darkness) {
    const std::uint32_t more = (added >> 16) & 0xff;
    dark = static_cast<std::uint8_t>(dark + (((255u - dark) * more + 128) >> 8));
    added += slope;
  }
}

// Shadows are few and their rows long: most of a row is skipped eight pixels at a time.
bool eight_are_light(const std::uint8_t* darkness) {
  std::uint64_t eight;
  std::memcpy(&eight, darkness, sizeof eight);
  return eight == 0;
}

void dim_pixel(std::uint8_t* bgr, int darkness) {
  const int light = 256 - darkness;
  for (int c = 0; c < 3; ++c) bgr[c] = static_cast<std::uint8_t>((bgr[c] * light + 128) >> 8);
}

Four four_of(const std::int32_t* upper, const std::int32_t* lower) {
  return {upper[0], upper[1], lower[0], lower[1]};
}

bool nothing(const Four& four) {
  return (four[0] | four[1] | four[2] | four[3]) == 0;
}

std::size_t surface_of(std::int32_t sample) {
  return static_cast<std::uint32_t>(sample) & surface_bits;
}

// Compares surfaces, because the nearnesses of a pixel's samples differ.
bool alike(const Four& four) {
  return surface_of((four[0] ^ four[1]) | (four[0] ^ four[2]) | (four[0] ^ four[3])) == 0;
}

bool all_in_front(const Four& glass, const Four& solid) {
  return glass[0] > solid[0] && glass[1] > solid[1] && glass[2] > solid[2] && glass[3] > solid[3];
}

// Also for points far outside the frame, and for values that are not numbers.
int grid_line(double value, int n_lines) {
  return value >= 0 ? static_cast<int>(std::min(value, static_cast<double>(n_lines))) : 0;
}
}  // namespace

Rasterizer::Rasterizer(int width_px, int height_px)
    : paints_(1),
      solid_(2 * width_px, 2 * height_px),
      glass_(2 * width_px, 2 * height_px),
      darkness_(width_px, height_px) {
  paints_.reserve(surface_bits + 1);
}

void Rasterizer::clear() {
  solid_.clear();
  glass_.clear();
  darkness_.clear();
  paints_.resize(1);
}

std::uint8_t Rasterizer::add_surface(const Surface& surface) {
  if (paints_.size() > surface_bits)
    throw Error("a frame can have at most 255 surfaces (about 40 boxes); show fewer objects");
  paints_.push_back(
      {surface.bgr, static_cast<int>(std::lround(256 * surface.opacity)), surface.object});
  return static_cast<std::uint8_t>(paints_.size() - 1);
}

void Rasterizer::fill(const RasterTriangle& triangle, std::uint8_t surface) {
  const auto corners = in_samples(triangle);
  const auto ramp = ramp_over(triangle, corners, nearness_scale);
  if (!ramp) return;
  Layer<Sample>& layer = paints_[surface].opacity < 256 ? glass_ : solid_;
  scan_points(corners, layer.n_columns(), layer.n_rows(), [&](int y, int begin, int end) {
    draw_row({layer.write(y, begin, end), static_cast<std::size_t>(end - begin)},
             wrapped(ramp->at(begin, y)), wrapped(ramp->per_column), surface);
  });
}

void Rasterizer::shade(const RasterTriangle& triangle) {
  const std::array corners{triangle[0].pixel, triangle[1].pixel, triangle[2].pixel};
  const auto ramp = ramp_over(triangle, corners, darkness_scale);
  if (!ramp) return;
  scan_points(corners, darkness_.n_columns(), darkness_.n_rows(), [&](int y, int begin, int end) {
    dim_row({darkness_.write(y, begin, end), static_cast<std::size_t>(end - begin)},
            wrapped(ramp->at(begin, y)), wrapped(ramp->per_column));
  });
}

std::array<int, 3> Rasterizer::color(Sample solid, Sample glass, const std::uint8_t* below) const {
  const std::uint8_t* bgr = solid ? paints_[surface_of(solid)].bgr.data() : below;
  if (glass <= solid) return {bgr[0], bgr[1], bgr[2]};
  const Paint& over = paints_[surface_of(glass)];
  std::array<int, 3> mixed;
  for (std::size_t c = 0; c < 3; ++c)
    mixed[c] = bgr[c] + (((over.bgr[c] - bgr[c]) * over.opacity + 128) >> 8);
  return mixed;
}

void Rasterizer::paint_pixel(const Four& solid, const Four& glass, std::uint8_t* bgr) const {
  if (alike(solid) && (nothing(glass) || (alike(glass) && all_in_front(glass, solid)))) {
    const auto one = color(solid[0], glass[0], bgr);
    for (std::size_t c = 0; c < 3; ++c) bgr[c] = static_cast<std::uint8_t>(one[c]);
    return;
  }
  std::array<int, 3> sum{2, 2, 2};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto one = color(solid[i], glass[i], bgr);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += one[c];
  }
  for (std::size_t c = 0; c < 3; ++c) bgr[c] = static_cast<std::uint8_t>(sum[c] / 4);
}

void Rasterizer::shade_row(int y, std::uint8_t* bgr) const {
  const std::uint8_t* darkness = darkness_.row(y);
  const auto [begin, end] = darkness_.touched(y);
  for (int x = begin; x < end; ++x) {
    while (x + 8 <= end && eight_are_light(darkness + x)) x += 8;
    if (x < end && darkness[x]) dim_pixel(bgr + 3 * x, darkness[x]);
  }
}

void Rasterizer::paint_row(int y, std::uint8_t* bgr) const {
  const Sample *solid = solid_.row(2 * y), *solid_below = solid_.row(2 * y + 1);
  const Sample *glass = glass_.row(2 * y), *glass_below = glass_.row(2 * y + 1);
  const auto [begin, end] = columns_in(y);
  for (int x = begin; x < end; ++x) {
    const Four solids = four_of(solid + 2 * x, solid_below + 2 * x);
    const Four glasses = four_of(glass + 2 * x, glass_below + 2 * x);
    const bool clear = nothing(glasses);
    if (clear && alike(solids)) {  // most pixels: all background, or inside a face
      if (solids[0]) std::memcpy(bgr + 3 * x, paints_[surface_of(solids[0])].bgr.data(), 3);
    } else {
      paint_pixel(solids, glasses, bgr + 3 * x);
    }
  }
}

// The pixels of a row with a surface on any of their samples.
Span Rasterizer::columns_in(int y) const {
  Span samples;
  for (const Layer<Sample>* layer : {&solid_, &glass_})
    samples = samples.around(layer->touched(2 * y)).around(layer->touched(2 * y + 1));
  return {samples.begin / 2, (samples.end + 1) / 2};
}

// Restores the frame's own pixels, with translucent surfaces over them.
void Rasterizer::put_in_front(int y, const std::uint8_t* opacity, const std::uint8_t* below,
                              std::uint8_t* bgr) const {
  const Sample *glass = glass_.row(2 * y), *glass_below = glass_.row(2 * y + 1);
  for (int x = 0; x < darkness_.n_columns(); ++x) {
    if (!opacity[x]) continue;
    std::array<std::uint8_t, 3> own{below[3 * x], below[3 * x + 1], below[3 * x + 2]};
    const Four glasses = four_of(glass + 2 * x, glass_below + 2 * x);
    if (!nothing(glasses)) paint_pixel({}, glasses, own.data());
    for (std::size_t c = 0; c < 3; ++c) {
      std::uint8_t& painted = bgr[3 * static_cast<std::size_t>(x) + c];
      painted =
          static_cast<std::uint8_t>((painted * (255 - opacity[x]) + own[c] * opacity[x]) / 255);
    }
  }
}

void Rasterizer::paint(Image& frame, const Image* in_front) const {
  std::vector<std::uint8_t> below;
  for (int y = 0; y < darkness_.n_rows(); ++y) {
    const auto row = static_cast<std::size_t>(y);
    std::uint8_t* bgr = frame.pixels.data() + row * frame.row_bytes();
    if (in_front) below.assign(bgr, bgr + frame.row_bytes());
    shade_row(y, bgr);
    paint_row(y, bgr);
    if (in_front)
      put_in_front(y, in_front->pixels.data() + row * in_front->row_bytes(), below.data(), bgr);
  }
}

std::optional<int> Rasterizer::find_object(const Vector2d& pixel, double reach_px) const {
  const Vector2d center = 2 * pixel + Vector2d::Constant(0.5);
  const double reach = 2 * reach_px;
  double nearest = reach * reach;
  int found = 0;
  for (int y = grid_line(center.y() - reach, solid_.n_rows());
       y < grid_line(center.y() + reach + 1, solid_.n_rows()); ++y) {
    for (int x = grid_line(center.x() - reach, solid_.n_columns());
         x < grid_line(center.x() + reach + 1, solid_.n_columns()); ++x) {
      const int object = paints_[surface_of(solid_.row(y)[x])].object;
      const double distance = (Vector2d(x, y) - center).squaredNorm();
      if (!object || distance > nearest) continue;
      nearest = distance;
      found = object;
    }
  }
  return found ? std::optional(found) : std::nullopt;
}

}  // namespace heft
