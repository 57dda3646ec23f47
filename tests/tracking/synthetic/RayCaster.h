// A second camera, to test the tracker independently of the synthetic one: rays through pixels at
// scattered places, shaded faces of a box, a shadow's edge, and a sensor with any tone curve, a
// color mosaic and sharpening. Shares only the lens and the tags' cells with the synthetic camera.
// Slow.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "base/Image.h"
#include "base/Random.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/detection/TagEdges.h"
#include "tracking/detection/ToneCurve.h"

namespace heft {

/// Imperfections of a camera and its light.
struct CameraFaults {
  std::function<double(double light)> tone;  ///< 0...1 of light 0...; none: sRGB
  double blur_px = 0.6, noise = 3, exposure = 1;
  double sharpening = 0;         ///< amount of an unsharp mask of 1 px on the stored values
  bool mosaic = false;           ///< each pixel has one color, the others are interpolated
  std::optional<double> shadow;  ///< fraction of light beyond an edge through the effector
  double side_light = 0.5;       ///< fraction of the box's light that depends on the face's normal
  double readout_s = 0;
};

/// Tone curves beside sRGB.
inline double power_curve(double light, double gamma) {
  return std::pow(std::clamp(light, 0.0, 1.0), 1 / gamma);
}
/// A shoulder and a toe: Narkowicz's fit of the film curve of the Academy Color Encoding System,
/// stored as sRGB.
inline double film_curve(double light) {
  const double x = 0.8 * light;
  return stored_of_light(std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0., 1.))
             .value /
         255;
}
/// sRGB, then more contrast in the middle.
inline double s_curve(double light, double strength = 0.6) {
  const double v = stored_of_light(std::min(light, 1.0)).value / 255;
  return (1 - strength) * v + strength * v * v * (3 - 2 * v);
}

class RayCaster {
 public:
  using Path = std::function<Pose(double t_s)>;

  RayCaster(const Apparatus& apparatus, const Pose& camera_from_board, int rays_across = 5)
      : apparatus_(apparatus),
        camera_from_board_(camera_from_board),
        n_(rays_across),
        board_patterns_(patterns_of(apparatus.board)),
        effector_patterns_(patterns_of(apparatus.effector)) {
    const Intrinsics& camera = apparatus.camera;
    for (int y = 0; y < camera.height_px; ++y)
      for (int x = 0; x < camera.width_px; ++x) {
        const Eigen::Vector2d ray = undistort(camera, Eigen::Vector2d(x, y));
        lens_.push_back({ray, distort_with_derivative(camera, ray).pixel_by_ray.inverse()});
      }
  }

  /// Row r of R is seen at t_s + readout_s * r / R.
  Image picture(const Path& board_from_effector, double t_s, const CameraFaults& faults,
                std::uint64_t number) const {
    return developed(light(board_from_effector, t_s, faults, number), faults, number);
  }

  /// The light behind the lens: rays_across values per pixel in each direction.
  std::vector<float> light(const Path& board_from_effector, double t_s, const CameraFaults& faults,
                           std::uint64_t number) const {
    const Intrinsics& camera = apparatus_.camera;
    std::vector<float> sharp = cast(board_from_effector, t_s, faults, number);
    blur(sharp, camera.width_px * n_, camera.height_px * n_, faults.blur_px * n_);
    return sharp;
  }

 private:
  struct LensPixel {
    Eigen::Vector2d ray;
    Eigen::Matrix2d ray_by_pixel;
  };
  static constexpr double paper = 0.85, ink = 0.035;

  // Light of a tag's print at a point of its plane; none beside it.
  static std::optional<double> printed(const Tag& tag, const TagPattern& pattern,
                                       const Eigen::Vector3d& point_m) {
    const auto& c = tag.corners_m;
    if ((point_m - c[0]).squaredNorm() > 3 * (c[2] - c[0]).squaredNorm()) return std::nullopt;
    const Eigen::Vector3d right = c[1] - c[0], down = c[3] - c[0], from = point_m - c[0];
    const double margin = pattern.margin_cells();
    const double column = from.dot(right) / right.squaredNorm() * pattern.border_cells + margin;
    const double row = from.dot(down) / down.squaredNorm() * pattern.border_cells + margin;
    if (!(column >= 0 && row >= 0 && column < pattern.n_cells && row < pattern.n_cells))
      return std::nullopt;
    return pattern.is_white(static_cast<int>(column), static_cast<int>(row)) ? paper : ink;
  }

  double board_light(const Eigen::Vector3d& point_m) const {
    const bool on_sheet = std::abs(point_m.x()) < 0.1485 && std::abs(point_m.y()) < 0.105;
    if (!on_sheet) return 0.2;
    for (std::size_t i = 0; i < board_patterns_.size(); ++i)
      if (const auto light = printed(apparatus_.board.tags[i], board_patterns_[i], point_m))
        return *light;
    return paper;
  }

  // Where a ray enters the box, and through which side; none beside it.
  struct Hit {
    Eigen::Vector3d point_m, normal;
  };
  std::optional<Hit> box_hit(const Eigen::Vector3d& eye_m, const Eigen::Vector3d& along) const {
    const Eigen::Vector3d half_m = apparatus_.effector.size_m / 2;
    double enters = 0, leaves = 1e9;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      double a = (-half_m(axis) - eye_m(axis)) / along(axis);
      double b = (half_m(axis) - eye_m(axis)) / along(axis);
      if (a > b) std::swap(a, b);
      if (a > enters) {
        enters = a;
        normal = -std::copysign(1, along(axis)) * Eigen::Vector3d::Unit(axis);
      }
      leaves = std::min(leaves, b);
    }
    if (!(enters > 0 && enters < leaves)) return std::nullopt;
    return Hit{eye_m + enters * along, normal};
  }

  double box_light(const Hit& hit) const {
    if (hit.point_m.x() < -0.012) return 0.3;  // fingers
    for (std::size_t i = 0; i < effector_patterns_.size(); ++i) {
      const Tag& tag = apparatus_.effector.tags[i];
      if (tag_normal(tag).dot(hit.normal) < 0.9) continue;
      if (const auto light = printed(tag, effector_patterns_[i], hit.point_m)) return *light;
    }
    return paper;
  }

  std::vector<float> cast(const Path& path, double t_s, const CameraFaults& faults,
                          std::uint64_t number) const {
    const Intrinsics& camera = apparatus_.camera;
    const int width = camera.width_px * n_, height = camera.height_px * n_;
    std::vector<float> light(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const Pose board_from_camera = camera_from_board_.inverse();
    const Eigen::Vector3d lamp = Eigen::Vector3d(-0.5, 0.25, 1).normalized();
    const Eigen::Vector3d shadow_through = path(t_s) * Eigen::Vector3d(0.028, 0, 0);
    const Eigen::Vector3d shadow_normal = Eigen::Vector3d(0.8, 0.6, 0.3).normalized();
    std::uint64_t state = 88172645463325252ULL + number;
    const auto scattered = [&] {  // xorshift
      state ^= state << 13, state ^= state >> 7, state ^= state << 17;
      return static_cast<double>(state >> 11) * 0x1p-53;
    };
    for (int row = 0; row < height; ++row) {
      const int y = row / n_;
      const Pose board_from_effector = path(t_s + faults.readout_s * y / camera.height_px);
      const Pose effector_from_board = board_from_effector.inverse();
      const Eigen::Vector3d eye_m = effector_from_board * board_from_camera.position_m;
      for (int column = 0; column < width; ++column) {
        const int x = column / n_;
        const LensPixel& lens = lens_[static_cast<std::size_t>(y * camera.width_px + x)];
        const Eigen::Vector2d within((column % n_ + scattered()) / n_ - 0.5,
                                     (row % n_ + scattered()) / n_ - 0.5);
        const Eigen::Vector3d along =
            board_from_camera.orientation * (lens.ray + lens.ray_by_pixel * within).homogeneous();
        double value;
        Eigen::Vector3d point_m;
        if (const auto hit = box_hit(eye_m, effector_from_board.orientation * along)) {
          const Eigen::Vector3d normal = board_from_effector.orientation * hit->normal;
          value =
              box_light(*hit) * (1 - faults.side_light +
                                 faults.side_light * std::max(0.0, normal.dot(lamp)) / lamp.z());
          point_m = board_from_effector * hit->point_m;
        } else {
          const double way = -board_from_camera.position_m.z() / along.z();
          point_m = board_from_camera.position_m + way * along;
          value = board_light(point_m);
        }
        if (faults.shadow) {
          const double lit =
              std::clamp(0.5 + (point_m - shadow_through).dot(shadow_normal) / 0.002, 0.0, 1.0);
          value *= *faults.shadow + (1 - *faults.shadow) * lit;
        }
        light[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
              static_cast<std::size_t>(column)] = static_cast<float>(value);
      }
    }
    return light;
  }

  static void blur(std::vector<float>& values, int width, int height, double sd) {
    if (!(sd > 0)) return;
    const int reach = static_cast<int>(std::ceil(3.5 * sd));
    std::vector<float> kernel;
    float sum = 0;
    for (int i = -reach; i <= reach; ++i)
      sum += kernel.emplace_back(static_cast<float>(std::exp(-0.5 * i * i / (sd * sd))));
    for (float& weight : kernel) weight /= sum;
    std::vector<float> out(values.size());
    const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
    for (std::size_t y = 0; y < h; ++y)
      for (int i = -reach; i <= reach; ++i) {
        const int first = std::max(0, -i), last = std::min(width, width - i);
        const float weight = kernel[static_cast<std::size_t>(i + reach)];
        for (int x = first; x < last; ++x)
          out[y * w + static_cast<std::size_t>(x)] +=
              weight * values[y * w + static_cast<std::size_t>(x + i)];
      }
    std::ranges::fill(values, 0.0F);
    for (int i = -reach; i <= reach; ++i)
      for (int y = std::max(0, -i); y < std::min(height, height - i); ++y) {
        const float weight = kernel[static_cast<std::size_t>(i + reach)];
        float* to = values.data() + static_cast<std::size_t>(y) * w;
        const float* from = out.data() + static_cast<std::size_t>(y + i) * w;
        for (std::size_t x = 0; x < w; ++x) to[x] += weight * from[x];
      }
  }

 public:
  /// The sensor: exposure, vignetting, tone curve, noise, mosaic and sharpening.
  Image developed(const std::vector<float>& light, const CameraFaults& faults,
                  std::uint64_t number) const {
    const int width = apparatus_.camera.width_px, height = apparatus_.camera.height_px;
    const auto at = [&](int x, int y) {
      return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
             static_cast<std::size_t>(x);
    };
    RandomStream random(number, "ray caster's noise");
    std::vector<float> stored[3];
    for (auto& channel : stored) channel.resize(light.size() / static_cast<std::size_t>(n_ * n_));
    const double far2 = (width * width + height * height) / 4.0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        double sum = 0;
        for (int j = 0; j < n_; ++j)
          for (int i = 0; i < n_; ++i)
            sum +=
                light[static_cast<std::size_t>(y * n_ + j) * static_cast<std::size_t>(width * n_) +
                      static_cast<std::size_t>(x * n_ + i)];
        const double dx = x - width / 2.0, dy = y - height / 2.0;
        const double seen =
            sum / (n_ * n_) * faults.exposure * (1 - 0.3 * (dx * dx + dy * dy) / far2);
        const double clipped = std::min(seen, 1.0);
        const double value =
            255 * (faults.tone ? faults.tone(seen) : stored_of_light(clipped).value / 255);
        for (auto& channel : stored) channel[at(x, y)] = static_cast<float>(value);
        if (faults.noise > 0) {
          const double off = faults.noise * random.normal();
          for (auto& channel : stored) channel[at(x, y)] += static_cast<float>(off);
        }
      }
    if (faults.mosaic)
      for (int channel = 0; channel < 3; ++channel)
        demosaic(stored[channel], channel, width, height);
    if (faults.sharpening > 0)
      for (auto& channel : stored) {
        std::vector<float> smooth = channel;
        blur(smooth, width, height, 1);
        for (std::size_t i = 0; i < smooth.size(); ++i)
          channel[i] += static_cast<float>(faults.sharpening) * (channel[i] - smooth[i]);
      }
    Image image(width, height, 3);
    for (std::size_t i = 0; i < stored[0].size(); ++i)
      for (std::size_t channel = 0; channel < 3; ++channel)
        image.pixels[3 * i + channel] =
            static_cast<std::uint8_t>(std::clamp(std::lround(stored[channel][i]), 0L, 255L));
    return image;
  }

 private:
  // Keeps the pixels of one color of the mosaic (BG over GR) and interpolates the others linearly.
  static void demosaic(std::vector<float>& values, int channel, int width, int height) {
    const auto has = [&](int x, int y) {
      const int color = x % 2 + y % 2;  // 0 blue, 1 green, 2 red
      return color == channel;
    };
    const std::vector<float> raw = values;
    for (int y = 1; y + 1 < height; ++y)
      for (int x = 1; x + 1 < width; ++x) {
        if (has(x, y)) continue;
        float sum = 0, weights = 0;
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i) {
            if (!has(x + i, y + j)) continue;
            const float weight = channel == 1 && i != 0 && j != 0 ? 0.F : 1.F;
            sum += weight * raw[static_cast<std::size_t>((y + j) * width + x + i)];
            weights += weight;
          }
        values[static_cast<std::size_t>(y * width + x)] = sum / weights;
      }
  }

  Apparatus apparatus_;
  Pose camera_from_board_;
  int n_;
  std::vector<TagPattern> board_patterns_, effector_patterns_;
  std::vector<LensPixel> lens_;
};

}  // namespace heft
