// What was found beside what the paper says, figure by figure: percentages and JNDs, as a chart and
// as a table.
#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "analysis/Charts.h"
#include "analysis/Gnuplot.h"
#include "analysis/Published.h"
#include "analysis/PublishedBeside.h"
#include "analysis/TableParts.h"

namespace heft {

namespace {
constexpr int width_px = 860, row_px = 34, panel_gap_px = 78, top_px = 84;

// A line a figure, from the top: x, its interval, y.
std::string line(double value, const std::optional<Interval>& interval, double y) {
  const Interval ends = interval.value_or(Interval{value, value});
  return fmt::format("{} {} {} {}\n", value, ends.low, ends.high, y);
}

struct Panel {
  std::string name, axis;
  std::vector<const PublishedFigure*> figures;

  int height_px() const { return row_px * static_cast<int>(figures.size()); }
};

std::vector<Panel> panels_of(std::span<const PublishedFigure> figures) {
  std::vector<Panel> panels{{"percent", "% of trials; introduction: of participants", {}},
                            {"jnd", "JND (g)", {}}};
  for (const PublishedFigure& figure : figures)
    panels[figure.unit == "%" ? 0 : 1].figures.push_back(&figure);
  std::erase_if(panels, [](const Panel& panel) { return panel.figures.empty(); });
  return panels;
}

std::string panel_script(const Panel& panel, int panel_top_px, std::string_view found_title,
                         bool with_key) {
  std::string found, published, tics;
  for (std::size_t i = 0; i < panel.figures.size(); ++i) {
    const PublishedFigure& figure = *panel.figures[i];
    const double y = -static_cast<double>(i);
    if (figure.found) found += line(*figure.found, figure.found_interval, y + 0.14);
    published += line(figure.published, figure.published_interval, y - 0.14);
    tics += fmt::format("{}{} {}", i == 0 ? "" : ", ", gnuplot_quoted(figure.what), y);
  }
  const auto title = [&](std::string_view text) {
    return with_key ? "title " + gnuplot_quoted(text) : "notitle";
  };
  std::string script = fmt::format("${0}_found << END\n{1}END\n${0}_published << END\n{2}END\n",
                                   panel.name, found, published);
  script += gnuplot_place(0.27, 0.96, panel_top_px, panel_top_px + panel.height_px());
  script +=
      with_key ? "set key at screen 0.5, screen 1-40*pixel center top horizontal\n" : "unset key\n";
  script += fmt::format(
      "set yrange [{}:0.5]\nset xrange [0:{}]\nset ytics scale 0 ({})\nset xlabel {}\nplot ",
      0.5 - static_cast<double>(panel.figures.size()), panel.name == "percent" ? "100" : "*", tics,
      gnuplot_quoted(panel.axis));
  if (!found.empty())
    script += fmt::format(
        "${}_found using 1:4:2:3 with xerrorbars pointtype 7 pointsize 0.9 linewidth 1.8 "
        "linecolor '#2f6fb0' {}, ",
        panel.name, title(found_title));
  return script + fmt::format(
                      "${}_published using 1:4:2:3 with xerrorbars pointtype 12 pointsize 1.2 "
                      "linewidth 1.4 linecolor '{}' {}\n",
                      panel.name, published_color,
                      title(fmt::format("published (n = {})", published::n_participants)));
}

// Who answered: a model's figures must not pass for people's.
std::string who_of(const Summary& summary) {
  if (summary.data == "simulated") return "simulated participants";
  return summary.simulated() ? "persons and models mixed" : "these participants";
}
}  // namespace

Chart published_chart(const Summary& summary) {
  const std::string who = who_of(summary);
  Chart chart{"beside_published", titled("Found beside published, 95 % intervals", summary), ""};
  const std::vector<PublishedFigure> figures = published_beside(summary);
  const auto is_found = [](const PublishedFigure& figure) { return figure.found.has_value(); };
  if (std::ranges::none_of(figures, is_found)) return chart;
  chart.caption = fmt::format(
      "Filled circles: {}, mean with its interval over participants; open diamonds: the paper's "
      "means, with Student's t interval where it gives an SD (of 13 participants; the "
      "introduction's is exact), and without one where it gives none; no circle: too much is cut "
      "short for a mean. The paper's JNDs are of "
      "staircases from above. Where in the paper each stands is in the CSV.",
      who);
  chart.n = std::ranges::max(figures, {}, &PublishedFigure::n).n;
  chart.csv = "beside_published.csv";
  const std::vector<Panel> panels = panels_of(figures);
  int height_px = top_px + 20;
  for (const Panel& panel : panels) height_px += panel.height_px() + panel_gap_px;
  chart.script = gnuplot_header({"beside_published.svg", width_px, height_px, chart.title,
                                 caption_of(summary)}) +
                 "set multiplot\nset grid xtics ytics linetype 1 linecolor '#e4e4e4'\n";
  int y_px = top_px;
  for (const Panel& panel : panels) {
    chart.script += panel_script(panel, y_px, fmt::format("{} (n = {})", who, chart.n),
                                 &panel == &panels.front());
    chart.script += "unset label\n";
    y_px += panel.height_px() + panel_gap_px;
  }
  chart.script += "unset multiplot\n";
  return chart;
}

Table published_table(const Summary& summary) {
  Table table{
      "beside_published",
      titled("Found beside published", summary),
      {{"figure", "figure"},
       {"unit", "unit"},
       {"found", "found"},
       {"found_sd", "SD"},
       {"found_low", "95 % low"},
       {"found_high", "high"},
       {"n_participants", "n"},
       {"published", "published"},
       {"published_sd", "SD"},
       {"published_low", "95 % low"},
       {"published_high", "high"},
       {"source", ""}},
      {},
      "published: the paper's figures, of 13 participants; intervals by Student's t from "
      "its SDs (the introduction's is exact), none where it gives none. Its 10.1 % of answered C1 "
      "trials is a ratio of means. The CSV says where "
      "in the paper each stands."};
  for (const PublishedFigure& figure : published_beside(summary))
    table.rows.push_back({word(figure.what), word(figure.unit), number(figure.found),
                          number(figure.found_sd), low(figure.found_interval),
                          high(figure.found_interval), count(figure.n), number(figure.published),
                          number(figure.published_sd), low(figure.published_interval),
                          high(figure.published_interval), word(figure.source)});
  return table;
}

}  // namespace heft
