// Who took part, how well they were tracked, and each one's own threshold.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/Charts.h"
#include "analysis/Gnuplot.h"
#include "analysis/TableParts.h"

namespace heft {

namespace {
constexpr int flow_width_px = 720, box_px = 46, step_px = 74, flow_top_px = 44;

std::string counted(const std::map<std::string, int>& reasons) {
  std::string text;
  for (const auto& [reason, n] : reasons)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, reason);
  return text;
}

// One step of the flow, and beside it who did not go on.
struct FlowStep {
  std::string text, lost;
};

std::vector<FlowStep> steps_of(const ParticipantFlow& flow) {
  int n_excluded = 0;
  for (const auto& [reason, n] : flow.excluded) n_excluded += n;
  const int n_not_begun = flow.n_asked - flow.n_declined - flow.n_started;
  std::string not_started;
  if (flow.n_declined > 0) not_started = fmt::format("{} declined", flow.n_declined);
  if (n_not_begun > 0)
    not_started += fmt::format("{}{} began no trial", not_started.empty() ? "" : ", ", n_not_begun);
  const int n_unfinished = flow.n_started - flow.n_finished;
  return {{fmt::format("{} asked (with a session in the log)", flow.n_asked), not_started},
          {fmt::format("{} started", flow.n_started),
           n_unfinished > 0
               ? fmt::format("{} finished no session ({})", n_unfinished, counted(flow.unfinished))
               : ""},
          {fmt::format("{} finished a session", flow.n_finished),
           n_excluded > 0 ? fmt::format("{} left out by the protocol's rules ({})", n_excluded,
                                        counted(flow.excluded))
                          : ""},
          {fmt::format("{} in the figures", flow.n_analyzed), ""}};
}

Chart flow_chart(const Summary& summary) {
  Chart chart{"participant_flow",
              titled("Participants, from the first page to the figures", summary), ""};
  chart.caption =
      "Numbers of participants; to the right who did not go on, and why. Who finished no session "
      "is in the figures all the same, unless the protocol declared otherwise. A log does not tell "
      "how many were planned.";
  chart.csv = "participant_flow.csv";
  chart.n = summary.flow.n_asked;
  if (chart.n == 0) return chart;
  const std::vector<FlowStep> steps = steps_of(summary.flow);
  const int height_px = flow_top_px + step_px * static_cast<int>(steps.size()) + 40;
  std::string script = gnuplot_header(
      {chart.name + ".svg", flow_width_px, height_px, chart.title, caption_of(summary)});
  script += "unset border\nunset tics\nunset grid\nunset key\n";
  const auto y = [&](double px) { return 1 - px / height_px; };
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double top = flow_top_px + step_px * static_cast<double>(i), middle = top + box_px / 2.0;
    script += fmt::format(
        "set object {} rectangle from screen 0.04,screen {:.4f} to screen 0.5,screen {:.4f} "
        "fillstyle empty border linecolor '#333333'\n"
        "set label {} at screen 0.27,screen {:.4f} center font ',13'\n",
        i + 1, y(top), y(top + box_px), gnuplot_quoted(steps[i].text), y(middle));
    if (i + 1 < steps.size())
      script += fmt::format(
          "set arrow from screen 0.27,screen {:.4f} to screen 0.27,screen {:.4f} linecolor "
          "'#333333'\n",
          y(top + box_px), y(top + step_px));
    if (!steps[i].lost.empty()) {
      const double between = top + (box_px + step_px) / 2.0;
      script += fmt::format(
          "set arrow from screen 0.27,screen {0:.4f} to screen 0.54,screen {0:.4f} linecolor "
          "'#777777' dashtype 2\nset label {1} at screen 0.55,screen {0:.4f} left font ',11' "
          "textcolor '#555555'\n",
          y(between), gnuplot_quoted(steps[i].lost));
    }
  }
  chart.script = script + "set xrange [0:1]\nset yrange [0:1]\nplot NaN notitle\n";
  return chart;
}

Chart tracking_chart(const Summary& summary) {
  Chart chart{"tracking_quality",
              titled("How well each participant's effector was tracked", summary), ""};
  chart.caption =
      "A column for each participant, from the worst tracked on: percentage of displayed frames "
      "with the effector tracked (where no frames were kept, of the time until the answer), and "
      "how often it went out of sight a session.";
  chart.csv = "tracking_quality.csv";
  struct Point {
    double percent, n_lost;
  };
  std::vector<Point> points;
  for (const PersonTracking& person : summary.tracking) {
    const auto percent =
        person.tracked_percent() ? person.tracked_percent() : person.in_view_percent();
    if (percent) points.push_back({*percent, static_cast<double>(person.counts.n_lost)});
  }
  chart.n = static_cast<int>(points.size());
  if (points.empty()) return chart;
  std::ranges::stable_sort(points, {}, &Point::percent);
  std::string rows;
  for (std::size_t i = 0; i < points.size(); ++i)
    rows += fmt::format("{} {} {}\n", i + 1, points[i].percent, points[i].n_lost);
  const double least = std::max(0.0, std::floor(points.front().percent / 5) * 5 - 5);
  const double most_lost = 1.1 * std::max(5.0, std::ranges::max(points, {}, &Point::n_lost).n_lost);
  chart.script =
      framed(
          chart, summary, 440,
          fmt::format("set xrange [0:{}]\nset yrange [{}:101]\nset y2range [0:{}]\nset y2tics\nset "
                      "border 11\nset xlabel 'participant, worst first'\nset ylabel '% "
                      "tracked'\nset y2label 'times out of sight'\n",
                      points.size() + 1, least, most_lost)) +
      "$people << END\n" + rows +
      "END\nplot $people using 1:2 with points pointtype 7 pointsize 0.7 linecolor '#2f6fb0' title "
      "'% tracked', $people using 1:3 axes x1y2 with points pointtype 2 pointsize 0.7 linecolor "
      "'#c0561f' title 'times out of sight (right axis)'\n";
  return chart;
}

// The people of one reference, side by side.
struct ThresholdGroup {
  std::string name;
  std::string thresholds, from_above, from_below, starts;
  int n = 0, n_identifiable = 0, from = 0;
};

// What gnuplot's double quotes would take for more than a letter.
std::string in_double_quotes(std::string text) {
  std::erase_if(text, [](char c) { return c == '"' || c == '\\' || c == '`' || c == '\n'; });
  return text;
}

// Above 0 alone: the axis is logarithmic.
void add_started(std::string& jnds, std::string& starts, int x, const StartedFigure& figure) {
  if (figure.jnd && figure.jnd->value > 0) jnds += fmt::format("{} {}\n", x, figure.jnd->value);
  if (figure.start_g && *figure.start_g > 0) starts += fmt::format("{} {}\n", x, *figure.start_g);
}

std::vector<ThresholdGroup> groups_of(const Summary& summary) {
  std::map<Compared, std::vector<const PersonThreshold*>> people;
  for (const PersonThreshold& person : summary.thresholds)
    people[person.compared].push_back(&person);
  std::vector<ThresholdGroup> groups;
  int x = 0;
  for (auto& [compared, theirs] : people) {
    std::ranges::stable_sort(
        theirs, {}, [](const PersonThreshold* one) { return one->threshold_75_g.value_or(1e9); });
    ThresholdGroup group;
    group.from = x;
    group.n = static_cast<int>(theirs.size());
    for (const PersonThreshold* person : theirs) {
      x += 1;
      if (person->threshold_75_g) {
        group.n_identifiable += 1;
        group.thresholds +=
            fmt::format("{} {} {} {}\n", x, *person->threshold_75_g,
                        std::max(person->interval_g->low, 0.1), person->interval_g->high);
      }
      add_started(group.from_above, group.starts, x, person->from_above);
      add_started(group.from_below, group.starts, x, person->from_below);
    }
    group.name =
        fmt::format("{:g} g, {}\\n{} of {} not identifiable", compared.reference_g,
                    in_double_quotes(compared.condition), group.n - group.n_identifiable, group.n);
    groups.push_back(std::move(group));
    x += 2;
  }
  return groups;
}

Chart thresholds_chart(const Summary& summary) {
  Chart chart{"thresholds_by_participant",
              titled("Each participant's threshold, the paper's JND and its start", summary), ""};
  chart.caption =
      "A column for each participant and reference, ordered by threshold: the difference told "
      "rightly in 75 % with its likelihood interval, where their trials bear one; the paper's JND "
      "of their staircases from above and from below apart (censored ones at what they lie "
      "beyond); where these began.";
  chart.csv = "thresholds_by_participant.csv";
  const std::vector<ThresholdGroup> groups = groups_of(summary);
  std::string thresholds, from_above, from_below, starts, tics;
  int end = 0;
  for (const ThresholdGroup& group : groups) {
    thresholds += group.thresholds;
    from_above += group.from_above;
    from_below += group.from_below;
    starts += group.starts;
    tics += fmt::format("{}\"{}\" {}", tics.empty() ? "" : ", ", group.name,
                        group.from + (group.n + 1) / 2.0);
    chart.n = std::max(chart.n, group.n);
    end = group.from + group.n;
  }
  if (thresholds.empty() && from_above.empty() && from_below.empty()) return chart;
  std::string blocks, plots;
  const auto add = [&](const char* name, const std::string& rows, const std::string& how) {
    if (rows.empty()) return;
    blocks += fmt::format("${} << END\n{}END\n", name, rows);
    plots += fmt::format("{}${} {}", plots.empty() ? "" : ", ", name, how);
  };
  add("thresholds", thresholds,
      "using 1:2:3:4 with yerrorbars pointtype 7 pointsize 0.6 linecolor '#2f6fb0' title "
      "'threshold'");
  add("above", from_above,
      "with points pointtype 10 pointsize 0.8 linecolor '#c0561f' title 'JND from above'");
  add("below", from_below,
      "with points pointtype 8 pointsize 0.8 linecolor '#7a5aa6' title 'JND from below'");
  add("starts", starts, "with points pointtype 1 pointsize 0.5 linecolor '#777777' title 'start'");
  chart.script = framed(chart, summary, 440,
                        fmt::format("set logscale y\nset ylabel 'difference (g)'\nset xrange "
                                    "[0:{}]\nset xtics ({}) scale 0\n",
                                    end + 1, tics)) +
                 blocks + "plot " + plots + "\n";
  return chart;
}
}  // namespace

Chart participant_flow_chart(const Summary& summary) {
  return flow_chart(summary);
}

std::vector<Chart> person_charts(const Summary& summary) {
  return {thresholds_chart(summary), tracking_chart(summary)};
}

}  // namespace heft
