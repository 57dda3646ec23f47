// Every staircase of everybody: a small panel for each session, a chart for each reference.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "analysis/Charts.h"
#include "analysis/Gnuplot.h"
#include "analysis/TableParts.h"

namespace heft {

namespace {
constexpr std::size_t n_columns = 5, most_panels = 150;
constexpr int panel_width_px = 180, panel_height_px = 146, top_px = 92, left_px = 60;
constexpr std::array<std::string_view, 4> dashes{"1", "2", "3", "4"};

// trial, level, what was answered: 0 none, 1 right, 2 wrong
std::string block_of(std::string_view name, const Track& track) {
  std::string block = fmt::format("${} << END\n", name);
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    const TrackPoint& point = track.points[i];
    block += fmt::format("{} {} {}\n", i + 1, point.level_g,
                         point.wrong    ? 2
                         : point.chosen ? 1
                                        : 0);
  }
  return block + "END\n";
}

std::string plot_of(std::string_view name, std::size_t index) {
  return fmt::format(
      "${0} using 1:2 with lines dashtype {1} linecolor '#777777' notitle, "
      "${0} using 1:($3==1 ? $2 : NaN) with points pointtype 7 pointsize 0.3 linecolor '#222222' "
      "notitle, "
      "${0} using 1:($3==0 ? $2 : NaN) with points pointtype 6 pointsize 0.4 linecolor '#222222' "
      "notitle, "
      "${0} using 1:($3==2 ? $2 : NaN) with points pointtype 2 pointsize 0.5 linecolor '#c0561f' "
      "notitle",
      name, dashes.at(index % dashes.size()));
}

struct Panel {
  const SessionTracks* session;
  std::vector<const Track*> tracks;
};

std::vector<Panel> panels_at(const Summary& summary, double reference_g) {
  std::vector<Panel> panels;
  for (const SessionTracks& session : summary.all_tracks) {
    Panel panel{&session, {}};
    for (const Track& track : session.tracks)
      if (track.reference_g == reference_g) panel.tracks.push_back(&track);
    if (!panel.tracks.empty()) panels.push_back(std::move(panel));
  }
  return panels;
}

double highest_level(std::span<const Panel> panels) {
  double highest_g = 1;
  for (const Panel& panel : panels)
    for (const Track* track : panel.tracks)
      for (const TrackPoint& point : track->points) highest_g = std::max(highest_g, point.level_g);
  return highest_g;
}

// "P01" or "P01: 120, > 900 g"
std::string panel_title(const Panel& panel) {
  std::string jnds;
  for (const Track* track : panel.tracks)
    jnds += fmt::format("{}{}", jnds.empty() ? ": " : ", ",
                        track->jnd_g
                            ? fmt::format("{}{:.0f}", beyond_sign(track->censored), *track->jnd_g)
                            : "none");
  return panel.session->participant + jnds + " g";
}

std::string panel_script(const Panel& panel, std::size_t place, int width_px, int height_px) {
  const int x_px = left_px + static_cast<int>(place % n_columns) * panel_width_px;
  const int y_px = top_px + static_cast<int>(place / n_columns) * panel_height_px;
  std::string blocks, plots;
  for (std::size_t i = 0; i < panel.tracks.size(); ++i) {
    const std::string name = fmt::format("p{}_{}", place, i);
    blocks += block_of(name, *panel.tracks[i]);
    plots += (i == 0 ? "" : ", ") + plot_of(name, i);
  }
  return blocks +
         fmt::format(
             "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
             "set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n"
             "set title {} offset 0,-0.9 font ',10'\nset format y '{}'\nplot {}\n"
             "unset label\n",
             1.0 * x_px / width_px, 1.0 * (x_px + panel_width_px - 18) / width_px,
             1 - 1.0 * (y_px + 18) / height_px, 1 - 1.0 * (y_px + panel_height_px - 34) / height_px,
             gnuplot_quoted(panel_title(panel)), place % n_columns == 0 ? "%g" : "", plots);
}

Chart chart_at(const Summary& summary, double reference_g) {
  std::vector<Panel> panels = panels_at(summary, reference_g);
  const std::size_t n_all = panels.size();
  panels.resize(std::min(n_all, most_panels));
  const auto n_rows = static_cast<int>((panels.size() + n_columns - 1) / n_columns);
  const int width_px = left_px + static_cast<int>(n_columns) * panel_width_px + 10;
  const int height_px = top_px + n_rows * panel_height_px + 60;
  Chart chart;
  chart.name = fmt::format("all_staircases_{:g}g", reference_g);
  std::ranges::replace(chart.name, '.', '_');
  chart.title = titled(fmt::format("Every staircase at {:g} g", reference_g), summary);
  chart.caption = fmt::format(
      "Difference shown (g) by trial of the staircase, a panel for each session{}. Filled: the "
      "heavier cube was chosen; cross: the lighter one; open: no difference. Above each panel the "
      "paper's JND, \"> \" or \"< \" where a bound, the trial limit or few reversals cut it.",
      n_all > panels.size() ? fmt::format(", the first {} of {}", panels.size(), n_all) : "");
  chart.n = static_cast<int>(n_all);
  chart.csv = "staircase_trials.csv";
  chart.script =
      gnuplot_header({chart.name + ".svg", width_px, height_px, chart.title, caption_of(summary)}) +
      fmt::format(
          "set label 'filled: heavier chosen; cross: lighter chosen; open: no difference' at "
          "screen 0.5, screen 1-46*pixel center font ',11' textcolor '#555555'\n"
          "set multiplot\nset xrange [0:*]\nset yrange [-{0}:{1}]\nset tics font ',9'\n"
          "set xtics 20\n",
          0.04 * highest_level(panels), 1.05 * highest_level(panels));
  for (std::size_t i = 0; i < panels.size(); ++i)
    chart.script += panel_script(panels[i], i, width_px, height_px);
  chart.script += "unset multiplot\n";
  return chart;
}
}  // namespace

std::vector<Chart> multiples_charts(const Summary& summary) {
  std::set<double> references_g;
  for (const SessionTracks& session : summary.all_tracks)
    for (const Track& track : session.tracks) references_g.insert(track.reference_g);
  std::vector<Chart> charts;
  for (double reference_g : references_g) charts.push_back(chart_at(summary, reference_g));
  return charts;
}

}  // namespace heft
