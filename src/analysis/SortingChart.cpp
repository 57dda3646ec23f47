// Sorting percentages per condition as bars with intervals, the paper's figures beside.
#include <fmt/format.h>

#include <array>
#include <map>
#include <span>
#include <utility>

#include "analysis/Charts.h"
#include "analysis/Gnuplot.h"
#include "analysis/Published.h"
#include "analysis/TableParts.h"

namespace heft {

namespace {
constexpr std::array<std::string_view, 2> condition_colors{"#8a8f98", "#2f6fb0"};

constexpr double bar_width = 0.62;

// One bar of the sorting chart.
struct Bar {
  double x = 0;
  std::string_view answer;
  const Proportion* proportion = nullptr;
};

std::array<Bar, 3> bars_of(const ConditionSorting& sorting, double first_x) {
  return {{{first_x, "correct", &sorting.correct},
           {first_x + 1, "incorrect", &sorting.incorrect},
           {first_x + 2, "I don't know", &sorting.none}}};
}

// x, mean, low, high, one line a bar.
std::string measured_block(std::string_view name, std::span<const Bar> bars) {
  std::string block = fmt::format("${} << END\n", name);
  for (const Bar& bar : bars)
    if (bar.proportion->mean_percent)
      block += fmt::format("{} {} {} {}\n", bar.x, *bar.proportion->mean_percent,
                           bar.proportion->interval_percent->low,
                           bar.proportion->interval_percent->high);
  return block + "END\n";
}

std::string published_block(std::span<const Bar> c1, std::span<const Bar> c2) {
  std::string block = "$published << END\n";
  for (std::span<const Bar> bars : {c1, c2})
    for (const Bar& bar : bars)
      if (bar.proportion->published_percent)
        block += fmt::format("{} {}\n", bar.x, *bar.proportion->published_percent);
  return block + "END\n";
}

// A short line across the bars of correct sortings.
std::string chance_block(const ConditionSorting& c1, const ConditionSorting& c2, const Bar& c1_bar,
                         const Bar& c2_bar) {
  std::string block = "$chance << END\n";
  for (const auto& [sorting, bar] : {std::pair(&c1, &c1_bar), std::pair(&c2, &c2_bar)})
    if (const auto percent = sorting->chance_percent())
      block += fmt::format("{} {}\n{} {}\n\n", bar->x - 0.55, *percent, bar->x + 0.55, *percent);
  return block + "END\n";
}

// "correct by chance (1/6)" where all trials have as many cubes.
std::string chance_title(const ConditionSorting& c1, const ConditionSorting& c2) {
  std::map<int, int> all = c1.n_trials_by_cubes;
  all.insert(c2.n_trials_by_cubes.begin(), c2.n_trials_by_cubes.end());
  const double n_orders = 100 / chance_percent(all.begin()->first);
  return all.size() > 1 ? "correct by chance"
                        : fmt::format("correct by chance (1/{:.0f})", n_orders);
}

std::string answer_tics(std::span<const Bar> c1, std::span<const Bar> c2) {
  std::string tics;
  for (std::span<const Bar> bars : {c1, c2})
    for (const Bar& bar : bars)
      tics += fmt::format("{}{} {}", tics.empty() ? "" : ", ", gnuplot_quoted(bar.answer), bar.x);
  return tics;
}

std::string bars_plot(std::string_view block, const ConditionSorting& sorting,
                      std::string_view meaning, std::string_view color) {
  if (sorting.n_trials == 0) return "";
  const std::string title =
      fmt::format("{}, {} (n = {})", sorting.condition, meaning, sorting.n_participants);
  return fmt::format(
      "${0} using 1:2 with boxes linecolor '{1}' fillstyle solid 0.75 noborder title {2}, "
      "${0} using 1:3:(0):($4-$3) with vectors heads size screen 0.005,90 linewidth 1.6 linecolor "
      "'#222222' notitle, ",
      block, color, gnuplot_quoted(title));
}

std::string published_plot(const ConditionSorting& c1, const ConditionSorting& c2) {
  if (!c1.correct.published_percent && !c2.correct.published_percent) return "";
  return fmt::format(
      "$published using ($1+{}):2 with points pointtype 13 pointsize 1.1 linecolor '{}' title "
      "'published (n = {})', ",
      bar_width / 2 + 0.1, published_color, published::n_participants);
}
}  // namespace

Chart sorting_chart(const Summary& summary) {
  Chart chart{"sorting", titled("Sorting: answers per condition, 95 % intervals", summary), ""};
  const ConditionSorting &c1 = summary.sorting.at(0), &c2 = summary.sorting.at(1);
  if (c1.n_trials + c2.n_trials == 0) return chart;
  chart.caption =
      "Percentage of completed trials, mean over participants with 95 % intervals over "
      "participants; diamonds: the paper's means. \"I don't know\" is an outcome of its own.";
  chart.n = summary.n_participants;
  chart.csv = "sorting.csv";
  const auto c1_bars = bars_of(c1, 1), c2_bars = bars_of(c2, 4.6);
  chart.script = gnuplot_header({"sorting.svg", 860, 540, chart.title, caption_of(summary)}) +
                 measured_block("c1", c1_bars) + measured_block("c2", c2_bars) +
                 published_block(c1_bars, c2_bars) + chance_block(c1, c2, c1_bars[0], c2_bars[0]) +
                 fmt::format(
                     "set key at screen 0.5, screen 1-40*pixel center top horizontal\n"
                     "set tmargin at screen 1-100*pixel\n"
                     "set bmargin at screen caption_top + 38*pixel\n"
                     "set boxwidth {}\n"
                     "set xrange [0.4:7.4]\nset yrange [0:100]\n"
                     "set ytics 20\n"
                     "set ylabel '% of trials, mean over participants'\n"
                     "set xtics scale 0 ({})\n"
                     "plot {}{}{}$chance using 1:2 with lines dashtype 2 linewidth 1.6 linecolor "
                     "'#222222' title '{}'\n",
                     bar_width, answer_tics(c1_bars, c2_bars),
                     bars_plot("c1", c1, "coupled", condition_colors[0]),
                     bars_plot("c2", c2, "decoupled", condition_colors[1]), published_plot(c1, c2),
                     chance_title(c1, c2));
  return chart;
}

}  // namespace heft
