#include "tracking/synthetic/Sensor.h"

#include <algorithm>
#include <cmath>

#include "base/Random.h"
#include "tracking/ToneCurve.h"

namespace heft {

namespace {
constexpr int curve_intervals = 4096;
constexpr std::size_t noise_length = 1 << 20;

// The Gaussian at whole pixels, of sum 1.
std::vector<float> half_kernel(double sd_px) {
  if (sd_px <= 0) return {1};
  std::vector<double> weights;
  for (int i = 0; i <= static_cast<int>(std::ceil(4 * sd_px)); ++i)
    weights.push_back(std::exp(-0.5 * i * i / (sd_px * sd_px)));
  double sum = -weights[0];
  for (const double weight : weights) sum += 2 * weight;
  std::vector<float> kernel;
  for (const double weight : weights) kernel.push_back(static_cast<float>(weight / sum));
  return kernel;
}

std::vector<float> tone_curve(bool srgb) {
  std::vector<float> curve;
  for (int i = 0; i <= curve_intervals; ++i) {
    const double light = static_cast<double>(i) / curve_intervals;
    const double stored = srgb ? stored_of_light(light).value : 255 * light;
    curve.push_back(static_cast<float>(level_steps * stored));
  }
  return curve;
}

// Nearly normal from whole numbers alone, so that every machine draws the same: the sum of eight
// uniform 16-bit numbers, cut off at 4.9 sd.
std::vector<std::int16_t> noise_row(double sd, std::uint64_t seed) {
  std::vector<std::int16_t> row(sd > 0 ? noise_length : 0);
  RandomStream draws(seed, "camera noise");
  const double scale = sd * level_steps / (65536 * std::sqrt(8.0 / 12));
  for (std::int16_t& value : row) {
    std::int64_t sum = -8 * 65535 / 2;
    for (int half = 0; half < 2; ++half) {
      const std::uint64_t bits = draws.bits();
      for (int part = 0; part < 4; ++part)
        sum += static_cast<std::int64_t>(bits >> (16 * part) & 0xffff);
    }
    value = static_cast<std::int16_t>(
        std::clamp<double>(std::floor(scale * static_cast<double>(sum) + 0.5), -32768, 32767));
  }
  return row;
}
}  // namespace

Sensor::Sensor(const Optics& optics, int width_px, int height_px, std::uint64_t seed)
    : optics_(optics),
      width_(width_px),
      height_(height_px),
      seed_(seed),
      lost_per_px2_(optics.exposure * optics.vignetting * 4 /
                    ((width_ - 1.0) * (width_ - 1) + (height_ - 1.0) * (height_ - 1))),
      kernel_(half_kernel(optics.blur_px)),
      curve_(tone_curve(optics.tone_curve)),
      noise_(noise_row(optics.noise, seed)) {}

void Sensor::blur(const LightPicture& sharp, const PixelBox& box, LightPicture& blurred) {
  const int reach = blur_reach_px();
  const PixelBox& all = sharp.box;
  const PixelBox rows = PixelBox{box.x0, box.y0 - reach, box.x1, box.y1 + reach}.within(all);
  blurred_along_rows_.reset(rows);
  for (int y = rows.y0; y < rows.y1; ++y) {
    const Light* in = sharp.row(y) - all.x0;
    Light* out = blurred_along_rows_.row(y) - rows.x0;
    for (int x = rows.x0; x < rows.x1; ++x) {
      Light sum = kernel_[0] * in[x];
      for (int i = 1; i <= reach; ++i)
        sum += kernel_[static_cast<std::size_t>(i)] *
               (in[std::max(x - i, all.x0)] + in[std::min(x + i, all.x1 - 1)]);
      out[x] = sum;
    }
  }
  blurred.reset(box);
  for (int y = box.y0; y < box.y1; ++y) {
    Light* out = blurred.row(y);
    const auto n = static_cast<std::size_t>(box.width());
    const auto row_at = [&](int row) {
      return blurred_along_rows_.row(std::clamp(row, all.y0, all.y1 - 1));
    };
    const Light* middle = row_at(y);
    for (std::size_t x = 0; x < n; ++x) out[x] = kernel_[0] * middle[x];
    for (int i = 1; i <= reach; ++i) {
      const float weight = kernel_[static_cast<std::size_t>(i)];
      const Light* above = row_at(y - i);
      const Light* below = row_at(y + i);
      for (std::size_t x = 0; x < n; ++x) out[x] += weight * (above[x] + below[x]);
    }
  }
}

// Vignetting takes light with the square of the distance from the middle.
float Sensor::gain_at(int x, int y) const {
  const double from_middle_x = x - (width_ - 1) / 2.0, from_middle_y = y - (height_ - 1) / 2.0;
  const double away2 = from_middle_x * from_middle_x + from_middle_y * from_middle_y;
  return static_cast<float>(optics_.exposure - lost_per_px2_ * away2);
}

std::int16_t Sensor::level_of(float light) const {
  const float place = std::clamp(light, 0.0F, 1.0F) * curve_intervals;
  const auto i = std::min(static_cast<std::size_t>(place), std::size_t{curve_intervals - 1});
  const float value = curve_[i] + (place - static_cast<float>(i)) * (curve_[i + 1] - curve_[i]);
  return static_cast<std::int16_t>(value + 0.5F);
}

void Sensor::expose(const LightPicture& blurred, Levels& levels) const {
  levels.resize(static_cast<std::size_t>(width_ * height_) * 3);
  const PixelBox& box = blurred.box;
  for (int y = box.y0; y < box.y1; ++y) {
    const Light* in = blurred.row(y);
    std::int16_t* out = levels.data() + (static_cast<std::ptrdiff_t>(y) * width_ + box.x0) * 3;
    for (int x = box.x0; x < box.x1; ++x, ++in, out += 3) {
      const Light light = gain_at(x, y) * *in;
      for (int channel = 0; channel < 3; ++channel) out[channel] = level_of(light[channel]);
    }
  }
}

// Every row of every picture takes its noise from a place of its own in the long row.
Image Sensor::develop(const Levels& levels, std::uint64_t number) const {
  Image image(width_, height_, 3);
  RandomStream places(seed_, "camera noise place", number);
  const std::vector<std::int16_t> none(static_cast<std::size_t>(width_), 0);
  const std::int16_t* in = levels.data();
  std::uint8_t* out = image.pixels.data();
  for (int y = 0; y < height_; ++y) {
    const std::int16_t* noise = none.data();
    if (!noise_.empty())
      noise = noise_.data() + places.below(noise_.size() - static_cast<std::size_t>(width_));
    for (int x = 0; x < width_; ++x, in += 3, out += 3) {
      for (int channel = 0; channel < 3; ++channel) {
        const int level = (in[channel] + noise[x] + level_steps / 2) >> 6;
        out[channel] = static_cast<std::uint8_t>(std::clamp(level, 0, 255));
      }
    }
  }
  return image;
}

}  // namespace heft
