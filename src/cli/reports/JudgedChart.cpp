// The chart of models that judged a log.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "analysis/charts/Plot.h"
#include "base/Error.h"
#include "cli/reports/Reports.h"

namespace heft::cli {

namespace {
constexpr int left_px = 72, group_px = 118, plot_px = 320, bottom_px = 112, key_line_px = 22;

// For gnuplot, on two lines.
std::string group_name(const GroupScores& group) {
  return fmt::format("{}.\"\\n\".{}", gnuplot_quoted(group.task),
                     gnuplot_quoted(group.reference_g ? fmt::format("{}, {:g} g", group.condition,
                                                                    *group.reference_g)
                                                      : group.condition));
}

// "x score low high own": beside one another in their group.
std::string rows_of(const std::vector<GroupScores>& groups, std::size_t model, double aside) {
  std::string rows;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const ModelScores& of = groups[i].models[model];
    const Interval interval =
        of.log_score.interval.value_or(Interval{of.log_score.value, of.log_score.value});
    rows += fmt::format("{} {} {} {} {}\n", static_cast<double>(i) + aside, of.log_score.value,
                        interval.low, interval.high, of.own_log_score.value);
  }
  return rows;
}

std::string script_of(const JudgedLog& log, const std::string& file) {
  const auto groups = scores_of(log.judgments.trials, log.names.size(), ScoreGroups::references);
  const int width_px = std::max(640, left_px + 40 + group_px * static_cast<int>(groups.size()));
  const int top_px = 46 + key_line_px * (static_cast<int>(log.names.size()) + 3) / 2;
  std::string script = gnuplot_header(
      {file, width_px, top_px + plot_px + bottom_px, "How well models predict the logged answers",
       fmt::format(
           "Mean log probability of the logged answer, with 95 % intervals over people; 0 "
           "is best. Bars: the score of each model on its own answers, which nothing "
           "exceeds but by luck. {} trials, {} draws each. Made by: heft replay --responder "
           "(seed {})",
           log.judgments.trials.size(), log.repeats, log.seed)});
  std::string tics, chance, terms;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    tics += fmt::format("{}{} {}", i == 0 ? "" : ", ", group_name(groups[i]), i);
    for (const double side : {-0.45, 0.45})
      chance += fmt::format("{} {} {}\n", static_cast<double>(i) + side, groups[i].chance.value,
                            groups[i].shares.value);
    chance += "\n";
  }
  script += fmt::format("$chance << END\n{}END\n", chance);
  for (std::size_t i = 0; i < log.names.size(); ++i) {
    const double aside =
        0.7 * ((static_cast<double>(i) + 0.5) / static_cast<double>(log.names.size()) - 0.5);
    script += fmt::format("$m{} << END\n{}END\n", i, rows_of(groups, i, aside));
    terms += fmt::format(
        ", $m{0} using 1:2:3:4 with yerrorbars pointtype {1} pointsize 0.9 linewidth 1.5 "
        "linecolor '{2}' title {3}, $m{0} using ($1-0.08):5:(0.16):(0) with vectors nohead "
        "linewidth 3 linecolor '{2}' notitle",
        i, series_sign(i), series_color(i), gnuplot_quoted(log.names[i]));
  }
  script += gnuplot_place(1.0 * left_px / width_px, 1 - 24.0 / width_px, top_px, top_px + plot_px);
  script += fmt::format(
      "set key at screen 0.5, screen 1-36*pixel center top horizontal maxcols 2 samplen 1.5\n"
      "set ylabel 'log score a trial'\nset yrange [*:0]\nset xrange [-0.6:{}]\n"
      "set xtics scale 0 ({}) font ',11'\n"
      "plot $chance using 1:2 with lines dashtype 3 linecolor '#999999' title 'chance', "
      "$chance using 1:3 with lines linecolor '#999999' title 'shares of the answers'{}\n",
      static_cast<double>(groups.size()) - 0.4, tics, terms);
  return script;
}

}  // namespace

void draw_judged(const JudgedLog& log, const std::string& file) {
  if (log.judgments.trials.empty()) throw Error("no trial was judged, so there is no chart");
  draw_svg(file, [&](const std::string& svg) { return script_of(log, svg); });
}

void draw_svg(const std::string& file,
              const std::function<std::string(const std::string& svg)>& script_of) {
  const std::filesystem::path svg = std::filesystem::absolute(file);
  const std::string script = svg.filename().string() + ".gp";
  const std::filesystem::path path = svg.parent_path() / script;
  if (!(std::ofstream(path) << script_of(svg.filename().string())).flush())
    throw Error(fmt::format("{} can't be written; does its folder exist?", file));
  if (!run_gnuplot(svg.parent_path().string(), script))
    throw Error(fmt::format("gnuplot is not installed; its script is {}", path.string()));
  std::filesystem::remove(path);
}

}  // namespace heft::cli
