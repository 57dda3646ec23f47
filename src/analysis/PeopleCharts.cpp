// Figures with a point for each participant or staircase, and what is measured by level, trial and
// mass.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "analysis/Charts.h"
#include "analysis/Gnuplot.h"
#include "analysis/TableParts.h"

namespace heft {

namespace {
// Series differ in sign and dash, not only in color.
constexpr std::array<int, 6> signs{7, 4, 9, 2, 6, 11};
constexpr std::array<std::string_view, 6> colors{"#2f6fb0", "#c0561f", "#3c8d5a",
                                                 "#7a5aa6", "#555555", "#222222"};

Chart start_chart(const Summary& summary) {
  Chart chart{"jnd_against_start", titled("JND against the start of its staircase", summary), ""};
  chart.caption =
      "The paper's JND of each finished staircase against the difference it began with; on the "
      "line a JND is its start. Arrows: known to lie above or below only.";
  chart.csv = "staircases.csv";
  constexpr std::array<std::pair<Censored, std::string_view>, 3> kinds{
      {{Censored::none, "exact"}, {Censored::above, "> this"}, {Censored::below, "< this"}}};
  constexpr std::array<int, 3> kind_signs{6, 8, 10};
  std::string blocks, plots;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    std::string rows;
    for (const StaircaseResult& result : summary.staircases)
      if (result.shown_g && result.censored == kinds.at(k).first) {
        rows += fmt::format("{} {}\n", result.start_g, *result.shown_g);
        chart.n += 1;
      }
    if (rows.empty()) continue;
    blocks += fmt::format("$k{} << END\n{}END\n", k, rows);
    plots += fmt::format("$k{} with points pointtype {} pointsize 0.7 linecolor '{}' title '{}', ",
                         k, kind_signs.at(k), colors.at(k), kinds.at(k).second);
  }
  if (plots.empty()) return chart;
  chart.script =
      framed(chart, summary, 460,
             "set xlabel 'start (g)'\nset ylabel 'JND (g)'\nset xrange [0:*]\n"
             "set yrange [0:*]\n") +
      blocks +
      fmt::format("plot {}x with lines dashtype 2 linecolor '#777777' title 'start'\n", plots);
  return chart;
}

Chart sorting_people_chart(const Summary& summary) {
  Chart chart{"sorting_by_participant",
              titled("Right sortings of each participant, C1 and C2", summary), ""};
  chart.caption =
      "Percentage of each participant's completed trials that were sorted rightly; a line joins "
      "the two conditions of one. \"I don't know\" is not right.";
  chart.csv = "sorting_by_participant.csv";
  std::string rows;
  for (const PersonSorting& person : summary.points.sorting) {
    if (!person.c1_percent || !person.c2_percent) continue;
    const double aside = 0.02 * (chart.n % 9 - 4);  // so that equal lines don't hide each other
    rows += fmt::format("{} {}\n{} {}\n\n", 1 + aside, *person.c1_percent, 2 + aside,
                        *person.c2_percent);
    chart.n += 1;
  }
  if (rows.empty()) return chart;
  chart.script = framed(chart, summary, 460,
                        "set xrange [0.6:2.4]\nset yrange [-3:103]\nset xtics ('C1 (coupled)' 1, "
                        "'C2 (decoupled)' 2)\nset ylabel '% of trials sorted rightly'\n") +
                 "$people << END\n" + rows +
                 "END\n"
                 "plot $people with lines linecolor '#9bb8d6' notitle, $people with points "
                 "pointtype 6 pointsize 0.7 linecolor '#2f6fb0' title 'participant', "
                 "100.0/6 with lines dashtype 2 linecolor '#222222' title 'chance (1/6)'\n";
  return chart;
}

Chart detection_chart(const Summary& summary) {
  Chart chart{"hits_and_false_alarms",
              titled("Differences seen where there was one, and where there was none", summary),
              ""};
  chart.caption =
      "Each participant's percentage of \"different\" in comparisons with a difference, against "
      "those without. On the line somebody says \"different\" whatever is shown.";
  chart.csv = "hits_and_false_alarms.csv";
  chart.n = static_cast<int>(summary.points.detection.size());
  if (chart.n == 0) return chart;
  std::string rows;
  for (const PersonDetection& person : summary.points.detection)
    rows += fmt::format("{} {}\n", person.false_alarms_percent, person.hits_percent);
  chart.script = framed(chart, summary, 460,
                        "set xrange [-3:103]\nset yrange [-3:103]\n"
                        "set xlabel '% \"different\" without a difference'\n"
                        "set ylabel '% \"different\" with one'\n") +
                 "$people << END\n" + rows +
                 "END\nplot $people with points pointtype 6 pointsize 0.9 linecolor '#2f6fb0' "
                 "title 'participant', x with lines dashtype 2 linecolor '#777777' notitle\n";
  return chart;
}

// Medians with quartiles, a series for each group.
void put_series(Chart& chart, const Summary& summary, const std::vector<Quartiles>& rows,
                std::string_view axes) {
  std::vector<std::string> groups;
  for (const Quartiles& row : rows)
    if (std::ranges::find(groups, row.group) == groups.end()) groups.push_back(row.group);
  if (groups.empty()) return;
  std::string blocks, plots;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    blocks += fmt::format("$g{} << END\n", g);
    for (const Quartiles& row : rows)
      if (row.group == groups[g])
        blocks += fmt::format("{} {} {} {}\n", row.at, row.median, row.lower_quartile,
                              row.upper_quartile);
    blocks += "END\n";
    plots += fmt::format(
        "{0}$g{1} using 1:2:3:4 with yerrorlines dashtype {2} pointtype {3} pointsize 0.8 "
        "linecolor '{4}' title {5}",
        g == 0 ? "" : ", ", g, g % 5 + 1, signs.at(g % signs.size()), colors.at(g % colors.size()),
        gnuplot_quoted(groups[g]));
  }
  chart.n = summary.n_participants;
  chart.script = framed(chart, summary, 460, axes) + blocks + "plot " + plots + "\n";
}

Chart lag_chart(const Summary& summary) {
  Chart chart{"lag_by_mass", titled("Lag seen, by mass", summary), ""};
  chart.caption =
      "Largest distance of the clone from the effector while it touched a cube, as displayed: "
      "median and quartiles over cubes and trials; beside it how far the hand went from where the "
      "touch began: a lag comes to about that and no more. Masses in five bands a decade.";
  chart.csv = "lag_by_mass.csv";
  put_series(chart, summary, summary.points.lag_by_mass,
             "set logscale x\nset xlabel 'mass (g)'\nset ylabel 'mm'\nset yrange [0:*]\n");
  return chart;
}

Chart times_chart(const Summary& summary) {
  Chart chart{"times_by_level", titled("Response time by difference", summary), ""};
  chart.caption =
      "From all cubes shown to the answer, without pauses and time out of view: median and "
      "quartiles of comparisons, by reference.";
  chart.csv = "times_by_level.csv";
  put_series(chart, summary, summary.points.times_by_level,
             "set xlabel 'difference (g)'\nset ylabel 'response time (s)'\nset yrange [0:*]\n");
  return chart;
}

Chart learning_chart(const Summary& summary) {
  Chart chart{"times_by_trial", titled("Response time over the trials", summary), ""};
  chart.caption = "The same by task, over tenths of each session's trials of that task.";
  chart.csv = "times_by_trial.csv";
  put_series(chart, summary, summary.points.times_by_trial,
             "set xlabel '% of the trials of a session'\nset ylabel 'response time (s)'\n"
             "set xrange [0:100]\nset yrange [0:*]\n");
  return chart;
}
}  // namespace

std::vector<Chart> people_charts(const Summary& summary) {
  return {start_chart(summary), sorting_people_chart(summary), detection_chart(summary),
          lag_chart(summary),   times_chart(summary),          learning_chart(summary)};
}

}  // namespace heft
