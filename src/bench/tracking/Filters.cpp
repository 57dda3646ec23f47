#include "bench/tracking/Filters.h"

#include <cmath>
#include <limits>

#include "base/Quantile.h"

namespace heft {

namespace {
constexpr double settle_s = 0.25;

void begin_stretch(std::vector<FilteredTake>& stretches, const Take& take) {
  stretches.push_back({&take, {}, {}, {}});
}

// Of the tip from where it was lag_s ago, squared, on average.
double mean_square_m2(const std::vector<FilteredTake>& takes, const Eigen::Vector3d& tip_m,
                      double lag_s) {
  double sum = 0, n = 0;
  for (const FilteredTake& one : takes)
    for (std::size_t i = 0; i < one.t_s.size(); ++i) {
      if (one.t_s[i] - one.t_s.front() < settle_s) continue;
      const Pose truth = one.take->at(one.t_s[i] - lag_s);
      sum += (one.poses[i] * tip_m - truth * tip_m).squaredNorm();
      ++n;
    }
  return n > 0 ? sum / n : std::numeric_limits<double>::quiet_NaN();
}

double lag_ms(const std::vector<FilteredTake>& takes, const Eigen::Vector3d& tip_m) {
  double best_ms = 0, best = std::numeric_limits<double>::infinity();
  for (double ms = -20; ms <= 200; ms += 0.25) {
    const double off = mean_square_m2(takes, tip_m, ms / 1e3);
    if (off < best) best = off, best_ms = ms;
  }
  return best_ms;
}

double p95_mm(const std::vector<FilteredTake>& takes, const Eigen::Vector3d& tip_m,
              double least_m_s) {
  std::vector<double> off_mm;
  for (const FilteredTake& one : takes)
    for (std::size_t i = 0; i < one.t_s.size(); ++i)
      if (one.take->speed_m_s(one.t_s[i]) >= least_m_s)
        off_mm.push_back(1e3 * (one.poses[i] * tip_m - one.take->at(one.t_s[i]) * tip_m).norm());
  return or_nan(quantile(off_mm, 0.95));
}
}  // namespace

std::vector<FilteredTake> filtered(const MethodFilm& film, const SmootherEntry& entry) {
  std::vector<FilteredTake> stretches;
  for (std::size_t take = 0; take < film.takes.size(); ++take) {
    std::unique_ptr<Smoother> filter;
    for (const Measured& picture : film.pictures[take]) {
      if (!picture.poses.board_from_effector) {
        filter.reset();
        continue;
      }
      if (!filter) {
        filter = entry.make();
        begin_stretch(stretches, film.takes[take]);
      }
      FilteredTake& now = stretches.back();
      now.t_s.push_back(picture.t_s);
      now.poses.push_back(
          filter->update(picture.t_s, *picture.poses.board_from_effector, picture.poses.quality));
      now.velocities.push_back(filter->velocity());
    }
  }
  return stretches;
}

std::optional<double> jitter_mm(const std::vector<FilteredTake>& holds,
                                const Eigen::Vector3d& tip_m) {
  double sum = 0, n = 0;
  for (const FilteredTake& hold : holds) {
    std::vector<Eigen::Vector3d> tips;
    for (std::size_t i = 0; i < hold.t_s.size(); ++i)
      if (hold.t_s[i] - hold.t_s.front() >= settle_s) tips.push_back(hold.poses[i] * tip_m);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const auto& tip : tips) mean += tip / static_cast<double>(tips.size());
    for (const auto& tip : tips) sum += (tip - mean).squaredNorm();
    n += static_cast<double>(tips.size());
  }
  if (n == 0) return std::nullopt;
  return 1e3 * std::sqrt(sum / n);
}

std::vector<FilterResult> study_filters(const Headline& headline, const StudyOptions& options) {
  const Eigen::Vector3d tip_m = tip_of(bench_apparatus(headline.width_px).effector);
  std::vector<FilterResult> results;
  CsvFile csv(options, "filters.csv", "filter,setting,jitter_mm,lag_ms,stroke_p95_mm,swipe_p95_mm");
  for (const SmootherEntry& filter : smoothers()) {
    const auto strokes = filtered(headline.strokes.ours, filter);
    const FilterResult result{filter.family,
                              filter.setting,
                              or_nan(jitter_mm(filtered(headline.holds.ours, filter), tip_m)),
                              lag_ms(strokes, tip_m),
                              p95_mm(strokes, tip_m, 0),
                              p95_mm(filtered(headline.swipes.ours, filter), tip_m, swiping_m_s)};
    csv.row(result.family, result.setting, result.jitter_mm, result.lag_ms, result.stroke_p95_mm,
            result.swipe_p95_mm);
    results.push_back(result);
  }
  draw(options, "filters", filter_chart(results, options));
  return results;
}

}  // namespace heft
