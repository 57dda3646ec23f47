#include "tracking/pose/TagFit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "tracking/detection/FitMath.h"

namespace heft {

namespace {
using enum TagModel::Own;
constexpr int n_shared = TagModel::n_shared, n_own = TagModel::n_own, n_all = TagModel::n_all;
constexpr int n_reflected = TagModel::n_reflected;

constexpr double most_lean =
    0.01;  // between a tag's rows and the body's, as a fraction of the picture's width
constexpr double least_noise = 0.5;
// Relative to the contrast: pixels with a larger residual show another object. The last round has a
// smaller limit, because errors of pose and bias are small by then.
constexpr double far_share = 0.12, last_far_share = 0.05;
// In variances: reflected light is correlated with distance, so that modeling an absent one would
// cost half of the cells' information.
constexpr double least_gain = 50;
// A subset of a larger tag's pixels suffices: those near edges, and one of several in the middle of
// cells, which only determine light.
constexpr double most_pixels = 6000;
constexpr int flat_stride = 4;
// Distance around covering objects that is left out, in blurs.
constexpr double covered_in_blurs = 3;

// Prior precision (1 / variance) of a tag's own unknowns. The blur is known from the borders' fits.
const TagModel::VectorOwn certainty = [] {
  constexpr double of_blur = 1 / (0.05 * 0.05), of_light = 1 / 0.1;
  TagModel::VectorOwn by = TagModel::VectorOwn::Zero();
  by(log_blur) = of_blur;
  by.segment<2>(along).setConstant(of_light);
  by.tail<n_reflected>().setConstant(of_light);
  return by;
}();

// Rays of a row's pixels, one after the other. The distortion changes slowly: linear interpolation
// between every eighth pixel is accurate to thousandths of a pixel.
class RowOfRays {
 public:
  explicit RowOfRays(const Intrinsics& camera) : camera_(camera) {}

  void start(int x, int y) {
    y_ = y;
    end_ = x;
    bend_ = bend_at(x);
    by_x_.setZero();
  }

  /// @param x not before start's
  Eigen::Vector2d at(int x) {
    while (x > end_) {
      const Eigen::Vector2d before = bend_;
      bend_ = bend_at(end_ += step);
      by_x_ = (bend_ - before) / step;
    }
    return straight(x) + bend_ - (end_ - x) * by_x_;
  }

 private:
  static constexpr int step = 8;

  Eigen::Vector2d straight(int x) const {
    return {(x - camera_.cx_px) / camera_.fx_px, (y_ - camera_.cy_px) / camera_.fy_px};
  }
  Eigen::Vector2d bend_at(int x) const {
    const Eigen::Vector2d flat = straight(x);
    return undistort(camera_, {x, y_}, flat + bend_) - flat;
  }

  const Intrinsics& camera_;
  int y_ = 0, end_ = 0;
  Eigen::Vector2d bend_ = Eigen::Vector2d::Zero(), by_x_ = Eigen::Vector2d::Zero();
};
}  // namespace

TagFit::TagFit(const Image& gray, const Intrinsics& camera, const DenseTag& tag, const Pose& start,
               const ToneCurve& curve, double noise, const std::optional<Smear>& smear,
               const std::optional<RowsHeld>& rows)
    : model_(tag, curve), seen_(*tag.seen), picture_noise_(noise), noise_(std::max(6.0, noise)) {
  if (!model_.is_clear()) return;
  collect(gray, camera, start, rows);
  if (seen_.covered()) leave_out_covered(start);
  if (smear) model_.smear_along(*smear, start);
}

double TagFit::explained() const {
  return static_cast<double>(used_) / static_cast<double>(std::max<std::size_t>(1, pixels_.size()));
}

void TagFit::collect(const Image& gray, const Intrinsics& camera, const Pose& pose,
                     const std::optional<RowsHeld>& rows) {
  const TagPlane plane = model_.plane(pose);
  const Eigen::Vector2d beyond = model_.beyond_cells(plane);
  const double n = model_.border_cells();
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
  const Eigen::Vector2d near = model_.near_cells(plane);
  // Rows are offset against each other.
  const int stride = 1 + static_cast<int>(seen_.area_px2 / most_pixels);
  RowOfRays rays(camera);
  for (int y = y0; y <= y1; ++y) {
    const std::uint8_t* row = &gray.pixels[static_cast<std::size_t>(y) * gray.row_bytes()];
    rays.start(x0, y);
    for (int x = x0; x <= x1; ++x) {
      if ((x + (stride > 2 ? 2 * y : y)) % stride != 0) continue;
      Eigen::Vector2d ray = rays.at(x);
      if (rows) ray = (*rows)(ray, y, TagHit(plane, ray).point_m);
      const Eigen::Vector2d cell = TagHit(plane, ray).cell;
      if (!((cell.array() > -beyond.array()).all() && (cell.array() < n + beyond.array()).all()))
        continue;
      if ((x + 2 * y) % (flat_stride * stride) != 0 && model_.is_flat(cell, near)) continue;
      pixels_.push_back({ray, static_cast<double>(row[x])});
    }
  }
}

// Residual above which a pixel shows another object, gray levels.
double TagFit::far_off(double share) const {
  return std::max({10.0, share * (seen_.bright - seen_.dark), 3 * picture_noise_});
}

// Leaves out pixels of covering objects, and those near enough to be blurred with them.
void TagFit::leave_out_covered(const Pose& pose) {
  const TagPlane plane = model_.plane(pose);
  const double reach = covered_in_blurs * model_.blur_px() / seen_.px_per_ray;
  std::vector<Eigen::Vector2d> covers;
  VectorAll unused;
  for (const Pixel& pixel : pixels_)
    if (std::abs(pixel.value - model_.gray_level(pixel.ray, plane, pose, 0, unused)) >
        far_off(far_share))
      covers.push_back(pixel.ray);
  std::erase_if(pixels_, [&](const Pixel& pixel) {
    return std::ranges::any_of(covers, [&](const Eigen::Vector2d& ray) {
      return (ray - pixel.ray).squaredNorm() < reach * reach;
    });
  });
}

void TagFit::add_to(MatrixShared& matrix, VectorShared& rhs, const Pose& pose, double bias_px,
                    Round round) {
  MatrixAll all = MatrixAll::Zero();
  VectorAll all_rhs = VectorAll::Zero();
  all.diagonal().tail<n_own>() = certainty;
  all_rhs.tail<n_own>() = -certainty.cwiseProduct(model_.own());
  const TagPlane plane = model_.plane(pose);
  const double clip = 2.5 * noise_;
  const double share = round == Round::last ? last_far_share : far_share;
  const double far = round != Round::first || seen_.covered() ? far_off(share) : 1e9;
  double sum = 0;
  int n = 0;
  for (const Pixel& pixel : pixels_) {
    VectorAll by;
    const double residual = pixel.value - model_.gray_level(pixel.ray, plane, pose, bias_px, by);
    const double size = std::abs(residual);
    if (size > far) continue;
    sum += size;
    ++n;
    const double weight = (size > clip ? clip / size : 1) / (noise_ * noise_);
    add_lower<n_all>(all, weight * by, by);
    all_rhs += weight * residual * by;
  }
  complete_upper(all);
  noise_ = std::max(least_noise, 1.2533 * sum / std::max(1, n));
  used_ = n;
  reflects_ = reflects_ || (round != Round::first && gained(all, all_rhs) > least_gain);
  if (!reflects_) all.diagonal().tail<n_reflected>().array() += 1e12;
  const auto own_part = all.bottomRightCorner<n_own, n_own>();
  const Eigen::LDLT<Eigen::Matrix<double, n_own, n_own>> solver(own_part);
  own_by_shared_ = solver.solve(all.bottomLeftCorner<n_own, n_shared>());
  own_step_ = solver.solve(all_rhs.tail<n_own>());
  matrix += all.topLeftCorner<n_shared, n_shared>() -
            all.topRightCorner<n_shared, n_own>() * own_by_shared_;
  rhs += all_rhs.head<n_shared>() - all.topRightCorner<n_shared, n_own>() * own_step_;
}

// Decrease of the cost by modeling reflected light, in variances.
double TagFit::gained(const MatrixAll& all, const VectorAll& rhs) {
  constexpr int n_rest = n_all - n_reflected;
  const auto across = all.bottomLeftCorner<n_reflected, n_rest>();
  const Eigen::LDLT<Eigen::Matrix<double, n_rest, n_rest>> rest(
      all.topLeftCorner<n_rest, n_rest>());
  const Eigen::Matrix<double, n_reflected, n_reflected> left =
      all.bottomRightCorner<n_reflected, n_reflected>() - across * rest.solve(across.transpose());
  const Eigen::Matrix<double, n_reflected, 1> pull_left =
      rhs.tail<n_reflected>() - across * rest.solve(rhs.head<n_rest>());
  return pull_left.dot(left.ldlt().solve(pull_left));
}

}  // namespace heft
