// The staircases: those of one session in full, and everybody's as small multiples.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "analysis/charts/Plot.h"
#include "analysis/report/Tables.h"

namespace heft {

namespace {
constexpr std::size_t most_panels = 150;

std::string name_of_compared(const Compared& compared) {
  return fmt::format("{:g} g, {}", compared.reference_g, compared.condition);
}

// trial, level, what was answered (0 none, 1 heavier, 2 lighter), reversal
std::string rows_of(const Track& track) {
  std::string rows;
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    const TrackPoint& point = track.points[i];
    rows += fmt::format("{} {} {} {}\n", i + 1, point.level_g,
                        point.wrong    ? 2
                        : point.chosen ? 1
                                       : 0,
                        point.is_reversal ? 1 : 0);
  }
  return rows;
}

void add_track(PlotPanel& panel, const Track& track, std::size_t index, bool in_full) {
  const std::string rows = rows_of(track);
  const std::string_view color = in_full ? series_color(index) : "#777777";
  std::string title;
  if (in_full)
    title = track.staircase + (track.jnd_g ? fmt::format(": JND {}{:.1f} g",
                                                         beyond_sign(track.censored), *track.jnd_g)
                                           : ": no JND");
  panel.add(rows,
            fmt::format("using 1:2 with lines dashtype {} linecolor '{}'",
                        in_full ? 1 : series_dash(index), color),
            title);
  const auto points = [&](std::string_view where, std::string_view look, std::string_view of) {
    panel.add(rows, fmt::format("using 1:({} ? $2 : NaN) with points {} linecolor '{}'", where,
                                look, of));
  };
  const double size = in_full ? 0.6 : 0.35;
  points("$3==1", fmt::format("pointtype 7 pointsize {}", size), in_full ? color : "#222222");
  points("$3==0", fmt::format("pointtype 6 pointsize {}", size + 0.1), in_full ? color : "#222222");
  points("$3==2", fmt::format("pointtype 2 pointsize {}", size + 0.2), "#c0561f");
  if (in_full) points("$4==1", "pointtype 6 pointsize 1.3", color);
  if (in_full && track.jnd_g)
    panel.layers.push_back(
        {"", fmt::format("{} with lines dashtype 2 linecolor '{}'", *track.jnd_g, color), ""});
}

// "P01: 120, > 900 g"
std::string panel_title(const SessionTracks& session, const std::vector<const Track*>& tracks) {
  std::string jnds;
  for (const Track* track : tracks)
    jnds += fmt::format("{}{}", jnds.empty() ? ": " : ", ",
                        track->jnd_g
                            ? fmt::format("{}{:.0f}", beyond_sign(track->censored), *track->jnd_g)
                            : "none");
  return session.participant + jnds + " g";
}

Chart all_at(const Summary& summary, const Compared& compared, bool several_conditions) {
  Chart chart;
  chart.name = fmt::format("all_staircases_{:g}g{}", compared.reference_g,
                           several_conditions ? "_" + compared.condition : "");
  std::ranges::replace_if(
      chart.name, [](unsigned char c) { return !std::isalnum(c) && c != '_'; }, '_');
  chart.title = titled("Every staircase at " + name_of_compared(compared), summary);
  std::vector<PlotPanel> panels;
  double highest_g = 1, lowest_g = 0;
  for (const SessionTracks& session : summary.all_tracks) {
    std::vector<const Track*> tracks;
    for (const Track& track : session.tracks)
      if (track.compared == compared) tracks.push_back(&track);
    if (tracks.empty()) continue;
    chart.n += 1;
    if (panels.size() == most_panels) continue;
    PlotPanel& panel = panels.emplace_back(PlotPanel{panel_title(session, tracks), "", {}});
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      add_track(panel, *tracks[i], i, false);
      for (const TrackPoint& point : tracks[i]->points) {
        highest_g = std::max(highest_g, point.level_g);
        lowest_g = std::min(lowest_g, point.level_g);
      }
    }
  }
  chart.caption = fmt::format(
      "Difference shown (g) by trial of the staircase, a panel for each session{}. Filled: the "
      "heavier cube was chosen; cross: the lighter one; open: no difference. Above each panel the "
      "paper's JND, \"> \" or \"< \" where a bound, the trial limit or few reversals cut it.",
      static_cast<std::size_t>(chart.n) > panels.size()
          ? fmt::format(", the first {} of {}", panels.size(), chart.n)
          : "");
  chart.csv = "staircase_trials.csv";
  PlotFrame frame{140, 94, 5, 60, 40, 74};
  frame.axes =
      fmt::format("set xrange [0:*]\nset yrange [{}:{}]\nset tics font ',9'\nset xtics 20\n",
                  lowest_g - 0.04 * highest_g, 1.05 * highest_g);
  frame.legend = "filled: heavier chosen; cross: lighter chosen; open: no difference";
  put_script(chart, summary, frame, panels);
  return chart;
}
}  // namespace

Chart tracks_chart(const Summary& summary) {
  Chart chart{"staircases", "", ""};
  const SessionTracks* example = example_of(summary.all_tracks);
  if (!example) return chart;
  const SessionTracks& session = *example;
  chart.title =
      titled(fmt::format("Staircases of session {}, {}", session.session_id, session.participant),
             session.simulated ? "simulated" : "", summary);
  chart.caption =
      "One session's staircases in full; all sessions' follow. Dashed: the paper's JND, \"> \" or "
      "\"< \" where it is censored. Filled: the heavier cube was chosen; cross: the lighter one; "
      "open: no difference; ring: reversal.";
  chart.n = 1;
  chart.csv = "staircase_trials.csv";
  std::map<Compared, PlotPanel> panels;
  std::map<Compared, std::size_t> n_tracks;
  for (const Track& track : session.tracks) {
    PlotPanel& panel = panels[track.compared];
    panel.title = name_of_compared(track.compared);
    add_track(panel, track, n_tracks[track.compared]++, true);
  }
  PlotFrame frame;
  frame.panel_width_px = panels.size() > 1 ? 300 : 600;
  frame.axes =
      "set xrange [0:*]\nset xlabel 'trial of the staircase'\n"
      "set ylabel 'difference from the reference (g)'\n";
  frame.legend =
      "filled: heavier chosen; cross: lighter chosen; open: no difference; ring: reversal";
  std::vector<PlotPanel> drawn;
  for (auto& [compared, panel] : panels) drawn.push_back(std::move(panel));
  put_script(chart, summary, frame, drawn);
  return chart;
}

std::vector<Chart> multiples_charts(const Summary& summary) {
  std::set<Compared> all;
  for (const SessionTracks& session : summary.all_tracks)
    for (const Track& track : session.tracks) all.insert(track.compared);
  std::vector<Chart> charts;
  for (const Compared& compared : all) {
    const auto same = std::ranges::count(all, compared.reference_g, &Compared::reference_g);
    charts.push_back(all_at(summary, compared, same > 1));
  }
  return charts;
}

}  // namespace heft
