#include "tracking/BodyFinder.h"

#include <algorithm>

#include "base/Clock.h"
#include "tracking/pose/OwnTags.h"
#include "tracking/pose/RollingShutter.h"

namespace heft {

namespace {
using Corners = std::array<Eigen::Vector2d, 4>;

constexpr double least_expected_edge_px = 9;
constexpr double most_dense_rms_px = 0.5;  // of a tag that is aligned by its cells
constexpr double believed_variance = 2;    // of a pose by cells, relative to one by borders
constexpr double least_agreement =
    0.85;  // of the data cells of a tag that the detector did not read
// With so few tags, partly covered ones add much information on tilt and depth.
constexpr std::size_t few_tags = 3;

// Adds the duration of the work.
template <typename Work>
auto timed(double& sum_s, const Work& work) {
  const double start_s = monotonic_s();
  auto result = work();
  sum_s += monotonic_s() - start_s;
  return result;
}

// Seen from its front, with all corners well inside the picture and edges long enough to measure.
bool measurable(const Intrinsics& camera, const Corners& c) {
  constexpr double margin_px = 2;
  for (std::size_t i = 0; i < 4; ++i) {
    const bool inside = c[i].x() >= margin_px && c[i].y() >= margin_px &&
                        c[i].x() <= camera.width_px - 1 - margin_px &&
                        c[i].y() <= camera.height_px - 1 - margin_px;
    const Eigen::Vector2d edge = c[(i + 1) % 4] - c[i], next = c[(i + 2) % 4] - c[(i + 1) % 4];
    const double height = (edge.x() * next.y() - edge.y() * next.x()) / edge.norm();
    if (!inside || !(edge.norm() >= least_expected_edge_px) || !(height >= least_expected_edge_px))
      return false;
  }
  return true;
}

std::optional<Corners> projected(const Intrinsics& camera, const Tag& tag, const Pose& pose) {
  Corners corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = pose * tag.corners_m[i];
    if (!(p.z() > 0.01)) return std::nullopt;
    corners[i] = project(camera, p);
  }
  if (!measurable(camera, corners)) return std::nullopt;
  return corners;
}

double place_variance_m2(const BodyFit& fit) {
  return fit.covariance.bottomRightCorner<3, 3>().trace();
}

BiasPrior prior_for(const TrackerSettings& settings, BiasPrior prior) {
  if (!settings.remove_bias) return {0, 0};
  // The detector's corners are accurate to half a pixel, measured edges to a tenth.
  if (!settings.refine_edges) prior.sd_px *= 5;
  return prior;
}
}  // namespace

BodyFinder::BodyFinder(const Intrinsics& camera, const MarkerBody& body,
                       const TrackerSettings& settings, const EdgeMeasuring& how)
    : camera_(camera), body_(body), settings_(settings), how_(how), patterns_(patterns_of(body)) {}

Region BodyFinder::region_around(const Pose& camera_from_body) const {
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const Tag& tag : body_.tags)
    for (const Eigen::Vector3d& corner_m : tag.corners_m) {
      const Eigen::Vector3d p = camera_from_body * corner_m;
      if (!(p.z() > 0.01)) return {0, 0, camera_.width_px, camera_.height_px};
      const Eigen::Vector2d pixel = project(camera_, p);
      low = low.cwiseMin(pixel);
      high = high.cwiseMax(pixel);
    }
  const double margin = 0.05 * camera_.width_px + 0.15 * (high - low).maxCoeff();
  const auto bound = [&](double v) { return static_cast<int>(std::clamp(v, -1e6, 1e6)); };
  return {bound(low.x() - margin), bound(low.y() - margin), bound(high.x() - low.x() + 2 * margin),
          bound(high.y() - low.y() + 2 * margin)};
}

std::optional<BodyFit> BodyFinder::find(const Image& gray, const std::vector<DetectedTag>& detected,
                                        const Known& known, TrackerTimes& times) {
  const BiasPrior bias = prior_for(settings_, known.bias);
  std::vector<bool> done(body_.tags.size(), false);
  tone_ = {};
  const Measured measured =
      timed(times.refine_s, [&] { return measure_detected(gray, detected, done); });
  n_foreign_ = 0;
  auto fit = timed(times.pose_s, [&] { return fit_own(measured.clear, known, bias); });
  // Tags whose edges cannot be measured (a finger on them, no white margin) give a rough pose.
  if (!fit) fit = timed(times.pose_s, [&] { return fit_own(measured.rough, known, bias); });
  if (!fit || !settings_.refine_edges) return fit;
  return with_others(gray, *fit, done, bias, times);
}

std::optional<BodyFit> BodyFinder::fit_own(const std::vector<TagObservation>& tags,
                                           const Known& known, const BiasPrior& bias) {
  last_tags_ = own_tags(tags, known.expected, known.camera_from_table);
  const auto fit = solve_body(last_tags_, known.expected, bias);
  const bool is_own = fit && is_above(known.camera_from_table, fit->camera_from_body);
  n_foreign_ += static_cast<int>(is_own ? tags.size() - last_tags_.size() : tags.size());
  return is_own ? fit : std::nullopt;
}

std::optional<BodyFit> BodyFinder::with_others(const Image& gray, const BodyFit& fit,
                                               std::vector<bool>& done, const BiasPrior& bias,
                                               TrackerTimes& times) {
  const bool covered_too = last_tags_.size() < few_tags;
  const auto more = timed(times.refine_s, [&] {
    return measure_expected(gray, fit.camera_from_body, done, covered_too);
  });
  if (more.empty()) return fit;
  last_tags_.insert(last_tags_.end(), more.begin(), more.end());
  return timed(times.pose_s, [&] { return solve_body(last_tags_, fit.camera_from_body, bias); });
}

Eigen::Array2d BodyFinder::blur_px() const {
  Eigen::Array2d sum = Eigen::Array2d::Zero();
  for (const TagObservation& tag : last_tags_)
    sum += Eigen::Array2d(tag.blur_px[0], tag.blur_px[1]);
  return sum / static_cast<double>(std::max<std::size_t>(1, last_tags_.size()));
}

BodyFit BodyFinder::aligned(const Image& gray, const BodyFit& found, const BiasPrior& prior,
                            const std::optional<Smear>& smear, const std::optional<Velocity>& rolls,
                            TrackerTimes& times) const {
  if (!settings_.refine_edges || !settings_.inner_edges) return found;
  const Pose& start = found.camera_from_body;
  std::optional<RowsHeld> rows;
  if (rolls) rows.emplace(camera_, start, *rolls);
  std::vector<TagObservation> used;
  std::vector<DenseTag> tags;
  for (const TagObservation& tag :
       rolls ? held_still(last_tags_, camera_, start, *rolls) : last_tags_)
    if (tag_rms_px(tag, found) < most_dense_rms_px) used.push_back(tag);
  if (used.empty()) return found;
  for (const TagObservation& tag : used) tags.push_back({&tag, &patterns_[tag.tag]});
  return timed(times.pose_s, [&] {
    auto fit = align_densely(gray, camera_, tags, found, prior_for(settings_, prior), how_.curve,
                             how_.noise, smear, rows);
    // Cells may give a larger variance than borders: if they are half hidden, or because they model
    // uneven light, which borders ignore. A moderately larger one is accepted.
    if (!fit || place_variance_m2(*fit) > believed_variance * place_variance_m2(found))
      return found;
    // If cells and borders give different poses, one of them is wrong.
    for (const TagObservation& tag : used)
      for (const Eigen::Vector3d& corner_m : tag.corners_m)
        fit->spread_m2 = std::max(
            fit->spread_m2,
            (fit->camera_from_body * corner_m - found.camera_from_body * corner_m).squaredNorm());
    fit->quality = pose_quality(used, *fit);
    return *fit;
  });
}

BodyFit BodyFinder::solve_moving(const BodyFit& found, const Velocity& velocity,
                                 const BiasPrior& prior, TrackerTimes& times) const {
  const Pose& pose = found.camera_from_body;
  return timed(times.pose_s, [&] {
    return solve_body(held_still(last_tags_, camera_, pose, velocity), pose,
                      prior_for(settings_, prior))
        .value_or(found);
  });
}

std::optional<BodyFit> BodyFinder::find_again(const Image& gray, const Pose& expected,
                                              const Enough& enough, const BiasPrior& prior,
                                              TrackerTimes& times) {
  n_foreign_ = 0;
  const double blur_px = how_.blur_px;
  const auto fit = seen_again(gray, expected, enough, prior, times);
  if (fit && fit->quality >= enough.quality) return fit;
  how_.blur_px = blur_px;  // without knowledge of the blur
  return std::nullopt;
}

std::optional<BodyFit> BodyFinder::seen_again(const Image& gray, const Pose& expected,
                                              const Enough& enough, const BiasPrior& prior,
                                              TrackerTimes& times) {
  std::vector<bool> done(body_.tags.size(), false);
  tone_ = {};
  const std::span<const TagObservation> before =
      enough.still ? last_tags_ : std::span<TagObservation>();
  auto tags =
      timed(times.refine_s, [&] { return measure_expected(gray, expected, done, false, before); });
  if (static_cast<int>(tags.size()) < enough.tags) return std::nullopt;
  const BiasPrior bias = prior_for(settings_, prior);
  const auto fit = timed(times.pose_s, [&] { return solve_body(tags, expected, bias); });
  if (!fit || fit->n_tags < enough.tags) return std::nullopt;
  last_tags_ = std::move(tags);
  if (last_tags_.size() >= few_tags) return fit;
  return with_others(gray, *fit, done, bias, times);
}

BodyFinder::Measured BodyFinder::measure_detected(const Image& gray,
                                                  const std::vector<DetectedTag>& detected,
                                                  std::vector<bool>& done) {
  Measured tags;
  how_.whole = false;
  for (const DetectedTag& found : detected) {
    const auto tag = std::ranges::find(body_.tags, found.id, &Tag::id);
    if (tag == body_.tags.end()) continue;
    const auto index = static_cast<std::size_t>(tag - body_.tags.begin());
    if (!settings_.refine_edges) {
      tags.clear.push_back(unrefined(index, found.corners_px));
    } else {
      const auto seen = observed(index, measure(gray, index, found.corners_px));
      const bool good = seen.quality >= settings_.least_quality;
      (good ? tags.clear : tags.rough).push_back(seen);
      done[index] = done[index] || good;
    }
  }
  return tags;
}

std::vector<TagObservation> BodyFinder::measure_expected(const Image& gray,
                                                         const Pose& camera_from_body,
                                                         std::vector<bool>& done, bool covered_too,
                                                         std::span<const TagObservation> before) {
  std::vector<TagObservation> tags;
  how_.whole = !covered_too;
  for (std::size_t i = 0; i < body_.tags.size(); ++i) {
    if (done[i]) continue;
    const auto corners = projected(camera_, body_.tags[i], camera_from_body);
    if (!corners) continue;
    const auto last = std::ranges::find(before, i, &TagObservation::tag);
    const MeasuredTag measured =
        measure(gray, i, *corners, last == before.end() ? nullptr : &*last);
    if (measured.agreement < least_agreement) continue;
    const bool whole = measured.quality >= settings_.least_quality;
    if (!whole && !covered_too) continue;
    const auto seen = whole ? measured : without_covered_edges(measured, settings_.least_quality);
    if (!seen) continue;
    tags.push_back(observed(i, *seen));
    done[i] = true;
  }
  return tags;
}

MeasuredTag BodyFinder::measure(const Image& gray, std::size_t tag, const Corners& corners_px,
                                const TagObservation* before) {
  const bool again = before && before->quality >= settings_.least_quality && before->saturated == 0;
  const MeasuredTag seen = again ? measure_tag_again(gray, camera_, patterns_[tag], corners_px,
                                                     {before->blur_px[0], before->blur_px[1]}, how_)
                                 : measure_tag(gray, camera_, patterns_[tag], corners_px, how_);
  if (seen.quality < settings_.least_quality) return seen;
  for (const FittedEdge& edge : seen.edges) tone_.add(edge, patterns_[tag].bright_outside ? 1 : -1);
  // Clipped edges look more blurred than they are; learning from them would increase the blur
  // further.
  if (seen.saturated > 0) return seen;
  double sum = 0;
  for (const FittedEdge& edge : seen.edges) sum += edge.blur_px;
  constexpr double memory = 0.95;
  how_.blur_px = memory * how_.blur_px + (1 - memory) * sum / 4;
  return seen;
}

TagObservation BodyFinder::unrefined(std::size_t tag, const Corners& corners_px) const {
  return observed(tag, unrefined_tag(corners_px));
}

TagObservation BodyFinder::observed(std::size_t tag, const MeasuredTag& measured) const {
  TagObservation seen = observe(camera_, body_.tags[tag], measured, patterns_[tag].bright_outside);
  seen.tag = tag;
  return seen;
}

}  // namespace heft
