#include "tracking/DensePose.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/Pose.h"
#include "tracking/NormalTable.h"
#include "tracking/SymmetricSum.h"
#include "tracking/TagPlane.h"

namespace heft {

namespace {
constexpr int n_shared = 7;  // turn, shift, bias
// Of a tag: dark, contrast, gradient along and down, log of the blur; reflected light.
constexpr int n_sure = 5, n_reflected = 5, n_own = n_sure + n_reflected;
constexpr int n_all = n_shared + n_own;
using VectorAll = Eigen::Matrix<double, n_all, 1>;
using MatrixAll = Eigen::Matrix<double, n_all, n_all>;
using VectorShared = Eigen::Matrix<double, n_shared, 1>;
using MatrixShared = Eigen::Matrix<double, n_shared, n_shared>;
using VectorOwn = Eigen::Matrix<double, n_own, 1>;
enum Own { dark, contrast, along, down, log_blur, reflected };

// How far beyond the border pixels are compared: what lies beyond the white cell around it, perhaps
// an edge of the box, must not blur into them.
constexpr double most_beyond_cells = 0.45, far_in_blurs = 3;
constexpr double most_lean = 0.01;  // of the picture's width, between a tag's rows and the body's
constexpr double most_blur_cells = 0.45;
constexpr double least_blur_px = 0.29;  // a pixel's own extent: 1 / sqrt(12)
constexpr double blur_sd = 0.05;        // relative; what the borders' fits left open
constexpr double least_noise = 0.5;
// More where pixels are left out, at a shadow's edge, or light is reflected: they had pulled the
// pose before.
constexpr int rounds = 2, most_rounds = 5;
// Of the contrast: what is farther off shows another thing. The last round looks closer, when edges
// are no longer off because pose or bias are.
constexpr double far_share = 0.12, last_far_share = 0.05;
// Variances: reflected light looks a little like another distance, so that looking for what is not
// there would cost half of what the cells tell.
constexpr double least_gain = 50;
constexpr double all_explained = 0.99;
// Of larger tags fewer pixels are enough; and of those in the middle of cells, which tell of light
// alone, one in so many.
constexpr double most_pixels = 6000;
constexpr int flat_stride = 4;
constexpr double edge_in_blurs = 2.5;
// Of a covered tag: what is not it reaches as far.
constexpr double covered_in_blurs = 3;
constexpr double settled_rad = 5e-5, settled_m = 5e-6;
// Of the pixels: a shadow's edge or a finger lies over a tag of which less is what it should be.
constexpr double least_explained = 0.9;

// A tag's cells along one axis around a place: how much of the blur lies over each of five.
struct Weights {
  int first;  ///< cell
  std::array<double, 5> weight, by_place, by_log_blur;
};

Weights weights_at(double place, double blur_cells) {
  Weights w;
  const int cell = static_cast<int>(std::floor(place));
  w.first = cell - 2;
  double before = 1, before_by_place = 0, before_by_blur = 0;
  for (int i = 0; i < 4; ++i) {
    const double q = (place - (cell - 1 + i)) / blur_cells;
    const Normal normal = normal_at(q);
    const double by_place = normal.density / blur_cells, by_blur = -q * normal.density;
    const auto k = static_cast<std::size_t>(i);
    w.weight[k] = before - normal.below;
    w.by_place[k] = before_by_place - by_place;
    w.by_log_blur[k] = before_by_blur - by_blur;
    before = normal.below, before_by_place = by_place, before_by_blur = by_blur;
  }
  w.weight[4] = before;
  w.by_place[4] = before_by_place;
  w.by_log_blur[4] = before_by_blur;
  return w;
}

struct Pixel {
  Eigen::Vector2d ray;
  double value;
};

class TagFit {
 public:
  TagFit(const Image& gray, const Intrinsics& camera, const DenseTag& tag, const Pose& start,
         const ToneCurve& curve, double noise, const std::optional<Smear>& smear,
         const std::optional<RowsHeld>& rows)
      : seen_(*tag.seen),
        pattern_(*tag.pattern),
        curve_(curve),
        blur_px_(std::max(least_blur_px, tag.seen->blur_px[0]),
                 std::max(least_blur_px, tag.seen->blur_px[1])),
        picture_noise_(noise),
        noise_(std::max(6.0, noise)) {
    own_(dark) = curve.light(seen_.dark);
    own_(contrast) = curve.light(seen_.bright) - own_(dark);
    if (!is_clear()) return;
    paint();
    collect(gray, camera, start, rows);
    if (seen_.covered()) leave_out_covered(start);
    if (smear) smear_along(*smear, start);
  }

  bool usable() const { return pixels_.size() > 100; }

  // What this tag's pixels say about what tags share, its own unknowns taken out.
  void add_to(MatrixShared& matrix, VectorShared& pull, const Pose& pose, double bias_px,
              int round) {
    MatrixAll all = MatrixAll::Zero();
    VectorAll all_pull = VectorAll::Zero();
    all(n_shared + log_blur, n_shared + log_blur) = 1 / (blur_sd * blur_sd);
    all_pull(n_shared + log_blur) = -own_(log_blur) / (blur_sd * blur_sd);
    all.diagonal().segment<2>(n_shared + along).array() += 10;
    all_pull.segment<2>(n_shared + along) -= 10 * own_.segment<2>(along);
    all.diagonal().tail<n_reflected>().array() += 10;
    all_pull.tail<n_reflected>() -= 10 * own_.tail<n_reflected>();
    const TagPlane plane(pose, seen_.corners_m, pattern_.border_cells);
    const double clip = 2.5 * noise_;
    const double share = round + 1 < most_rounds ? far_share : last_far_share;
    const double far = round > 0 || seen_.covered() ? far_off(share) : 1e9;
    double sum = 0;
    int n = 0;
    for (const Pixel& pixel : pixels_) {
      VectorAll by;
      const double residual = pixel.value - modeled(pixel, plane, pose, bias_px, by);
      const double size = std::abs(residual);
      if (size > far) continue;
      sum += size;
      ++n;
      const double weight = (size > clip ? clip / size : 1) / (noise_ * noise_);
      add_lower<n_all>(all, weight * by, by);
      all_pull += weight * residual * by;
    }
    complete_upper(all);
    noise_ = std::max(least_noise, 1.2533 * sum / std::max(1, n));
    used_ = n;
    reflects_ = reflects_ || (round > 0 && gained(all, all_pull) > least_gain);
    if (!reflects_) all.diagonal().tail<n_reflected>().array() += 1e12;
    const auto own_part = all.bottomRightCorner<n_own, n_own>();
    const Eigen::LDLT<Eigen::Matrix<double, n_own, n_own>> solver(own_part);
    own_by_shared_ = solver.solve(all.bottomLeftCorner<n_own, n_shared>());
    own_step_ = solver.solve(all_pull.tail<n_own>());
    matrix += all.topLeftCorner<n_shared, n_shared>() -
              all.topRightCorner<n_shared, n_own>() * own_by_shared_;
    pull += all_pull.head<n_shared>() - all.topRightCorner<n_shared, n_own>() * own_step_;
  }

  void step(const VectorShared& shared) {
    own_ += own_step_ - own_by_shared_ * shared;
    own_(log_blur) = std::clamp(own_(log_blur), -0.5, 0.5);
  }

  bool reflects() const { return reflects_; }

  double explained() const {
    return static_cast<double>(used_) /
           static_cast<double>(std::max<std::size_t>(1, pixels_.size()));
  }

 private:
  // By how many variances reflected light would explain the pixels better.
  static double gained(const MatrixAll& all, const VectorAll& pull) {
    constexpr int n_rest = n_all - n_reflected;
    const auto across = all.bottomLeftCorner<n_reflected, n_rest>();
    const Eigen::LDLT<Eigen::Matrix<double, n_rest, n_rest>> rest(
        all.topLeftCorner<n_rest, n_rest>());
    const Eigen::Matrix<double, n_reflected, n_reflected> left =
        all.bottomRightCorner<n_reflected, n_reflected>() - across * rest.solve(across.transpose());
    const Eigen::Matrix<double, n_reflected, 1> pull_left =
        pull.tail<n_reflected>() - across * rest.solve(pull.head<n_rest>());
    return pull_left.dot(left.ldlt().solve(pull_left));
  }

  bool is_clear() const {
    const double cell_px = std::sqrt(seen_.area_px2) / pattern_.border_cells;
    return own_(contrast) > 0.002 && blur_px_.maxCoeff() < most_blur_cells * cell_px;
  }

  void collect(const Image& gray, const Intrinsics& camera, const Pose& pose,
               const std::optional<RowsHeld>& rows) {
    const TagPlane plane(pose, seen_.corners_m, pattern_.border_cells);
    const Eigen::Vector2d beyond = beyond_cells(plane);
    const double n = pattern_.border_cells;
    Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
    for (const double right : {-beyond.x(), n + beyond.x()})
      for (const double below : {-beyond.y(), n + beyond.y()}) {
        const Eigen::Vector3d p = plane.corner_m + right * plane.right_m + below * plane.down_m;
        const Eigen::Vector2d pixel = project(camera, p);
        low = low.cwiseMin(pixel), high = high.cwiseMax(pixel);
      }
    if (rows) {
      const double leans_px = most_lean * gray.width;
      low.array() -= leans_px, high.array() += leans_px;
    }
    const int x0 = std::max(0, static_cast<int>(low.x())),
              y0 = std::max(0, static_cast<int>(low.y()));
    const int x1 = std::min(gray.width - 1, static_cast<int>(high.x()) + 1);
    const int y1 = std::min(gray.height - 1, static_cast<int>(high.y()) + 1);
    const Eigen::Vector2d near = near_cells(plane);
    // In rows that are offset.
    const int stride = 1 + static_cast<int>(seen_.area_px2 / most_pixels);
    const Eigen::Vector2d ray_by_pixel(1 / camera.fx_px, 1 / camera.fy_px);
    Eigen::Vector2d bend = -ray_by_pixel.cwiseProduct(Eigen::Vector2d(camera.cx_px, camera.cy_px));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        if ((x + (stride > 2 ? 2 * y : y)) % stride != 0) continue;
        const Eigen::Vector2d pixel(x, y), straight = ray_by_pixel.cwiseProduct(pixel);
        Eigen::Vector2d ray = undistort(camera, pixel, straight + bend);
        bend = ray - straight;  // nearly the next one's
        if (rows) ray = (*rows)(ray, y, TagHit(plane, ray).point_m);
        const Eigen::Vector2d cell = TagHit(plane, ray).cell;
        if (!((cell.array() > -beyond.array()).all() && (cell.array() < n + beyond.array()).all()))
          continue;
        if ((x + 2 * y) % (flat_stride * stride) != 0 && is_flat(cell, near)) continue;
        const auto at =
            static_cast<std::size_t>(y) * gray.row_bytes() + static_cast<std::size_t>(x);
        pixels_.push_back({ray, static_cast<double>(gray.pixels[at])});
      }
  }

  // No edge of the pattern within so many cells of a place.
  bool is_flat(const Eigen::Vector2d& cell, const Eigen::Vector2d& near) const {
    const auto is_white = [&](double right, double below) {
      const auto place = [&](double at) {
        return std::clamp(static_cast<int>(std::floor(at)) + padding, 0, n_painted_ - 1);
      };
      return white_[static_cast<std::size_t>(place(cell.y() + below) * n_painted_ +
                                             place(cell.x() + right))];
    };
    const std::uint8_t here = is_white(-near.x(), -near.y());
    return is_white(near.x(), -near.y()) == here && is_white(-near.x(), near.y()) == here &&
           is_white(near.x(), near.y()) == here;
  }

  // How far off a pixel is that shows another thing, gray levels.
  double far_off(double share) const {
    return std::max({10.0, share * (seen_.bright - seen_.dark), 3 * picture_noise_});
  }

  // What is not the tag, and what is so near to it that they are blurred into each other.
  void leave_out_covered(const Pose& pose) {
    const TagPlane plane(pose, seen_.corners_m, pattern_.border_cells);
    const double reach = covered_in_blurs * blur_px_.maxCoeff() / seen_.px_per_ray;
    std::vector<Eigen::Vector2d> covers;
    VectorAll unused;
    for (const Pixel& pixel : pixels_)
      if (std::abs(pixel.value - modeled(pixel, plane, pose, 0, unused)) > far_off(far_share))
        covers.push_back(pixel.ray);
    std::erase_if(pixels_, [&](const Pixel& pixel) {
      return std::ranges::any_of(covers, [&](const Eigen::Vector2d& ray) {
        return (ray - pixel.ray).squaredNorm() < reach * reach;
      });
    });
  }

  TagHit middle(const TagPlane& plane) const {
    const Eigen::Vector3d middle_m =
        plane.corner_m + pattern_.border_cells / 2.0 * (plane.right_m + plane.down_m);
    return TagHit(plane, middle_m.hnormalized());
  }

  // The variance that motion adds along its way, from what it adds across the borders.
  void smear_along(const Smear& smear, const Pose& pose) {
    const TagHit hit = middle(TagPlane(pose, seen_.corners_m, pattern_.border_cells));
    const Eigen::Vector3d v = smear.velocity.linear_m_s +
                              smear.velocity.angular_rad_s.cross(hit.point_m - pose.position_m);
    const Eigen::Vector2d along = v.head<2>() - v.z() * hit.point_m.hnormalized();
    if (!(along.norm() > 0)) return;
    const Eigen::Vector2d across = (hit.cell_by_slant.rowwise().normalized() * along.normalized())
                                       .cwiseAbs2();  // of the way, across each kind of border
    const double still = smear.still_blur_px * smear.still_blur_px;
    const Eigen::Vector2d added = blur_px_.cwiseAbs2().array() - still;
    const double variance = std::max(0.0, across.dot(added) / across.squaredNorm());
    blur_shape_ += variance / still * along.normalized() * along.normalized().transpose();
  }

  Eigen::Vector2d beyond_cells(const TagPlane& plane) const {
    const TagHit hit = middle(plane);
    const double pixel_m = hit.point_m.z() / seen_.px_per_ray;
    Eigen::Vector2d beyond;
    for (int i = 0; i < 2; ++i)
      beyond(i) = std::clamp(pattern_.margin_cells() - far_in_blurs * blur_px_(i) * pixel_m *
                                                           hit.cell_by_slant.row(i).norm(),
                             0.0, most_beyond_cells);
    return beyond;
  }

  // How far an edge is blurred.
  Eigen::Vector2d near_cells(const TagPlane& plane) const {
    const TagHit hit = middle(plane);
    const double pixel_m = hit.point_m.z() / seen_.px_per_ray;
    const Eigen::Vector2d cell_by_px = pixel_m * hit.cell_by_slant.rowwise().norm();
    return (edge_in_blurs * cell_by_px.cwiseProduct(blur_px_)).cwiseMin(0.5);
  }

  // The pattern with its outermost cells carried on, as far as five cells around a pixel reach.
  static constexpr int padding = 3;
  void paint() {
    n_painted_ = pattern_.border_cells + 2 * padding;
    const int margin = pattern_.margin_cells(), last = pattern_.n_cells - 1;
    for (int row = 0; row < n_painted_; ++row)
      for (int column = 0; column < n_painted_; ++column)
        white_.push_back(pattern_.is_white(std::clamp(column - padding + margin, 0, last),
                                           std::clamp(row - padding + margin, 0, last)));
  }

  double modeled(const Pixel& pixel, const TagPlane& plane, const Pose& pose, double bias_px,
                 VectorAll& by) const {
    const TagHit hit(plane, pixel.ray);
    // A pixel's size on the tag.
    const double pixel_m = hit.point_m.z() / seen_.px_per_ray, wider = std::exp(own_(log_blur));
    const Eigen::Vector2d cell_by_px = pixel_m * hit.cell_by_slant.rowwise().norm();
    const Eigen::Vector2d blur = wider * cell_by_px.cwiseProduct(blur_px_);
    const Weights across = weights_at(hit.cell.x(), blur.x());
    const Weights below = weights_at(hit.cell.y(), blur.y());
    // Seen at a slant, or smeared, the blur lies at a slant on the tag: two terms of Mehler's
    // series.
    const Eigen::Matrix2d shape = hit.cell_by_slant * blur_shape_ * hit.cell_by_slant.transpose();
    const double correlation = shape(0, 1) / std::sqrt(shape(0, 0) * shape(1, 1));
    const double slanted = correlation * blur.prod(), twice = correlation * correlation / 2;
    double b = 0, by_blur = 0;
    Eigen::Vector2d by_cell(0, 0);
    const int first_row = std::clamp(below.first + padding, 0, n_painted_ - 5);
    const int first_column = std::clamp(across.first + padding, 0, n_painted_ - 5);
    for (std::size_t j = 0; j < 5; ++j) {
      double row = 0, row_by_place = 0, row_by_blur = 0;
      const std::uint8_t* white = &white_[static_cast<std::size_t>(
          (first_row + static_cast<int>(j)) * n_painted_ + first_column)];
      for (std::size_t i = 0; i < 5; ++i)
        if (white[i] != 0) {
          row += across.weight[i];
          row_by_place += across.by_place[i];
          row_by_blur += across.by_log_blur[i];
        }
      b += below.weight[j] * row + slanted * below.by_place[j] * row_by_place +
           twice * below.by_log_blur[j] * row_by_blur;
      by_cell.x() += below.weight[j] * row_by_place;
      by_cell.y() += below.by_place[j] * row;
      by_blur += below.weight[j] * row_by_blur + below.by_log_blur[j] * row;
    }
    const Eigen::Vector2d slope = -(hit.cell_by_slant.transpose() * by_cell);
    const double shrinks = -slope.norm() * pixel_m;  // of white, by a pixel of bias
    b += shrinks * bias_px;
    const double half = pattern_.border_cells / 2.0;
    const Eigen::Vector2d place = (hit.cell.array() - half) / half;
    const double brighter = 1 + own_(along) * place.x() + own_(down) * place.y();
    Eigen::Matrix<double, n_reflected, 1> powers;
    powers << place, place.cwiseAbs2(), place.prod();
    const double light = own_(dark) + own_(contrast) * b + own_.tail<n_reflected>().dot(powers);
    const Stored stored = curve_.stored(light * brighter);
    const double by_light = stored.by_light * brighter, by_b = by_light * own_(contrast);
    const Eigen::Vector3d by_point(by_b * slope.x(), by_b * slope.y(),
                                   -by_b * slope.dot(pixel.ray));
    const Eigen::Vector3d arm = hit.point_m - pose.position_m;
    by << arm.cross(by_point), by_point, by_b * shrinks, by_light, by_light * b,
        stored.by_light * light * place, by_b * by_blur, by_light * powers;
    return stored.value;
  }

  const TagObservation& seen_;
  const TagPattern& pattern_;
  const ToneCurve& curve_;
  const Eigen::Vector2d blur_px_;
  Eigen::Matrix2d blur_shape_ = Eigen::Matrix2d::Identity();  ///< covariance, times what it may be
  double picture_noise_, noise_;
  std::vector<Pixel> pixels_;
  std::vector<std::uint8_t> white_;
  int n_painted_ = 0;
  VectorOwn own_ = VectorOwn::Zero(), own_step_ = VectorOwn::Zero();
  Eigen::Matrix<double, n_own, n_shared> own_by_shared_;
  int used_ = 0;
  bool reflects_ = false;
};
}  // namespace

std::optional<BodyFit> align_densely(const Image& gray, const Intrinsics& camera,
                                     std::span<const DenseTag> tags, const BodyFit& start,
                                     const BiasPrior& prior, const ToneCurve& curve, double noise,
                                     const std::optional<Smear>& smear,
                                     const std::optional<RowsHeld>& rows) {
  std::vector<TagFit> fits;
  std::vector<DenseTag> used;
  for (const DenseTag& tag : tags) {
    TagFit fit(gray, camera, tag, start.camera_from_body, curve, noise, smear, rows);
    if (!fit.usable()) continue;
    fits.push_back(std::move(fit));
    used.push_back(tag);
  }
  if (fits.empty()) return std::nullopt;
  BodyFit fit = start;
  const double bias_variance = std::max(prior.sd_px * prior.sd_px, 1e-8);
  MatrixShared matrix;
  const auto goes_on = [&](int round) {
    return round < rounds ||
           (round < most_rounds && std::ranges::any_of(fits, [](const TagFit& tag) {
              return tag.explained() < all_explained || tag.reflects();
            }));
  };
  for (int round = 0; goes_on(round); ++round) {
    matrix.setZero();
    VectorShared pull = VectorShared::Zero();
    matrix(6, 6) = 1 / bias_variance;
    pull(6) = (prior.mean_px - fit.bias_px) / bias_variance;
    for (TagFit& tag : fits) tag.add_to(matrix, pull, fit.camera_from_body, fit.bias_px, round);
    const VectorShared change = matrix.ldlt().solve(pull);
    if (!change.allFinite() || !(change.head<3>().norm() < 0.2)) return std::nullopt;
    for (TagFit& tag : fits) tag.step(change);
    Pose& pose = fit.camera_from_body;
    pose.orientation = (rotation_from_vector(change.head<3>()) * pose.orientation).normalized();
    pose.position_m += change.segment<3>(3);
    fit.bias_px += change(6);
    if (round > 0 && change.head<3>().norm() < settled_rad &&
        change.segment<3>(3).norm() < settled_m)
      break;
  }
  std::vector<DenseTag> explained;
  for (std::size_t i = 0; i < fits.size(); ++i)
    if (fits[i].explained() >= least_explained) explained.push_back(used[i]);
  if (explained.empty()) return std::nullopt;
  if (explained.size() < used.size())
    return align_densely(gray, camera, explained, start, prior, curve, noise, smear, rows);
  const MatrixShared covariance = matrix.inverse();
  fit.covariance = covariance.topLeftCorner<6, 6>();
  fit.bias_sd_px = std::sqrt(covariance(6, 6));
  return fit;
}

}  // namespace heft
