#include "tracking/pose/BodyPose.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "tracking/detection/MarkerBody.h"
#include "tracking/detection/PlanarPose.h"

namespace heft {

namespace {
constexpr std::size_t most_start_tags = 3, most_adjusted = 3;
constexpr double capped_px = 8;     // limit of a corner's error in the cost
constexpr double worst_rms_px = 3;  // worse is not a pose of this body
constexpr double apart_rad = 0.14;  // poses that differ by less count as one
constexpr double undecided = 12;    // difference of costs, in variances of the better fit
// Clipped white has an unknown brightness, which on a single tag is millimeters of depth.
constexpr double saturated_quality = 0.25;
// Values that halve the quality: residuals, and the SD of the body's position, which for a single
// small or slanted tag is several times that for tags on two faces.
constexpr double halved_at_px = 1.0, halved_at_m = 0.0005;
// ... and the SD of its farthest corner, which a wrong tilt increases: a pose with an SD of a
// centimeter there is useless.
constexpr double halved_at_end_m = 0.002;
constexpr double same_pose_rad = 0.01;
// This many tags whose corners are that close to their expected places leave no ambiguity.
constexpr std::size_t undoubted_tags = 6;
constexpr double undoubted_px = 0.5;
constexpr double expected_sd_rad = 0.1;  // of a rotation predicted from the previous picture

TagObservation::Edge observe_edge(const Intrinsics& camera, const FittedEdge& edge) {
  TagObservation::Edge seen;
  for (std::size_t i = 0; i < 2; ++i) seen.rays[i] = undistort(camera, edge.points_px[i]);
  const Eigen::Vector2d along = (seen.rays[1] - seen.rays[0]).normalized();
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Matrix2d by_ray = distort_with_derivative(camera, seen.rays[i]).pixel_by_ray;
    seen.px_per_ray[i] = std::abs(by_ray.determinant()) / (by_ray * along).norm();
  }
  seen.sd_px = edge.sd_px;
  return seen;
}

double area_of(const std::array<Eigen::Vector2d, 4>& c) {
  const Eigen::Vector2d a = c[2] - c[0], b = c[3] - c[1];
  return std::abs(a.x() * b.y() - a.y() * b.x()) / 2;
}

// Sum of squared errors of all corners, each at most the cap.
double capped_cost(const std::vector<TagObservation>& tags, const Pose& pose) {
  double sum = 0;
  for (const TagObservation& tag : tags)
    for (std::size_t i = 0; i < 4; ++i)
      sum += std::pow(std::min(tag.corner_off_px(i, pose), capped_px), 2);
  return sum;
}

// Lines may fit where corners do not: through a tag seen from behind or edge-on.
bool corners_fit(const std::vector<TagObservation>& tags, const Pose& pose) {
  const double mean_px2 = capped_cost(tags, pose) / static_cast<double>(4 * tags.size());
  return mean_px2 < worst_rms_px * worst_rms_px;
}

double angle_between(const Pose& a, const Pose& b) {
  return a.orientation.angularDistance(b.orientation);
}

struct Start {
  Pose pose;
  double cost;
};

// The two poses of each of the largest tags and the expected one, best first, without near
// duplicates.
std::vector<Start> starts(const std::vector<TagObservation>& tags,
                          const std::optional<Pose>& previous) {
  const double previous_cost = previous ? capped_cost(tags, *previous) : 0;
  if (previous && tags.size() >= undoubted_tags &&
      previous_cost < undoubted_px * undoubted_px * static_cast<double>(4 * tags.size()))
    return {{*previous, previous_cost}};
  std::vector<const TagObservation*> largest;
  for (const TagObservation& tag : tags) largest.push_back(&tag);
  std::ranges::sort(largest, std::greater{}, &TagObservation::area_px2);
  largest.resize(std::min(largest.size(), most_start_tags));
  std::vector<Start> all;
  if (previous) all.push_back({*previous, previous_cost});
  for (const TagObservation* tag : largest)
    for (const Pose& pose : planar_poses(tag->corners_m, tag->rays))
      all.push_back({pose, capped_cost(tags, pose)});
  std::ranges::stable_sort(all, {}, &Start::cost);
  std::vector<Start> distinct;
  for (const Start& start : all) {
    const bool is_new = std::ranges::none_of(distinct, [&](const Start& other) {
      return angle_between(start.pose, other.pose) < apart_rad;
    });
    if (is_new && distinct.size() < most_adjusted) distinct.push_back(start);
  }
  return distinct;
}

Eigen::Vector3d farthest_corner_m(const std::vector<TagObservation>& tags) {
  Eigen::Vector3d farthest = Eigen::Vector3d::Zero();
  for (const TagObservation& tag : tags)
    for (const Eigen::Vector3d& corner_m : tag.corners_m)
      if (corner_m.squaredNorm() > farthest.squaredNorm()) farthest = corner_m;
  return farthest;
}

// Likelihood of a pose relative to the chosen one, at most 1, by their costs and by the expected
// pose if that favors the chosen one. Costs count half, because errors of edges are not only noise.
double likelihood(const BodyFit& other, const BodyFit& best, double scale,
                  const std::optional<Pose>& previous) {
  double exponent = std::max(0.0, (other.cost - best.cost) / scale / 2);
  if (previous) {
    const double other_rad = angle_between(other.camera_from_body, *previous);
    const double best_rad = angle_between(best.camera_from_body, *previous);
    exponent += std::max(0.0, other_rad * other_rad - best_rad * best_rad) /
                (expected_sd_rad * expected_sd_rad);
  }
  return std::exp(-exponent / 2);
}

double spread_m2(const std::vector<BodyFit>& fits, const BodyFit& best, double scale,
                 const std::vector<TagObservation>& tags, const std::optional<Pose>& previous) {
  const Eigen::Vector3d end_m = farthest_corner_m(tags);
  double spread = 0;
  for (const BodyFit& other : fits) {
    const Pose &there = other.camera_from_body, &here = best.camera_from_body;
    if (angle_between(there, here) > same_pose_rad)
      spread = std::max(spread, likelihood(other, best, scale, previous) *
                                    (there * end_m - here * end_m).squaredNorm());
  }
  return spread;
}

// The pose of lowest cost; among those that the picture cannot distinguish, the one nearest to the
// expected pose.
BodyFit decided(std::vector<BodyFit> fits, const std::vector<TagObservation>& tags,
                const std::optional<Pose>& previous) {
  std::ranges::sort(fits, {}, &BodyFit::cost);
  const double scale = std::max(1.0, fits[0].cost / static_cast<double>(8 * tags.size()));
  BodyFit best = fits[0];
  bool ambiguous = false;
  for (const BodyFit& other : fits) {
    const bool apart = angle_between(other.camera_from_body, fits[0].camera_from_body) > apart_rad;
    if (!apart || other.cost > fits[0].cost + undecided * scale) continue;
    ambiguous = true;
    if (previous && angle_between(other.camera_from_body, *previous) <
                        angle_between(best.camera_from_body, *previous))
      best = other;
  }
  best.ambiguous = ambiguous;
  best.spread_m2 = spread_m2(fits, best, scale, tags, previous);
  return best;
}

BodyFit fit_all(const std::vector<TagObservation>& tags, const std::vector<Start>& from,
                const std::optional<Pose>& previous, const BiasPrior& prior) {
  std::vector<BodyFit> fits;
  for (const Start& start : from) fits.push_back(adjust(tags, start.pose, prior));
  return decided(std::move(fits), tags, previous);
}

// Excludes tags with large residuals: misread, or measured on another object.
std::vector<TagObservation> without_outliers(const std::vector<TagObservation>& tags,
                                             const BodyFit& fit) {
  std::vector<double> off;
  for (const TagObservation& tag : tags) off.push_back(tag_rms_px(tag, fit));
  std::vector<double> sorted = off;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) / 2);
  std::ranges::nth_element(sorted, middle);
  const double bound = std::max(0.3, 5 * *middle);
  std::vector<TagObservation> kept;
  for (std::size_t i = 0; i < tags.size(); ++i)
    if (off[i] <= bound) kept.push_back(tags[i]);
  return kept;
}

// Two faces cannot be confused with their mirror image, and each determines depth and tilt of the
// other.
int count_faces(const std::vector<TagObservation>& tags) {
  constexpr double same_cosine = 0.95;
  std::vector<Eigen::Vector3d> normals;
  for (const TagObservation& tag : tags) {
    const Eigen::Vector3d normal = tag_normal({0, tag.corners_m});
    if (std::ranges::none_of(normals, [&](const auto& n) { return n.dot(normal) > same_cosine; }))
      normals.push_back(normal);
  }
  return static_cast<int>(normals.size());
}

}  // namespace

double pose_quality(const std::vector<TagObservation>& tags, const BodyFit& fit) {
  double sum = 0;
  for (const TagObservation& tag : tags)
    sum += tag.quality * (1 - tag.saturated * (1 - saturated_quality));
  const auto halving = [](double squared) { return 1 / (1 + squared); };
  const double place_variance_m2 = fit.covariance.bottomRightCorner<3, 3>().trace();
  // Variance of the farthest corner, which two of three rotations move.
  const double end_variance_m2 =
      place_variance_m2 + fit.spread_m2 +
      fit.covariance.topLeftCorner<3, 3>().trace() * 2 / 3 * farthest_corner_m(tags).squaredNorm();
  return sum / static_cast<double>(tags.size()) * (fit.ambiguous ? 0.5 : 1) *
         halving(fit.rms_px * fit.rms_px / (halved_at_px * halved_at_px)) *
         halving(place_variance_m2 / (halved_at_m * halved_at_m)) *
         halving(end_variance_m2 / (halved_at_end_m * halved_at_end_m));
}

bool TagObservation::covered() const {
  return std::ranges::any_of(edges, [](const Edge& edge) { return std::isinf(edge.sd_px); });
}

double TagObservation::corner_off_px(std::size_t corner, const Pose& camera_from_body) const {
  const Eigen::Vector3d p = camera_from_body * corners_m[corner];
  if (!(p.z() > 1e-3)) return std::numeric_limits<double>::infinity();
  return px_per_ray * (p.head<2>() / p.z() - rays[corner]).norm();
}

TagObservation observe(const Intrinsics& camera, const Tag& tag, const MeasuredTag& measured,
                       bool bright_outside) {
  TagObservation seen;
  seen.corners_m = tag.corners_m;
  seen.outward = bright_outside ? 1 : -1;
  seen.quality = measured.quality;
  seen.saturated = measured.saturated;
  seen.area_px2 = area_of(measured.corners_px);
  seen.dark = seen.bright = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    seen.rays[i] = undistort(camera, measured.corners_px[i]);
    seen.edges[i] = observe_edge(camera, measured.edges[i]);
    seen.dark += measured.edges[i].dark / 4;
    seen.bright += measured.edges[i].bright / 4;
    seen.edges[i].start_m = tag.corners_m[i];
    seen.edges[i].end_m = tag.corners_m[(i + 1) % 4];
  }
  for (std::size_t i = 0; i < 2; ++i)
    seen.blur_px[i] =
        (measured.edges[i == 0 ? 1 : 0].blur_px + measured.edges[i == 0 ? 3 : 2].blur_px) / 2;
  seen.px_per_ray = std::sqrt(seen.area_px2 / area_of(seen.rays));
  return seen;
}

std::optional<BodyFit> solve_body(const std::vector<TagObservation>& all,
                                  const std::optional<Pose>& previous, const BiasPrior& prior) {
  if (all.empty()) return std::nullopt;
  std::vector<Start> from = starts(all, previous);
  if (from.empty()) return std::nullopt;
  std::vector<TagObservation> tags = all;
  BodyFit fit = fit_all(tags, from, previous, prior);
  const std::vector<TagObservation> kept = without_outliers(tags, fit);
  if (kept.size() < tags.size() && !kept.empty()) {
    tags = kept;
    from = starts(tags, previous);
    if (from.empty()) return std::nullopt;
    fit = fit_all(tags, from, previous, prior);
  }
  if (!(fit.rms_px < worst_rms_px) || !corners_fit(tags, fit.camera_from_body)) return std::nullopt;
  fit.n_tags = static_cast<int>(tags.size());
  fit.n_faces = count_faces(tags);
  fit.quality = pose_quality(tags, fit);
  return fit;
}

}  // namespace heft
