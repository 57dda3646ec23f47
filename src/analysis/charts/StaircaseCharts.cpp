// The staircases: those of one session in full, and everybody's as small multiples.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "analysis/charts/Plot.h"
#include "analysis/display/Phrases.h"

namespace heft {

namespace {
constexpr std::size_t most_panels = 150;

// "200 g, C2", "heavy (positive: yes), C2"; with the question's key if the block has another name.
std::string name_of_compared(const Track& track) {
  const auto& [reference_g, condition, method, block] = track.compared;
  if (block.empty()) return fmt::format("{:g} g, {}", reference_g, condition);
  return fmt::format("{}{}{}{}, {}", block,
                     track.question == block || !track.is_judgment() ? "" : "/" + track.question,
                     track.positive.empty() || track.chooses_cube
                         ? ""
                         : fmt::format(" (positive: {})", fmt::join(track.positive, ", ")),
                     reference_g > 0 ? fmt::format(" at {:g} g", reference_g) : "", condition);
}

// The kinds of tracks in a chart, on which its texts depend.
struct TrackKinds {
  bool jnds = false, thresholds = false;      // estimates
  std::vector<std::string> filled{}, open{};  // answers, without repeats
  bool of_cube = false;
  bool differences = false, masses = false;  // levels

  void add(const Track& track) {
    if (track.has_estimate) (track.is_judgment() ? thresholds : jnds) = true;
    (track.compared.reference_g > 0 ? differences : masses) = true;
    of_cube |= track.chooses_cube;
    if (track.chooses_cube)
      add_answers("heavier chosen",
                  track.answers == ComparisonAnswers::heavier ? "" : "no difference");
    else if (track.is_judgment())
      add_answers("positive answer", "negative answer");
    else
      add_answers("\"different\"", "\"same\"");
  }
  bool any_estimate() const { return jnds || thresholds; }
  std::string_view estimate() const {
    if (!thresholds) return "the paper's JND";
    return jnds ? "the paper's JND, or the threshold of the judgment" : "the threshold";
  }
  // "filled: heavier chosen; cross: lighter chosen; open: no difference"
  std::string answers(std::string_view first = "filled") const {
    std::string text = fmt::format("{}: {}", first, fmt::join(filled, " or "));
    if (of_cube) text += "; cross: lighter chosen";
    if (!open.empty()) text += fmt::format("; open: {}", fmt::join(open, " or "));
    return text;
  }

 private:
  void add_answers(std::string_view if_filled, std::string_view if_open) {
    for (auto [all, answer] : {std::pair(&filled, if_filled), {&open, if_open}})
      if (!answer.empty() && std::ranges::find(*all, answer) == all->end())
        all->emplace_back(answer);
  }
};

std::string_view level_label(bool is_mass) {
  return is_mass ? "mass (g)" : "difference from the reference (g)";
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
  const std::string_view estimate = track.is_judgment() ? "threshold" : "JND";
  std::string title;
  if (in_full) {
    title = track.staircase;
    if (track.jnd_g)
      title += fmt::format(": {} {}{:.1f} g", estimate, beyond_sign(track.censored), *track.jnd_g);
    else if (track.has_estimate)
      title += fmt::format(": no {}", estimate);
  }
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
  if (!tracks.front()->has_estimate) return session.participant;
  std::string jnds;
  for (const Track* track : tracks)
    jnds += fmt::format("{}{}", jnds.empty() ? ": " : ", ",
                        track->jnd_g
                            ? fmt::format("{}{:.0f}", beyond_sign(track->censored), *track->jnd_g)
                            : "none");
  return session.participant + jnds + " g";
}

// "all_staircases_200g", "all_staircases_heavy_C2"
std::string chart_name(const Track& of, bool several_conditions) {
  const std::string& block = of.compared.block;
  std::string name = "all_staircases";
  if (!block.empty()) name += "_" + block;
  if (of.compared.reference_g > 0) name += fmt::format("_{:g}g", of.compared.reference_g);
  if (several_conditions) name += "_" + of.compared.condition;
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c) && c != '_'; }, '_');
  return name;
}

// @param of a track of all that are charted
Chart all_at(const Summary& summary, const Track& of, const std::string& name) {
  Chart chart;
  chart.name = name;
  chart.title = titled(fmt::format("Every staircase {} {}", of.compared.block.empty() ? "at" : "of",
                                   name_of_compared(of)),
                       summary);
  std::vector<PlotPanel> panels;
  double highest_g = 1, lowest_g = 0;
  for (const SessionTracks& session : summary.all_tracks) {
    std::vector<const Track*> tracks;
    for (const Track& track : session.tracks)
      if (track.compared == of.compared) tracks.push_back(&track);
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
  TrackKinds kinds;
  kinds.add(of);
  chart.caption = fmt::format("{} (g) by trial of the staircase, a panel for each session{}. {}.",
                              kinds.masses ? "Mass" : "Difference shown",
                              static_cast<std::size_t>(chart.n) > panels.size()
                                  ? fmt::format(", the first {} of {}", panels.size(), chart.n)
                                  : "",
                              kinds.answers("Filled"));
  if (kinds.any_estimate())
    chart.caption += fmt::format(
        " Above each panel {}, \"> \" or \"< \" where a bound, the trial limit or few reversals "
        "cut it.",
        kinds.estimate());
  chart.csv = "staircase_trials.csv";
  PlotFrame frame{140, 94, 5, 60, lowest_g < 0 ? 52 : 40, 74};
  frame.axes =
      fmt::format("set xrange [0:*]\nset yrange [{}:{}]\nset tics font ',9'\nset xtics 20\n",
                  lowest_g - 0.04 * highest_g, 1.05 * highest_g);
  frame.legend = kinds.answers();
  put_script(chart, summary, frame, panels);
  return chart;
}

// Panels have separate labels if some levels are masses and others differences.
PlotFrame frame_of(const TrackKinds& kinds, std::size_t n_panels) {
  PlotFrame frame;
  frame.panel_width_px = n_panels > 1 ? 300 : 600;
  if (kinds.masses && kinds.differences) frame.gap_x_px = frame.left_px;
  frame.axes =
      fmt::format("set xrange [0:*]\nset xlabel 'trial of the staircase'\nset ylabel '{}'\n",
                  level_label(kinds.masses));
  frame.legend = kinds.answers() + "; ring: reversal";
  return frame;
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
  chart.n = 1;
  chart.csv = "staircase_trials.csv";
  TrackKinds kinds;
  for (const Track& track : session.tracks) kinds.add(track);
  chart.caption = "One session's staircases in full; all sessions' follow.";
  if (kinds.any_estimate())
    chart.caption +=
        fmt::format(" Dashed: {}, \"> \" or \"< \" where it is censored.", kinds.estimate());
  chart.caption += fmt::format(" {}; ring: reversal.", kinds.answers("Filled"));
  std::map<Compared, PlotPanel> panels;
  std::map<Compared, std::size_t> n_tracks;
  for (const Track& track : session.tracks) {
    PlotPanel& panel = panels[track.compared];
    panel.title = name_of_compared(track);
    if (kinds.masses && kinds.differences)
      panel.axes = fmt::format("set ylabel '{}'\n", level_label(track.compared.reference_g == 0));
    add_track(panel, track, n_tracks[track.compared]++, true);
  }
  std::vector<PlotPanel> drawn;
  for (auto& [compared, panel] : panels) drawn.push_back(std::move(panel));
  put_script(chart, summary, frame_of(kinds, drawn.size()), drawn);
  return chart;
}

std::vector<Chart> multiples_charts(const Summary& summary) {
  std::map<Compared, const Track*> all;  // the first one of each
  for (const SessionTracks& session : summary.all_tracks)
    for (const Track& track : session.tracks) all.emplace(track.compared, &track);
  std::vector<Chart> charts;
  for (const auto& one : all) {
    const auto same = std::ranges::count_if(all, [&](const auto& other) {
      return other.first.reference_g == one.first.reference_g &&
             other.first.block == one.first.block;
    });
    std::string name = chart_name(*one.second, same > 1);
    while (std::ranges::count(charts, name, &Chart::name) > 0) name += "_";
    charts.push_back(all_at(summary, *one.second, name));
  }
  return charts;
}

}  // namespace heft
