#include "bench/tracking/PictureFaults.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/Random.h"
#include "tracking/ImageConversion.h"
#include "tracking/ToneCurve.h"

namespace heft {

namespace {
constexpr std::size_t noise_length = 1 << 18;

double srgb(double light) {
  return stored_of_light(std::clamp(light, 0.0, 1.0)).value / 255;
}

// Stored values, 0...255, before they are rounded.
struct Plane {
  int width, height;
  std::vector<float> values;

  float& at(int x, int y) {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  float near(int x, int y) const {
    const auto column = static_cast<std::size_t>(std::clamp(x, 0, width - 1));
    const auto row = static_cast<std::size_t>(std::clamp(y, 0, height - 1));
    return values[row * static_cast<std::size_t>(width) + column];
  }
};

// A penumbra of two pixels, at a slant to the tags.
double shadowed(const PictureFaults& faults, const Eigen::Vector2d& off_px) {
  const double lit = std::clamp(0.5 + off_px.dot(Eigen::Vector2d(0.8, 0.6)) / 2, 0.0, 1.0);
  return faults.shadow + (1 - faults.shadow) * lit;
}

Plane exposed(const Image& clean, const PictureFaults& faults, const Eigen::Vector2d& at_px) {
  const Image gray = gray_of(clean);
  std::array<double, 256> light{};
  for (std::size_t v = 0; v < light.size(); ++v) light[v] = light_of_stored(static_cast<double>(v));
  constexpr int steps = 4096;
  std::vector<float> curve;
  for (int i = 0; i <= steps; ++i) {
    const double l = std::pow(static_cast<double>(i) / steps, 2);
    curve.push_back(static_cast<float>(255 * (faults.tone ? faults.tone(l) : srgb(l))));
  }
  const double glare_px = 40 * gray.width / 640.0;
  Plane plane{gray.width, gray.height, {}};
  plane.values.reserve(gray.pixels.size());
  for (int y = 0; y < gray.height; ++y)
    for (int x = 0; x < gray.width; ++x) {
      const Eigen::Vector2d off_px = Eigen::Vector2d(x, y) - at_px;
      double l = light[gray.pixels[static_cast<std::size_t>(y) * gray.row_bytes() +
                                   static_cast<std::size_t>(x)]];
      if (faults.shadow < 1) l *= shadowed(faults, off_px);
      if (faults.glare > 0)
        l += faults.glare * std::exp2(-off_px.squaredNorm() / (glare_px * glare_px));
      const double place = steps * std::sqrt(std::clamp(l, 0.0, 1.0));
      const auto below = std::min(static_cast<std::size_t>(place), curve.size() - 2);
      const auto between = static_cast<float>(place - static_cast<double>(below));
      plane.values.push_back((1 - between) * curve[below] + between * curve[below + 1]);
    }
  return plane;
}

void add_noise(Plane& plane, double sd, std::uint64_t number) {
  static const std::vector<float> draws = [] {
    std::vector<float> all(noise_length);
    RandomStream random(1, "noise of other cameras");
    for (float& one : all) one = static_cast<float>(random.normal());
    return all;
  }();
  RandomStream places(number, "its place");
  for (int y = 0; y < plane.height; ++y) {
    std::size_t from = places.below(noise_length - static_cast<std::size_t>(plane.width));
    for (int x = 0; x < plane.width; ++x) plane.at(x, y) += static_cast<float>(sd) * draws[from++];
  }
}

// One color of the mosaic (blue, green over green, red), the others' pixels interpolated linearly.
float demosaiced(const Plane& raw, int x, int y, int color) {
  const auto has = [&](int i, int j) { return (x + i) % 2 + (y + j) % 2 == color; };
  if (has(0, 0)) return raw.near(x, y);
  float sum = 0, n = 0;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) {
      const bool corner = i != 0 && j != 0;
      if (x + i < 0 || y + j < 0 || !has(i, j) || (color == 1 && corner)) continue;
      sum += raw.near(x + i, y + j);
      ++n;
    }
  return sum / n;
}

// Gray of the three.
void pass_mosaic(Plane& plane) {
  const Plane raw = plane;
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x)
      plane.at(x, y) = 0.114F * demosaiced(raw, x, y, 0) + 0.587F * demosaiced(raw, x, y, 1) +
                       0.299F * demosaiced(raw, x, y, 2);
}

void sharpen(Plane& plane, double strength) {
  std::array<float, 7> kernel{};
  float sum = 0;
  for (int i = -3; i <= 3; ++i)
    sum += kernel[static_cast<std::size_t>(i + 3)] = std::exp(-0.5F * static_cast<float>(i * i));
  Plane smooth = plane, across = plane;
  for (const bool by_rows : {true, false}) {
    const Plane& from = by_rows ? plane : across;
    Plane& to = by_rows ? across : smooth;
    for (int y = 0; y < plane.height; ++y)
      for (int x = 0; x < plane.width; ++x) {
        float value = 0;
        for (int i = -3; i <= 3; ++i)
          value += kernel[static_cast<std::size_t>(i + 3)] / sum *
                   from.near(by_rows ? x + i : x, by_rows ? y : y + i);
        to.at(x, y) = value;
      }
  }
  for (std::size_t i = 0; i < plane.values.size(); ++i)
    plane.values[i] += static_cast<float>(strength) * (plane.values[i] - smooth.values[i]);
}

// The luminance table of ITU-T T.81, annex K.
constexpr std::array<int, 64> quantizers{
    16, 11, 10, 16, 24,  40,  51,  61,  12, 12, 14, 19, 26,  58,  60,  55,
    14, 13, 16, 24, 40,  57,  69,  56,  14, 17, 22, 29, 51,  87,  80,  62,
    18, 22, 37, 56, 68,  109, 103, 77,  24, 35, 55, 64, 81,  104, 113, 92,
    49, 64, 78, 87, 103, 121, 120, 101, 72, 92, 95, 98, 112, 100, 103, 99};

using Block = Eigen::Matrix<float, 8, 8>;

Block cosines() {
  Block all;
  for (int k = 0; k < 8; ++k)
    for (int i = 0; i < 8; ++i)
      all(k, i) = static_cast<float>((k == 0 ? std::sqrt(0.125) : 0.5) *
                                     std::cos((2 * i + 1) * k * M_PI / 16));
  return all;
}

void compress(Plane& plane, int quality) {
  const Block cosine = cosines();
  const int scale = quality < 50 ? 5000 / quality : 200 - 2 * quality;
  Block steps;
  for (int i = 0; i < 64; ++i)
    steps(i / 8, i % 8) = static_cast<float>(
        std::clamp((quantizers[static_cast<std::size_t>(i)] * scale + 50) / 100, 1, 255));
  for (int y0 = 0; y0 < plane.height; y0 += 8)
    for (int x0 = 0; x0 < plane.width; x0 += 8) {
      Block block;
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
          block(y, x) = std::clamp(std::round(plane.near(x0 + x, y0 + y)), 0.0F, 255.0F) - 128;
      const Block waves = cosine * block * cosine.transpose();
      const Block kept = (waves.array() / steps.array()).round() * steps.array();
      block = cosine.transpose() * kept * cosine;
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
          if (x0 + x < plane.width && y0 + y < plane.height)
            plane.at(x0 + x, y0 + y) = block(y, x) + 128;
    }
}
}  // namespace

double film_tone(double light, double share) {
  const double x = 0.8 * light;
  const double film = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  return (1 - share) * srgb(light) + share * srgb(film);
}

double s_curve_tone(double light, double strength) {
  const double v = srgb(light);
  return (1 - strength) * v + strength * v * v * (3 - 2 * v);
}

Image with_faults(const Image& clean, const PictureFaults& faults, const Eigen::Vector2d& at_px,
                  std::uint64_t number) {
  Plane plane = exposed(clean, faults, at_px);
  if (faults.noise > 0) add_noise(plane, faults.noise, number);
  if (faults.mosaic) pass_mosaic(plane);
  if (faults.sharpening > 0) sharpen(plane, faults.sharpening);
  if (faults.jpeg_quality > 0) compress(plane, faults.jpeg_quality);
  Image image(plane.width, plane.height, 1);
  std::ranges::transform(plane.values, image.pixels.begin(), [](float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 255.0F)));
  });
  return image;
}

}  // namespace heft
