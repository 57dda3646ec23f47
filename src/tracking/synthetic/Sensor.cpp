#include "tracking/synthetic/Sensor.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <span>

#include "base/Random.h"
#include "tracking/camera/ImageConversion.h"
#include "tracking/codecs/Codecs.h"

namespace heft {

namespace {
constexpr std::size_t noise_length = 1 << 20;

// Weights of fine pixels from the middle of a pixel outwards; both halves together have sum 1. A
// Gaussian, convolved with the extent of a picture's pixel.
std::vector<float> half_kernel(double sd_px) {
  const double sd = fineness * sd_px;
  const int reach = static_cast<int>(std::ceil(4 * sd));
  const auto gaussian = [&](int place) {
    return sd > 0 ? std::exp(-0.5 * place * place / (sd * sd)) : static_cast<double>(place == 0);
  };
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) sum += fineness * gaussian(i);
  std::vector<float> kernel;
  for (int i = 0; i < reach + fineness / 2; ++i) {
    double weight = 0;
    for (int part = -fineness / 2; part < fineness / 2; ++part) weight += gaussian(i - part);
    kernel.push_back(static_cast<float>(weight / sum));
  }
  return kernel;
}
static_assert(fineness % 2 == 0, "the kernel has no middle pixel");

// Nearly normal numbers by integer arithmetic, so that every machine draws the same: the sum of
// eight uniform 16-bit numbers, limited to 4.9 SD and to the range of 16 bits above the highest
// level. Each three times, for a pixel's channels.
std::vector<std::int16_t> noise_row(double sd, std::uint64_t seed) {
  constexpr double most = 208 * level_steps;
  std::vector<std::int16_t> row;
  if (sd <= 0) return row;
  row.reserve(3 * noise_length);
  RandomStream draws(seed, "camera noise");
  const double scale = sd * level_steps / (65536 * std::sqrt(8.0 / 12));
  for (std::size_t i = 0; i < noise_length; ++i) {
    std::int64_t sum = -8 * 65535 / 2;
    for (int half = 0; half < 2; ++half) {
      const std::uint64_t bits = draws.bits();
      for (int part = 0; part < 4; ++part)
        sum += static_cast<std::int64_t>(bits >> (16 * part) & 0xffff);
    }
    const double value = std::floor(scale * static_cast<double>(sum) + 0.5);
    row.insert(row.end(), 3, static_cast<std::int16_t>(std::clamp(value, -most, most)));
  }
  return row;
}

// Blurs a row of light: row_at(n) is the row n fine steps away, of which 0 and 1 are at the
// picture's middle; each place of the sums is `stride` places of the rows.
template <int stride, typename RowAt>
void blur_row(std::span<const float> kernel, std::span<Light> sums, RowAt row_at) {
  std::ranges::fill(sums, Light::Zero());
  for (std::size_t i = 0; i < kernel.size(); ++i) {
    const float weight = kernel[i];
    const Light* before = row_at(fineness / 2 - 1 - static_cast<int>(i));
    const Light* after = row_at(fineness / 2 + static_cast<int>(i));
    for (std::size_t x = 0; x < sums.size(); ++x)
      sums[x] += weight * (before[stride * x] + after[stride * x]);
  }
}

// 16 bits hold every level and its noise, so that eight are processed at a time.
void develop_row(const std::int16_t* levels, const std::int16_t* noise,
                 std::span<std::uint8_t> out) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto noisy = static_cast<std::int16_t>(levels[i] + noise[i] + level_steps / 2);
    out[i] = static_cast<std::uint8_t>(std::clamp(noisy >> 6, 0, 255));
  }
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
      curve_(UnevenLight::is_in(optics) ? Optics{} : optics),
      noise_(noise_row(optics.noise, seed)) {
  if (UnevenLight::is_in(optics)) uneven_light_.emplace(optics, width_, height_);
  for (int x = 0; x < width_; ++x) lost_by_column_.push_back(lost_light(x, width_));
}

// Vignetting grows with the squared distance from the middle: the part for the distance along one
// axis.
float Sensor::lost_light(int place, int n_places) const {
  const double from_middle = place - (n_places - 1) / 2.0;
  return static_cast<float>(lost_per_px2_ * from_middle * from_middle);
}

void Sensor::blur_along_rows(const LightPicture& sharp, const RowSpans& spans) {
  const int reach = fine_reach();
  const PixelBox &all = sharp.box, coarse = coarse_of(all);
  along_rows_.reset({coarse.x0, all.y0, coarse.x1, all.y1});
  for (int y = all.y0; y < all.y1; ++y) {
    const Span& span = spans.at(y / fineness);
    if (span.empty()) continue;
    const Light* in = sharp.row(y) - all.x0;
    padded_row_.clear();
    for (int x = fineness * span.begin - reach; x < fineness * span.end + reach; ++x)
      padded_row_.push_back(in[std::clamp(x, all.x0, all.x1 - 1)]);
    const Light* middle = padded_row_.data() + reach;
    blur_row<fineness>(kernel_, along_rows_.part(y, span),
                       [&](int steps) { return middle + steps; });
  }
}

void Sensor::blur_across_rows(int y, const Span& span) {
  const PixelBox& all = along_rows_.box;
  row_.resize(static_cast<std::size_t>(span.width()));
  blur_row<1>(kernel_, row_, [&](int steps) {
    return along_rows_.part(std::clamp(fineness * y + steps, all.y0, all.y1 - 1), span).data();
  });
}

// Converts blurred light to levels.
void Sensor::expose_row(int y, const Span& span, std::int16_t* levels) {
  const std::size_t n = row_.size();
  const float gain = static_cast<float>(optics_.exposure) - lost_light(y, height_);
  const float* lost = lost_by_column_.data() + span.begin;
  constexpr auto most = static_cast<float>(most_light);
  for (std::size_t x = 0; x < n; ++x) row_[x] = ((gain - lost[x]) * row_[x]).max(0.0F).min(most);
  const float* light = row_.data()->data();
  places_.resize(4 * n);
  for (std::size_t i = 0; i < 4 * n; ++i) places_[i] = LevelCurve::place_of(light[i]);
  for (std::size_t x = 0; x < n; ++x)
    for (std::size_t channel = 0; channel < 3; ++channel)
      levels[3 * x + channel] = curve_.at(places_[4 * x + channel]);
}

void Sensor::expose(const LightPicture& sharp, const RowSpans& spans, Levels& levels) {
  levels.resize(static_cast<std::size_t>(place_of(0, height_)));
  blur_along_rows(sharp, spans.grown(0, reach_px()));
  for (int y = spans.box().y0; y < spans.box().y1; ++y) {
    const Span& span = spans.at(y);
    if (span.empty()) continue;
    blur_across_rows(y, span);
    expose_row(y, span, levels.data() + place_of(span.begin, y));
  }
}

// Each row of each picture takes noise from a separate place in the long row.
Image Sensor::noisy(const Levels& levels, std::uint64_t number) const {
  Image image(width_, height_, 3);
  RandomStream places(seed_, "camera noise place", number);
  const std::size_t n = image.row_bytes();
  const std::vector<std::int16_t> none(n, 0);
  for (int y = 0; y < height_; ++y) {
    const std::int16_t* noise = none.data();
    if (!noise_.empty())
      noise = noise_.data() + 3 * places.below(noise_length - static_cast<std::size_t>(width_));
    const auto start = static_cast<std::size_t>(place_of(0, y));
    develop_row(levels.data() + start, noise, {image.pixels.data() + start, n});
  }
  return image;
}

Image Sensor::develop(const Levels& levels, std::uint64_t number,
                      const std::optional<Eigen::Vector2d>& effector_px, double t_s) const {
  if (!uneven_light_) return processed(noisy(levels, number), optics_);
  return processed(noisy(uneven_light_->on(levels, effector_px, t_s), number), optics_);
}

namespace {
// Bayer mosaic of blue, green over green, red: each pixel keeps one color.
cv::Mat through_mosaic(const cv::Mat& picture) {
  cv::Mat one_color(picture.size(), CV_8UC1), colors;
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      one_color.at<std::uint8_t>(y, x) = picture.at<cv::Vec3b>(y, x)[x % 2 + y % 2];
  cv::cvtColor(one_color, colors, cv::COLOR_BayerBGGR2BGR);
  return colors;
}

cv::Mat sharpened(const cv::Mat& picture, double strength) {
  constexpr double sd_px = 1;
  cv::Mat smooth, sharp;
  cv::GaussianBlur(picture, smooth, {7, 7}, sd_px);
  cv::addWeighted(picture, 1 + strength, smooth, -strength, 0, sharp);
  return sharp;
}

cv::Mat through_jpeg(const cv::Mat& picture, int quality) {
  cv::Mat back;
  codecs().through_jpeg(picture, quality, back);
  return back;
}
}  // namespace

Image processed(Image picture, const Optics& optics) {
  if (!optics.mosaic && !(optics.sharpening > 0) && optics.jpeg_quality == 0) return picture;
  cv::Mat now = mat_of(picture);
  if (optics.mosaic) now = through_mosaic(now);
  if (optics.sharpening > 0) now = sharpened(now, optics.sharpening);
  if (optics.jpeg_quality > 0) now = through_jpeg(now, optics.jpeg_quality);
  return image_from(now);
}

}  // namespace heft
