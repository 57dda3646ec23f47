// What was chosen by difference, a panel for each reference: right, wrong, no difference, and what
// the indecision model makes of them.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "analysis/Charts.h"
#include "analysis/Gnuplot.h"
#include "analysis/TableParts.h"

namespace heft {

namespace {
constexpr int panel_px = 330, height_px = 470;

std::string block_of(std::string_view name, std::span<const ChoiceBin* const> bins,
                     Rate ChoiceBin::*rate) {
  std::string block = fmt::format("${} << END\n", name);
  for (const ChoiceBin* bin : bins) {
    const Rate& found = bin->*rate;
    if (found.percent)
      block += fmt::format("{} {} {} {}\n", bin->mean_level_g, *found.percent,
                           found.interval_percent->low, found.interval_percent->high);
  }
  return block + "END\n";
}

// A line a participant, of how often they chose the heavier cube; gnuplot begins anew after a gap.
std::string lines_block(std::string_view name, std::span<const ChoiceBin* const> bins) {
  std::map<std::string, std::string> lines;
  for (const ChoiceBin* bin : bins)
    for (const auto& [participant, percent] : bin->right_percent_of)
      lines[participant] += fmt::format("{} {}\n", bin->mean_level_g, percent);
  std::string block = fmt::format("${} << END\n", name);
  for (const auto& [participant, line] : lines) block += line + '\n';
  return block + (lines.empty() ? "NaN NaN\nEND\n" : "END\n");
}

// The model of a participant in the middle, without side bias.
std::string curves_of(const PooledSensitivity& pooled) {
  if (!pooled.identifiable() || !pooled.indecision) return "";
  const double s = *pooled.sensitivity, t = *pooled.indecision;
  const auto share = [](std::string_view z) {
    return fmt::format("100*({0}/3 + (1-{0})*norm({1}))", fixed_lapse, z);
  };
  const std::string right = share(fmt::format("{}*x-{}", s, t));
  const std::string wrong = share(fmt::format("-{}*x-{}", s, t));
  return fmt::format(
      ", {0} with lines dashtype 1 linecolor '#2f6fb0' notitle, {1} with lines dashtype 2 "
      "linecolor '#c0561f' notitle, 100-({0})-({1}) with lines dashtype 4 linecolor '#555555' "
      "notitle",
      right, wrong);
}

std::string panel_script(const ReferenceSensitivity& row, std::span<const ChoiceBin* const> bins,
                         std::size_t index, int width_px) {
  const std::string prefix = fmt::format("c{}", index);
  const double left_px = 100 + static_cast<double>(index) * panel_px;
  const PooledSensitivity& pooled = row.pooled;
  const std::string found = pooled.identifiable()
                                ? fmt::format("75 % at {:.0f} g", *pooled.threshold_75_g)
                                : std::string("no threshold");
  return block_of(prefix + "r", bins, &ChoiceBin::right) +
         block_of(prefix + "w", bins, &ChoiceBin::wrong) +
         block_of(prefix + "n", bins, &ChoiceBin::none) + lines_block(prefix + "i", bins) +
         fmt::format(
             "set lmargin at screen {0:.4f}\nset rmargin at screen {1:.4f}\n"
             "set title {2} offset 0,-0.6\n"
             "plot ${3}i using 1:2 with lines linewidth 0.6 linecolor '#b9cde3' notitle, "
             "${3}r using 1:2:3:4 with yerrorbars pointtype 7 pointsize 0.7 linecolor "
             "'#2f6fb0' notitle, "
             "${3}w using 1:2:3:4 with yerrorbars pointtype 2 pointsize 0.8 linecolor '#c0561f' "
             "notitle, "
             "${3}n using 1:2:3:4 with yerrorbars pointtype 4 pointsize 0.7 linecolor '#555555' "
             "notitle{4}\nunset label\nunset ylabel\nset format y ''\n",
             left_px / width_px, (left_px + panel_px - 25) / width_px,
             gnuplot_quoted(fmt::format("{:g} g, {}: {}", row.compared.reference_g,
                                        row.compared.condition, found)),
             prefix, curves_of(pooled));
}
}  // namespace

Chart choice_chart(const Summary& summary) {
  Chart chart{"choice_curves", titled("What was chosen, by difference", summary), ""};
  if (summary.sensitivity.empty() || summary.points.choices.empty()) return chart;
  const int width_px = std::max(620, 115 + panel_px * static_cast<int>(summary.sensitivity.size()));
  chart.caption =
      "Percentage of trials in which the heavier cube, the lighter cube or neither was chosen; "
      "trials of all participants in bins of about as many, those without a difference apart, "
      "with 95 % intervals over participants. Thin lines: how often each participant chose the "
      "heavier cube in those bins (not drawn of more than 60). Curves: indecision model of the "
      "median participant, "
      "where the data bear one.";
  chart.n = summary.n_participants;
  chart.csv = "choice_curves.csv";
  chart.script =
      gnuplot_header({"choice_curves.svg", width_px, height_px, chart.title, caption_of(summary)}) +
      "set label 'circle: the heavier cube was chosen; cross: the lighter one; square: no "
      "difference' "
      "at screen 0.5, screen 1-46*pixel center font ',11' textcolor '#555555'\n"
      "set multiplot\nunset key\nset tmargin at screen 1-90*pixel\n"
      "set bmargin at screen caption_top + 66*pixel\n"
      "set xrange [0:*]\nset yrange [0:100]\nset samples 200\n"
      "set xlabel 'difference (g)'\nset ylabel '% of trials'\n";
  for (std::size_t i = 0; i < summary.sensitivity.size(); ++i) {
    std::vector<const ChoiceBin*> bins;
    for (const ChoiceBin& bin : summary.points.choices)
      if (bin.compared == summary.sensitivity[i].compared) bins.push_back(&bin);
    chart.script += panel_script(summary.sensitivity[i], bins, i, width_px);
  }
  chart.script += "unset multiplot\n";
  return chart;
}

}  // namespace heft
