#include "tracking/detection/EdgeFit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "tracking/detection/FitMath.h"
#include "tracking/detection/ToneCurve.h"

namespace heft {

namespace {
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
enum Unknown { offset, slope, dark, contrast, gain, blur };

constexpr double least_contrast = 20;  // gray levels between black and white
constexpr double least_light_contrast = 0.002;
constexpr double most_light = 3, saturated_light = 0.97, saturated_blur_sd_px = 0.01;
constexpr double least_seen_noise = 0.7, clipped_noise_ratio = 0.4;  // gray levels; of black's
constexpr double window_cells = 0.5, least_window_px = 1.0, most_window_px = 5;
constexpr double corner_px = 2,
                 most_corner_fraction = 0.2;  // left out, because two edges overlap there
constexpr int least_pixels = 12;
constexpr double within_noise_sd = 2.5;
constexpr double least_lonely_sd =
    3.6;  // from the window's end to the next cell, in SDs of the blur
constexpr double least_blur_px = 0.2, most_blur_px = 3.5;
constexpr double least_noise = 0.5;  // rounding to 8 bits alone gives 0.3

struct Sample {
  double along;    ///< u
  double outward;  ///< d, pixels
  double value;    ///< stored value
};

// The axes of the predicted edge.
struct EdgeAxes {
  Eigen::Vector2d start, direction, normal;
  double length, sag;

  explicit EdgeAxes(const EdgeGuess& guess)
      : start(guess.start_px),
        direction((guess.end_px - guess.start_px).normalized()),
        normal(direction.y(), -direction.x()),
        length((guess.end_px - guess.start_px).norm()),
        sag(guess.sag_px) {}

  double bend(double u) const { return sag * (1 - u * u); }
  Eigen::Vector2d at(double u, double outward) const {
    return start + direction * (length * (u + 1) / 2) + normal * (outward + bend(u));
  }
};

// Pixels in a band along the edge, by rows or by columns, whichever crosses it.
class Band {
 public:
  Band(const Image& gray, const EdgeAxes& axes, double half_width_px, int most_pixels)
      : gray_(gray), axes_(axes), half_width_px_(half_width_px) {
    const bool by_rows = std::abs(axes.direction.y()) > std::abs(axes.direction.x());
    major_ = by_rows ? 1 : 0;
    minor_ = 1 - major_;
    const double trim = std::min(corner_px, most_corner_fraction * axes.length);
    most_u_ = 1 - 2 * trim / axes.length;
    const double a = axes.at(-1, 0)(major_), b = axes.at(1, 0)(major_);
    const int first = std::max(0, static_cast<int>(std::floor(std::min(a, b))));
    const int last = std::min(major_ == 1 ? gray.height - 1 : gray.width - 1,
                              static_cast<int>(std::ceil(std::max(a, b))));
    const double reach = half_width_px / std::abs(axes.normal(minor_));
    const int stride = std::max(
        1, static_cast<int>(std::ceil((last - first) * 2 * reach / std::max(1, most_pixels))));
    for (int line = first; line <= last; line += stride) add_line(line, reach);
  }

  std::vector<Sample> samples;

 private:
  void add_line(int line, double reach) {
    const double progress = (line - axes_.start(major_)) / axes_.direction(major_);
    const double center = axes_.start(minor_) + progress * axes_.direction(minor_);
    const double margin = reach + std::abs(axes_.sag) + 1;
    const int size = minor_ == 0 ? gray_.width : gray_.height;
    const int first = std::max(0, static_cast<int>(std::floor(center - margin)));
    const int last = std::min(size - 1, static_cast<int>(std::ceil(center + margin)));
    for (int across = first; across <= last; ++across) {
      if (minor_ == 0)
        add_pixel(across, line);
      else
        add_pixel(line, across);
    }
  }

  void add_pixel(int x, int y) {
    const Eigen::Vector2d from_start = Eigen::Vector2d(x, y) - axes_.start;
    const double u = 2 * from_start.dot(axes_.direction) / axes_.length - 1;
    if (std::abs(u) > most_u_) return;
    const double d = from_start.dot(axes_.normal) - axes_.bend(u);
    if (std::abs(d) > half_width_px_) return;
    const auto at = static_cast<std::size_t>(y) * gray_.row_bytes() + static_cast<std::size_t>(x);
    samples.push_back({u, d, static_cast<double>(gray_.pixels[at])});
  }

  const Image& gray_;
  const EdgeAxes& axes_;
  double half_width_px_;
  double most_u_ = 1;
  int major_ = 0, minor_ = 1;
};

// Variation of the pixels of one side that are furthest from the edge, gray levels.
double plateau_noise(const std::vector<Sample>& samples, bool outside) {
  double furthest = 0;
  for (const Sample& sample : samples) furthest = std::max(furthest, std::abs(sample.outward));
  const auto is_plateau = [&](const Sample& sample) {
    return (sample.outward > 0) == outside && std::abs(sample.outward) > 0.6 * furthest;
  };
  double sum = 0, deviation = 0;
  int n = 0;
  for (const Sample& sample : samples)
    if (is_plateau(sample)) sum += sample.value, ++n;
  for (const Sample& sample : samples)
    if (is_plateau(sample)) deviation += std::abs(sample.value - sum / n);
  return deviation / std::max(1, n);
}

// White at the end of the scale may be clipped: it then lacks the noise that black has. Without any
// noise (a drawing) it is not.
bool is_clipped(const std::vector<Sample>& samples, bool bright_outside) {
  const double black_noise = plateau_noise(samples, !bright_outside);
  return black_noise > least_seen_noise &&
         plateau_noise(samples, bright_outside) < clipped_noise_ratio * black_noise;
}

// The step model on one band of pixels.
class StepFit {
 public:
  StepFit(const std::vector<Sample>& samples, const EdgeGuess& guess)
      : samples_(samples), guess_(guess), blur_sd_px_(guess.blur_sd_px) {
    // Light on both sides from pixels far from the edge.
    double light[2] = {0, 0}, weights[2] = {1e-9, 1e-9};
    for (const Sample& sample : samples) {
      const double weight = sample.outward * sample.outward;
      light[sample.outward > 0 ? 1 : 0] += weight * guess.curve.light(sample.value);
      weights[sample.outward > 0 ? 1 : 0] += weight;
    }
    const double inside = light[0] / weights[0], outside = light[1] / weights[1];
    unknowns << 0, 0, inside, outside - inside, 0, guess.blur_px;
    per_blur_ = 1 / guess.blur_px;
    saturated =
        std::max(inside, outside) > saturated_light && is_clipped(samples, outside > inside);
    // Above saturation one flank cannot determine light, blur and position together.
    if (saturated) blur_sd_px_ = saturated_blur_sd_px;
    most_light_ = saturated ? most_light : std::max({1.0, inside, outside});
    has_contrast =
        (guess.bright_outside ? outside - inside : inside - outside) > least_light_contrast;
  }

  // @return the largest displacement of an end of the edge, pixels
  double step(bool drop_outliers) {
    Matrix6 normal_matrix = prior();
    Vector6 rhs = Vector6::Zero();
    rhs(blur) = normal_matrix(blur, blur) * (guess_.blur_px - unknowns(blur));
    const double clip = 2.5 * noise, per_variance = 1 / (noise * noise);
    const double far = drop_outliers ? outlier_bound()
                                     : 1e9;  // excludes pixels where another object covers the edge
    double sum = 0;
    int n = 0;
    for (const Sample& sample : samples_) {
      Vector6 by;
      const double residual = sample.value - model(sample, by);
      const double size = std::abs(residual);
      if (size > far) continue;
      ++n;
      sum += size;
      const double weight = size > clip ? clip / size * per_variance : per_variance;
      const Vector6 weighted = weight * by;
      add_lower(normal_matrix, weighted, by);
      rhs += residual * weighted;
    }
    complete_upper(normal_matrix);
    noise = std::max(least_noise, 1.2533 * sum / std::max(1, n));
    const Vector6 change = normal_matrix.llt().solve(rhs);
    if (!change.allFinite()) return 1e9;
    unknowns += change;
    unknowns(blur) = std::clamp(unknowns(blur), least_blur_px, most_blur_px);
    per_blur_ = 1 / unknowns(blur);
    unknowns(contrast) = std::min(unknowns(contrast), most_light_ - unknowns(dark));
    information = normal_matrix;
    return std::abs(change(offset)) + std::abs(change(slope));
  }

  // Residuals without the parts that the fit's unknowns, and a symmetric but not normal blur,
  // explain: a lens's tails and a pixel's square shape affect stored values near black strongly.
  ToneEvidence tone_evidence() const {
    using Vector8 = Eigen::Matrix<double, 8, 1>;
    Eigen::Matrix<double, 8, 8> own = Eigen::Matrix<double, 8, 8>::Zero();
    own.topLeftCorner<6, 6>() = prior();
    own.diagonal().tail<2>().setConstant(1);
    Eigen::Matrix<double, 8, 3> mixed = Eigen::Matrix<double, 8, 3>::Zero();
    ToneEvidence evidence;
    Vector8 own_rhs = Vector8::Zero();
    const double clip = 2.5 * noise, far = outlier_bound();
    for (const Sample& sample : samples_) {
      Vector6 by_six;
      const double modeled = model(sample, by_six), residual = sample.value - modeled;
      const double size = std::abs(residual);
      if (size > far) continue;
      const double weight = (size > clip ? clip / size : 1) / (noise * noise);
      const ToneBend by_bend = guess_.curve.stored_by_bend(modeled);
      const double q =
          (sample.outward - unknowns(offset) - unknowns(slope) * sample.along) / unknowns(blur);
      // Hermite polynomials times the derivative by position: the effect of the next cumulants.
      const double q2 = q * q, step = -by_six(offset) * unknowns(blur);
      Vector8 by;
      by << by_six, step * q * (q2 - 3), step * q * ((q2 - 10) * q2 + 15);
      add_lower<8>(own, weight * by, by);
      own_rhs += weight * residual * by;
      mixed.noalias() += weight * by * by_bend.transpose();
      evidence.information.noalias() += weight * by_bend * by_bend.transpose();
      evidence.rhs += weight * residual * by_bend;
    }
    complete_upper(own);
    const Eigen::LLT<Eigen::Matrix<double, 8, 8>> solver(own);
    const Eigen::Matrix<double, 8, 3> by_bend = -solver.solve(mixed);
    evidence.information += mixed.transpose() * by_bend;
    evidence.rhs += by_bend.transpose() * own_rhs;
    evidence.outward = -own.topLeftCorner<6, 6>().llt().solve(mixed.topRows<6>()).row(offset);
    return evidence;
  }

  // Fraction of pixels that the model explains.
  double explained() const {
    const double bound = outlier_bound();
    int n = 0;
    Vector6 unused;
    for (const Sample& sample : samples_)
      if (std::abs(sample.value - model(sample, unused)) < bound) ++n;
    return static_cast<double>(n) / static_cast<double>(samples_.size());
  }

  double outlier_bound() const {
    return std::max({10.0, 0.12 * levels(), within_noise_sd * guess_.noise});
  }
  double inside_value() const { return guess_.curve.stored(unknowns(dark)).value; }
  double outside_value() const {
    return guess_.curve.stored(unknowns(dark) + unknowns(contrast)).value;
  }
  double levels() const { return std::abs(outside_value() - inside_value()); }

  Vector6 unknowns;
  Matrix6 information = Matrix6::Zero();
  double noise = 6;
  bool has_contrast = false, saturated = false;

 private:
  // Prior of the blur; the other parameters are damped.
  Matrix6 prior() const {
    Vector6 weights;
    weights << 1e-3, 1e-3, 1, 1, 100, 1 / (blur_sd_px_ * blur_sd_px_);
    return weights.asDiagonal();
  }

  double model(const Sample& sample, Vector6& by) const {
    const double u = sample.along;
    const double q = (sample.outward - unknowns(offset) - unknowns(slope) * u) * per_blur_;
    const Normal step = normal_at(q);
    const double light = unknowns(dark) + unknowns(contrast) * step.below;
    const double brighter = 1 + unknowns(gain) * u;
    const Stored stored = guess_.curve.stored(light * brighter);
    const double by_light = stored.by_light * brighter;
    const double by_shift = -by_light * unknowns(contrast) * step.density * per_blur_;
    by << by_shift, by_shift * u, by_light, by_light * step.below, stored.by_light * light * u,
        by_shift * q;
    return stored.value;
  }

  const std::vector<Sample>& samples_;
  const EdgeGuess& guess_;
  double blur_sd_px_, most_light_ = 1, per_blur_ = 1;
};

// Two points at which a straight line's errors are independent: at its best determined position,
// plus and minus the distance where offset and slope have the same weight.
// @param leak_px by how much the light of the tag's next cells may have moved the edge
void place_points(FittedEdge& edge, const EdgeAxes& axes, const StepFit& fit, double leak_px) {
  const Matrix6 covariance = fit.information.inverse();
  const double slope_variance = covariance(slope, slope);
  const double best_u = -covariance(offset, slope) / slope_variance;
  const double best_variance = covariance(offset, offset) - covariance(offset, slope) *
                                                                covariance(offset, slope) /
                                                                slope_variance;
  const double half = std::sqrt(best_variance / slope_variance);
  const auto on_edge = [&](double u) {
    return axes.at(u, fit.unknowns(offset) + fit.unknowns(slope) * u);
  };
  edge.points_px = {on_edge(best_u - half), on_edge(best_u + half)};
  edge.start_px = on_edge(-1);
  edge.end_px = on_edge(1);
  edge.sd_px = std::sqrt(2 * best_variance + leak_px * leak_px);
}

constexpr int most_steps = 6, most_bands = 3;
constexpr double settled_px = 0.004, recenter_px = 0.35;

double moved_px(const StepFit& fit) {
  return std::abs(fit.unknowns(offset)) + std::abs(fit.unknowns(slope));
}

// The amount of light from a cell's width away that blur brings into the outer half of the window.
double leak(double cell_px, double blur_px) {
  constexpr double cautious = 2;
  return cautious * blur_px * normal_at(-(1 - window_cells) * cell_px / blur_px).below;
}

FittedEdge described(const EdgeAxes& axes, const StepFit& fit, double cell_px,
                     bool needs_curve_evidence) {
  FittedEdge edge;
  place_points(edge, axes, fit, leak(cell_px, fit.unknowns(blur)));
  edge.dark = std::min(fit.inside_value(), fit.outside_value());
  edge.bright = std::max(fit.inside_value(), fit.outside_value());
  edge.blur_px = fit.unknowns(blur);
  edge.noise = fit.noise;
  edge.saturated = fit.saturated;
  const bool usable = fit.levels() >= least_contrast && std::isfinite(edge.sd_px);
  edge.quality = usable ? fit.explained() : 0;
  const bool alone = (1 - window_cells) * cell_px > least_lonely_sd * edge.blur_px;
  if (usable && needs_curve_evidence && alone && !edge.saturated) edge.tone = fit.tone_evidence();
  return edge;
}
}  // namespace

FittedEdge fit_edge(const Image& gray, const EdgeGuess& first_guess, int most_pixels) {
  EdgeGuess guess = first_guess;
  const double half_width_px =
      std::clamp(window_cells * guess.cell_px, least_window_px, most_window_px);
  const double furthest_px = std::max(1.0, window_cells * guess.cell_px);
  FittedEdge edge;
  for (int band_number = 0; band_number < most_bands; ++band_number) {
    const EdgeAxes axes(guess);
    if (!(axes.length >= 4)) return {};
    const Band band(gray, axes, half_width_px, most_pixels);
    if (band.samples.size() < least_pixels) return {};
    StepFit fit(band.samples, guess);
    if (!fit.has_contrast) return {};
    for (int i = 0; i < most_steps; ++i) {
      if (fit.step(i > 1) < settled_px && i > 1) break;
      if (!(moved_px(fit) < 2 * half_width_px)) return {};
    }
    edge = described(axes, fit, guess.cell_px, guess.needs_curve_evidence);
    const double from_start = std::max((edge.start_px - first_guess.start_px).norm(),
                                       (edge.end_px - first_guess.end_px).norm());
    if (!(from_start < 2 * furthest_px)) return {};
    if (moved_px(fit) < recenter_px) break;
    guess.start_px = edge.start_px;
    guess.end_px = edge.end_px;
    // The blur of a saturated edge is a guess, and must not reinforce itself.
    if (fit.saturated) continue;
    guess.blur_px = std::clamp(edge.blur_px, 0.5 * guess.blur_px, 2 * guess.blur_px);
  }
  return edge;
}

}  // namespace heft
