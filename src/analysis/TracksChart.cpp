// The staircases of one session, a panel for each reference.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "analysis/Charts.h"
#include "analysis/Gnuplot.h"
#include "analysis/Jnd.h"

namespace heft {

namespace {
constexpr std::array<std::string_view, 4> colors{"#2f6fb0", "#c0561f", "#3c8d5a", "#7a5aa6"};
constexpr int panel_px = 330, height_px = 500;

using Panels = std::map<double, std::vector<const Track*>>;  // by reference

Panels panels_of(const SessionTracks& session) {
  Panels panels;
  for (const Track& track : session.tracks) panels[track.reference_g].push_back(&track);
  return panels;
}

double highest_level(std::span<const Track* const> tracks) {
  double highest_g = 0;
  for (const Track* track : tracks)
    for (const TrackPoint& point : track->points) highest_g = std::max(highest_g, point.level_g);
  return highest_g > 0 ? highest_g : 1;
}

// Top of a reference's own y axis: the keys, two lines a track, stand above the highest level.
double top_level(std::span<const Track* const> tracks) {
  constexpr double key_line = 0.057, most_of_panel = 0.6;
  const double keys = key_line * (2 * static_cast<double>(tracks.size()) + 0.8);
  return highest_level(tracks) / (1 - std::min(keys, most_of_panel));
}

std::string block_name(double reference_g, std::size_t index) {
  std::string name = fmt::format("track_{:g}_{}", reference_g, index);
  std::ranges::replace_if(
      name, [](char c) { return c == '.' || c == '-' || c == '+'; }, '_');
  return name;
}

// trial, level, 1 where a cube was chosen, 1 at a reversal
std::string track_block(std::string_view name, const Track& track) {
  std::string block = fmt::format("${} << END\n", name);
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    const TrackPoint& point = track.points[i];
    block += fmt::format("{} {} {} {}\n", i + 1, point.level_g, point.chosen ? 1 : 0,
                         point.is_reversal ? 1 : 0);
  }
  return block + "END\n";
}

// The line, answers as filled or open points, rings at reversals, the JND dashed.
std::string track_plot(std::string_view name, const Track& track, std::string_view color) {
  std::string plot = fmt::format(
      "${0} using 1:2 with lines linecolor '{1}' title {2}, "
      "${0} using 1:($4==1 ? $2 : NaN) with points pointtype 6 pointsize 1.25 linecolor '{1}' "
      "notitle, "
      "${0} using 1:2 with points pointtype 7 pointsize 0.6 linecolor '{1}' notitle, "
      "${0} using 1:($3==0 ? $2 : NaN) with points pointtype 7 pointsize 0.36 linecolor "
      "'#ffffff' notitle",
      name, color, gnuplot_quoted(track.staircase));
  if (track.jnd_g)
    plot += fmt::format(", {} with lines dashtype 2 linecolor '{}' title 'JND {}{:.1f} g'",
                        *track.jnd_g, color, beyond_sign(track.censored), *track.jnd_g);
  return plot;
}

std::string panel_script(double reference_g, std::span<const Track* const> tracks, double left,
                         double right) {
  std::string blocks, plots;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const std::string name = block_name(reference_g, i);
    blocks += track_block(name, *tracks[i]);
    plots += (i == 0 ? "" : ", ") + track_plot(name, *tracks[i], colors.at(i % colors.size()));
  }
  return blocks + fmt::format(
                      "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
                      "set yrange [0:{}]\n"
                      "set title 'reference {:g} g' offset 0,-0.7\nplot {}\n"
                      "unset label\nunset ylabel\n",
                      left, right, top_level(tracks), reference_g, plots);
}
}  // namespace

Chart tracks_chart(const Summary& summary) {
  Chart chart{"staircases", "", ""};
  if (!summary.tracks) return chart;
  const SessionTracks& session = *summary.tracks;
  chart.title = fmt::format("Staircases of session {}, {}{}", session.session_id,
                            session.participant, session.simulated ? " (simulated)" : "");
  chart.caption =
      "One session's staircases in full; everybody's follow. Dashed: the paper's JND, \"> \" or "
      "\"< \" where it is censored.";
  chart.n = 1;
  chart.csv = "staircase_trials.csv";
  const Panels panels = panels_of(session);
  const int width_px = std::max(560, 105 + panel_px * static_cast<int>(panels.size()));
  chart.script =
      gnuplot_header({"staircases.svg", width_px, height_px, chart.title, caption_of(summary)}) +
      "set label 'filled: a cube was chosen; open: no difference; ring: reversal' "
      "at screen 0.5, screen 1-46*pixel center font ',11' textcolor '#555555'\n"
      "set multiplot\n"
      "set tmargin at screen 1-108*pixel\n"
      "set bmargin at screen caption_top + 66*pixel\n"
      "set key top right reverse Left samplen 2 font ',11'\n"
      "set xrange [0:*]\n"
      "set xlabel 'trial of the staircase'\n"
      "set ylabel 'difference from the reference (g)'\n";
  double left_px = 100;
  for (const auto& [reference_g, tracks] : panels) {
    chart.script +=
        panel_script(reference_g, tracks, left_px / width_px, (left_px + panel_px - 60) / width_px);
    left_px += panel_px;
  }
  chart.script += "unset multiplot\n";
  return chart;
}

}  // namespace heft
