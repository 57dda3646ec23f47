#include "tracking/detection/TemporalMix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/math/Quantiles.h"

namespace heft {

namespace {
constexpr std::size_t n_needed = 4;  // pictures, for three differences
// A camera's first picture is not denoised. While its noise falls, cov(d(n - 1), d(n - 2)) is near
// zero.
constexpr int pictures_of_start = 8;
constexpr int block_px = 24, stride_px = 3, apart_px = 2;
constexpr std::uint8_t black = 2, white = 253;  // beyond, noise is clipped
constexpr int most_step = 24;                   // gray levels between the two pixels of a place
constexpr double least_noise = 0.7;             // below, noise is mostly rounding
constexpr double most_variance = 1.6;           // of a block, relative to the median's: it is still
constexpr int least_places = 20;                // in a block
constexpr std::size_t least_blocks = 30;
constexpr double least_share = 0.06, most_share = 0.9;
constexpr double rounding_variance = 2 / 12.0;  // of two pixels, between d(n - 1) and d(n - 2)
constexpr double memory = 0.95;                 // of the sums, per picture
constexpr double regular = 1.5;  // a longer gap, relative to the usual one, has lost pictures

// Products of differences at places where two nearby pixels have about the same light: the
// difference of both is noise, whatever the camera's gain does.
struct NoiseSums {
  double squares = 0, next = 0, after_next = 0;
  int n = 0;

  double variance() const { return squares / n; }
};

NoiseSums noise_of_block(const std::array<const Image*, n_needed>& pictures, int left, int top) {
  NoiseSums sums;
  for (int y = top; y < top + block_px; y += stride_px)
    for (int x = left; x < left + block_px; x += stride_px) {
      const std::size_t a =
          static_cast<std::size_t>(y) * pictures[0]->row_bytes() + static_cast<std::size_t>(x);
      const std::uint8_t one = pictures[0]->pixels[a], other = pictures[0]->pixels[a + apart_px];
      const auto [low, high] = std::minmax(one, other);
      if (low < black || high > white || high - low > most_step) continue;
      std::array<int, n_needed> d{};
      for (std::size_t i = 0; i < n_needed; ++i)
        d[i] = pictures[i]->pixels[a] - pictures[i]->pixels[a + apart_px];
      const int first = d[2] - d[3];
      sums.squares += first * first;
      sums.next += first * (d[1] - d[2]);
      sums.after_next += first * (d[0] - d[1]);
      ++sums.n;
    }
  return sums;
}
}  // namespace

void TemporalMix::reset() {
  seen_.clear();
  n_regular_ = 0;
  repeats_ = leaves_ghost_ = false;
}

void TemporalMix::learn(double noise) {
  if (n_taken_ <= pictures_of_start || noise < least_noise) return;
  std::array<const Image*, n_needed> pictures{};
  for (std::size_t i = 0; i < n_needed; ++i) pictures[i] = &seen_[i].gray;
  std::vector<NoiseSums> blocks;
  std::vector<double> variances;
  for (int y = 0; y + block_px <= pictures[0]->height; y += block_px)
    for (int x = 0; x + block_px + apart_px <= pictures[0]->width; x += block_px)
      if (const NoiseSums sums = noise_of_block(pictures, x, y); sums.n >= least_places) {
        blocks.push_back(sums);
        variances.push_back(sums.variance());
      }
  if (blocks.size() < least_blocks) return;
  const double most = most_variance * quantile(variances, 0.5).value_or(0);
  next_ *= memory;
  after_next_ *= memory;
  for (const NoiseSums& sums : blocks)
    if (sums.variance() <= most) {
      next_ += sums.next + rounding_variance * sums.n;
      after_next_ += sums.after_next;
    }
  const double share = next_ < 0 ? after_next_ / next_ : 0;
  share_ = share < least_share ? 0 : std::min(share, most_share);
}

// Whether moving parts are not mixed: a mixed picture would have at most 1 - share of a change from
// black to white or back.
bool TemporalMix::keeps_motion_sharp() const {
  const Image &now = seen_[0].gray, &before = seen_[1].gray;
  const double most_change = (1 + 2 * (1 - share_)) / 3;
  std::array<int, 256> counts{};
  for (std::size_t i = 0; i < now.pixels.size(); i += 7) ++counts[now.pixels[i]];
  const auto quantile = [&](double fraction) {
    double left = fraction * static_cast<double>(now.pixels.size() / 7);
    int level = 0;
    while (level < 255 && (left -= counts[static_cast<std::size_t>(level)]) > 0) ++level;
    return level;
  };
  const int contrast = quantile(0.98) - quantile(0.02);
  int n_changed = 0, n_beyond = 0;
  for (std::size_t i = 0; i < now.pixels.size(); i += 2) {
    const int change = std::abs(now.pixels[i] - before.pixels[i]);
    n_changed += change > contrast / 3;
    n_beyond += change > most_change * contrast;
  }
  constexpr int least_changed = 50;
  constexpr double most_beyond = 0.05;
  return n_changed > least_changed && n_beyond > most_beyond * n_changed;
}

Image TemporalMix::cleared(Image gray, double t_s, double noise) {
  repeats_ = !seen_.empty() && seen_.front().gray.pixels == gray.pixels;
  if (repeats_) return gray;
  seen_.push_front({std::move(gray), t_s});
  ++n_taken_;
  if (seen_.size() > n_needed) seen_.pop_back();
  const Image& now = seen_.front().gray;
  leaves_ghost_ = false;
  if (seen_.size() < 2) return now;
  const double gap_s = t_s - seen_[1].t_s;
  if (usual_gap_s_ == 0 || gap_s < usual_gap_s_) usual_gap_s_ = gap_s;
  const bool is_next = gap_s < regular * usual_gap_s_;
  n_regular_ = is_next ? n_regular_ + 1 : 0;
  if (seen_.size() == n_needed && n_regular_ + 1 >= n_needed) learn(noise);
  leaves_ghost_ = share_ > 0 && !is_next;
  if (share_ == 0 || !is_next || keeps_motion_sharp()) return now;
  Image light = now;
  const std::vector<std::uint8_t>& before = seen_[1].gray.pixels;
  const auto weight = static_cast<float>(share_ / (1 - share_));
  for (std::size_t i = 0; i < light.pixels.size(); ++i) {
    const auto value = static_cast<float>(light.pixels[i]);
    const float clear = value + weight * (value - static_cast<float>(before[i]));
    light.pixels[i] = static_cast<std::uint8_t>(std::clamp(clear + 0.5F, 0.0F, 255.0F));
  }
  return light;
}

}  // namespace heft
