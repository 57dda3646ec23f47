#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "analysis/charts/Plot.h"
#include "base/math/Quantiles.h"
#include "results/tracking/TrackingStudy.h"

namespace heft {

namespace {
constexpr double settle_s = 0.25;

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

constexpr int chart_width_px = 900, chart_height_px = 560;
const std::map<std::string, std::string_view> colors{{"none", "#555555"},
                                                     {"heft", "#1f5fa8"},
                                                     {"exponential", "#b8860b"},
                                                     {"One-Euro", "#c0561f"},
                                                     {"Kalman", "#3c8d5a"}};
std::string filter_chart(const std::vector<FilterResult>& results, const StudyOptions& options) {
  const std::string caption = fmt::format(
      "Poses that our tracker measured at 30 pictures a second and 640x480 pixels, then filtered. "
      "Jitter: RMS distance of the effector's tip from its mean while it is held still. Lag: the "
      "delay that explains strokes of 0.4 m/s best. Over video, lag pulls the clone off the filmed "
      "effector and feels like mass. {}",
      provenance(options));
  std::string script = gnuplot_header({"filters.svg", chart_width_px, chart_height_px,
                                       "What filters take away and what they cost", caption});
  std::string plots;
  for (const auto& [family, color] : colors) {
    std::string block;
    for (const FilterResult& result : results)
      if (result.filter.family == family)
        block +=
            fmt::format("{} {} \"{}\"\n", result.lag_ms, result.jitter_mm, result.filter.name());
    const std::string name = family == "One-Euro" ? "one_euro" : family;
    script += fmt::format("${} << END\n{}END\n", name, block);
    plots += fmt::format(
        "{}${} using 1:2 with linespoints pointtype 7 pointsize {} linewidth 1 linecolor '{}' "
        "notitle, ${} using 1:2:3 with labels {} font ',11' textcolor '{}' "
        "notitle",
        plots.empty() ? "" : ", \\\n", name, family == "heft" ? 1.6 : 1.0, color, name,
        family == "none" ? "right offset -1.2,0" : "left offset 1.2,0.3", color);
  }
  script +=
      "set tmargin at screen 1-50*pixel\nset bmargin at screen caption_top + 76*pixel\n"
      "set lmargin 11\nset rmargin 24\nset xrange [-12:*]\nset yrange [0:*]\nset grid xtics\n"
      "set xlabel 'lag while moving (ms)'\nset ylabel 'jitter at rest (mm, RMS)'\n";
  return script + "plot " + plots + '\n';
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
        stretches.push_back({&film.takes[take], {}, {}, {}});
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

std::vector<FilterResult> study_filters(const GoalFilms& goal_films, const StudyOptions& options) {
  const Eigen::Vector3d tip_m = tip_of(bench_apparatus(goal_films.width_px).effector);
  std::vector<FilterResult> results;
  CsvFile csv(options, "filters.csv", "filter,setting,jitter_mm,lag_ms,stroke_p95_mm,swipe_p95_mm");
  for (const SmootherEntry& filter : smoothers()) {
    const auto strokes = filtered(goal_films.strokes.ours, filter);
    const FilterResult result{filter,
                              or_nan(jitter_mm(filtered(goal_films.holds.ours, filter), tip_m)),
                              lag_ms(strokes, tip_m), p95_mm(strokes, tip_m, 0),
                              p95_mm(filtered(goal_films.swipes.ours, filter), tip_m, swiping_m_s)};
    csv.row(filter.family, filter.setting, result.jitter_mm, result.lag_ms, result.stroke_p95_mm,
            result.swipe_p95_mm);
    results.push_back(result);
  }
  draw(options, "filters", filter_chart(results, options));
  return results;
}

}  // namespace heft
