#include "analysis/charts/Charts.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/charts/ChartAxis.h"
#include "analysis/charts/Plot.h"
#include "analysis/display/Phrases.h"
#include "analysis/measures/Section.h"

namespace heft {

namespace {
constexpr int flow_width_px = 720, box_px = 46, step_px = 74, flow_top_px = 44;

std::string counted(const std::map<std::string, int>& reasons) {
  std::string text;
  for (const auto& [reason, n] : reasons)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, reason);
  return text;
}

// One step of the participant flow, with those who are lost after it.
struct FlowStep {
  std::string text, lost;
};

std::vector<FlowStep> steps_of(const ParticipantFlow& flow) {
  int n_excluded = 0;
  for (const auto& [reason, n] : flow.excluded) n_excluded += n;
  const int n_not_begun = flow.n_asked - flow.n_withdrawn - flow.n_declined - flow.n_started;
  std::string not_started;
  for (const auto& [n, what] : {std::pair{flow.n_withdrawn, "withdrew (data removed)"},
                                {flow.n_declined, "declined"},
                                {n_not_begun, "began no trial"}})
    if (n > 0) not_started += fmt::format("{}{} {}", not_started.empty() ? "" : ", ", n, what);
  const int n_unfinished = flow.n_started - flow.n_finished;
  return {{fmt::format("{} asked (with a session in the log)", flow.n_asked), not_started},
          {fmt::format("{} started", flow.n_started),
           n_unfinished > 0
               ? fmt::format("{} finished no session ({})", n_unfinished, counted(flow.unfinished))
               : ""},
          {fmt::format("{} finished a session", flow.n_finished),
           n_excluded > 0 ? fmt::format("{} excluded by the protocol's rules ({})", n_excluded,
                                        counted(flow.excluded))
                          : ""},
          {fmt::format("{} in the figures", flow.n_analyzed), ""}};
}

Chart flow_chart(const Summary& summary) {
  Chart chart{"participant_flow",
              titled("Participants, from the first page to the figures", summary), ""};
  chart.caption =
      "Numbers of participants; to the right those who were lost, and why. Participants who "
      "finished no session are in the figures all the same, unless the protocol declared "
      "otherwise. "
      "A log does not hold how many were planned.";
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

// Names the model in every chart, so that its figures are not taken for people's.
std::string who_of(const Summary& summary) {
  if (summary.data == "simulated") return "simulated participants";
  return summary.simulated() ? "persons and models mixed" : "these participants";
}

Chart published_chart(const Summary& summary) {
  const std::string who = who_of(summary);
  Chart chart{"beside_published", titled("Found beside published, 95 % intervals", summary), ""};
  chart.caption = fmt::format(
      "Filled circles: {}, mean with its interval over participants; open diamonds: the paper's "
      "means, with Student's t interval where it gives an SD (of 13 participants; the "
      "introduction's is exact), and without one where it gives none; no circle: too much is "
      "censored for a mean. The paper's JNDs are of staircases from above. Where in the paper each "
      "is from is in the CSV.",
      who);
  chart.csv = "beside_published.csv";
  std::map<std::string_view, std::vector<const StudyEstimate*>> by_unit;
  for (const StudyEstimate* one : published_among(summary.estimates)) {
    by_unit[one->measure->unit].push_back(one);
    if (one->value) chart.n = std::max(chart.n, one->n);
  }
  if (chart.n == 0) return chart;
  std::vector<PlotPanel> panels;
  std::size_t most = 0;
  for (const auto& [unit, figures] : by_unit) {
    std::string found, paper, tics;
    const auto line = [](std::optional<double> value, std::optional<double> low,
                         std::optional<double> high, double y) {
      if (!value) return std::string();
      return fmt::format("{} {} {} {}\n", *value, low.value_or(*value), high.value_or(*value), y);
    };
    AxisEnd end;
    for (std::size_t i = 0; i < figures.size(); ++i) {
      const StudyEstimate& one = *figures[i];
      end.add(one);
      const double y = -static_cast<double>(i);
      const auto ends = interval_of(*one.published);
      found += line(one.value, one.low, one.high, y + 0.14);
      paper += line(one.published->value, ends ? std::optional(ends->low) : std::nullopt,
                    ends ? std::optional(ends->high) : std::nullopt, y - 0.14);
      tics += fmt::format("{}{} {}", i == 0 ? "" : ", ",
                          gnuplot_quoted(std::string(one.published->what)), y);
    }
    PlotPanel& panel =
        panels.emplace_back(PlotPanel{unit == "g" ? "JND (g)" : "% of trials", "", {}});
    panel.axes = fmt::format("set yrange [{}:0.5]\nset xrange [0:{}]\nset ytics scale 0 ({})\n",
                             0.5 - static_cast<double>(figures.size()),
                             unit == "%" ? "100" : end.text(), tics);
    if (unit != "%" && end.cuts()) chart.caption += AxisEnd::caption;
    panel.add(found,
              "using 1:4:2:3 with xerrorbars pointtype 7 pointsize 0.9 linewidth 1.8 linecolor "
              "'#2f6fb0'",
              fmt::format("{} (n = {})", who, chart.n));
    panel.add(paper,
              fmt::format("using 1:4:2:3 with xerrorbars pointtype 12 pointsize 1.2 linewidth 1.4 "
                          "linecolor '{}'",
                          published_color),
              fmt::format("published (n = {})", published::n_participants));
    most = std::max(most, figures.size());
  }
  PlotFrame frame{560, 34 * static_cast<int>(most), 1, 230, 30, 84};
  frame.axes = "set grid xtics ytics linetype 1 linecolor '#e4e4e4'\n";
  put_script(chart, summary, frame, panels);
  return chart;
}
}  // namespace

std::string caption_of(const Summary& summary) {
  return fmt::format("Made by: {} (heft {})", summary.command, HEFT_VERSION);
}

std::vector<Chart> charts_of(const Summary& summary) {
  std::vector<std::pair<int, Chart>> charts;
  charts.emplace_back(0, flow_chart(summary));
  charts.emplace_back(15, tracks_chart(summary));
  for (Chart& chart : multiples_charts(summary)) charts.emplace_back(20, std::move(chart));
  charts.emplace_back(60, published_chart(summary));
  for (const auto& section : summary.sections) {
    const Estimates of_participants = section->of_participants(summary);
    for (const ChartSpec& spec : section->charts())
      charts.emplace_back(spec.importance, draw(spec, summary, of_participants));
  }
  std::erase_if(charts, [](const auto& chart) { return chart.second.script.empty(); });
  std::ranges::stable_sort(charts, {}, [](const auto& chart) { return chart.first; });
  std::vector<Chart> sorted;
  for (auto& [importance, chart] : charts) sorted.push_back(std::move(chart));
  return sorted;
}

}  // namespace heft
