#include "tracking/pose/DensePose.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/Pose.h"
#include "tracking/pose/TagFit.h"

namespace heft {

namespace {
// More rounds if pixels are left out, at a shadow's edge, or light is reflected, since these have
// moved the pose before.
constexpr int rounds = 2, most_rounds = 5;
constexpr double all_explained = 0.99;
constexpr double settled_rad = 5e-5, settled_m = 5e-6;
// Fraction of pixels; below it a shadow's edge or a finger covers the tag.
constexpr double least_explained = 0.9;
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
  TagFit::MatrixShared matrix;
  const auto continues = [&](int round) {
    return round < rounds ||
           (round < most_rounds && std::ranges::any_of(fits, [](const TagFit& tag) {
              return tag.explained() < all_explained || tag.reflects();
            }));
  };
  for (int round = 0; continues(round); ++round) {
    matrix.setZero();
    TagFit::VectorShared rhs = TagFit::VectorShared::Zero();
    matrix(6, 6) = 1 / bias_variance;
    rhs(6) = (prior.mean_px - fit.bias_px) / bias_variance;
    const auto kind = round == 0                 ? TagFit::Round::first
                      : round + 1 == most_rounds ? TagFit::Round::last
                                                 : TagFit::Round::next;
    for (TagFit& tag : fits) tag.add_to(matrix, rhs, fit.camera_from_body, fit.bias_px, kind);
    const TagFit::VectorShared change = matrix.ldlt().solve(rhs);
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
  const TagFit::MatrixShared covariance = matrix.inverse();
  fit.covariance = covariance.topLeftCorner<6, 6>();
  fit.bias_sd_px = std::sqrt(covariance(6, 6));
  return fit;
}

}  // namespace heft
