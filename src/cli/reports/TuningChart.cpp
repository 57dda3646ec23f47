// The chart of techniques over a range of masses.
#include <fmt/format.h>

#include "analysis/charts/Plot.h"
#include "cli/reports/Reports.h"

namespace heft::cli {

namespace {
std::string rows_of(const TunedTechnique& one) {
  std::string rows;
  for (const ThresholdAtMass& mass : one.masses)
    rows += mass.threshold_g
                ? fmt::format("{} {} {} {}\n", mass.mass_g, 100 * mass.ratio(),
                              100 * mass.low_g.value_or(*mass.threshold_g) / mass.mass_g,
                              100 * mass.high_g.value_or(*mass.threshold_g) / mass.mass_g)
                : "\n";
  return rows;
}
}  // namespace

void draw_tuning(const std::vector<TunedTechnique>& all, const TunedTechnique* best,
                 std::uint64_t seed, const std::string& file) {
  constexpr int width_px = 860, top_px = 60, plot_px = 380, bottom_px = 120;
  std::string data, terms;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_best = &all[i] == best;
    data += fmt::format("$t{} << END\n{}END\n", i, rows_of(all[i]));
    terms += fmt::format(
        "{}$t{} with yerrorlines linewidth {} linecolor '{}' dashtype {} pointtype {} title {}",
        i == 0 ? "" : ", ", i, is_best ? 4 : 1.5, is_best ? "#d55e00" : series_color(i),
        is_best ? 1 : series_dash(i), series_sign(i),
        gnuplot_quoted(all[i].technique.name + (is_best ? " (best)" : "")));
  }
  draw_svg(file, [&](const std::string& svg) {
    return gnuplot_header({svg, width_px, top_px + plot_px + bottom_px,
                           "How well techniques show masses",
                           fmt::format("75 % threshold of simulated people, all alike, in a forced "
                                       "choice, with 95 % intervals of the simulation; lower is "
                                       "better. Best: the smallest of the largest ratios. Made "
                                       "by: heft tune (seed {})",
                                       seed)}) +
           data + gnuplot_place(0.09, 0.72, top_px, top_px + plot_px) +
           "set key outside right top vertical samplen 2 font ',11'\n"
           "set xlabel 'mass of the reference (g)'\nset ylabel 'threshold / mass (%)'\n"
           "set logscale xy\nset autoscale yfixmin\nset offsets 0, 0, 0, graph 0.05\nplot " +
           terms + "\n";
  });
}

}  // namespace heft::cli
