// Map of failures: a row of panels for each method, a column for each varied parameter, a colored
// cell for each run.
#include <algorithm>
#include <functional>
#include <map>

#include "analysis/charts/Plot.h"
#include "results/physics/Stability.h"

namespace heft {

namespace {
constexpr int panel_height_px = 128, width_px = 1640;

struct Look {
  const char* color;
  const char* words;
};

Look look_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::stable:
      return {"#4d9f6c", "stable"};
    case Verdict::creeps:
      return {"#b7d7a8", "creeps > 1 \u00b5m"};
    case Verdict::rings:
      return {"#f5d76e", "rings"};
    case Verdict::penetrates:
      return {"#f0a04b", "penetrates > 0.1 mm"};
    case Verdict::wrong_lag:
      return {"#9b6fc4", "wrong lag > 2 %"};
    case Verdict::blows_up:
      return {"#c0392b", "blows up"};
    case Verdict::outside_model:
      return {"#dddddd", "not its model"};
  }
  return {"#000000", "?"};
}

const char* axis_of(Varied varied) {
  switch (varied) {
    case Varied::stiffness:
      return "spring (N/m)";
    case Varied::torsional_stiffness:
      return "torsional spring (N m/rad)";
    case Varied::damping:
      return "damping ratio, 100 000 N/m";
    case Varied::cube_mass:
      return "cube (kg)";
    case Varied::second_cube_mass:
      return "second cube beside it (kg)";
  }
  return "";
}

// The most stable on top.
std::vector<std::string> simulators_in(const std::vector<StabilityCell>& cells) {
  std::map<std::string, int> n_stable;
  for (const StabilityCell& cell : cells)
    n_stable[cell.simulator] += cell.verdict == Verdict::stable;
  std::vector<std::string> names;
  for (const auto& [name, n] : n_stable) names.push_back(name);
  std::ranges::stable_sort(names, std::greater{}, [&](const auto& name) { return n_stable[name]; });
  return names;
}

std::size_t position_of(double value, const std::vector<double>& values) {
  return static_cast<std::size_t>(std::ranges::find(values, value) - values.begin());
}

// Tick labels, thinned out on long axes.
std::string tics(const std::vector<double>& values, bool silent) {
  std::string text;
  const std::size_t every = values.size() > 8 ? 3 : values.size() > 5 ? 2 : 1;
  for (std::size_t i = 0; i < values.size(); i += every)
    text += fmt::format("{}'{}' {}", text.empty() ? "" : ", ",
                        silent ? "" : fmt::format("{:g}", values[i]), i);
  return text;
}

std::vector<double> rates_in(const std::vector<StabilityCell>& cells) {
  std::vector<double> rates;
  for (const StabilityCell& cell : cells)
    if (std::ranges::find(rates, cell.rate_hz) == rates.end()) rates.push_back(cell.rate_hz);
  return rates;
}

// Labels of whole rows and columns are drawn once.
struct Place {
  bool top, bottom, left;
};

std::string panel(const std::vector<StabilityCell>& cells, const std::string& simulator,
                  Varied varied, const Place& place, bool quick) {
  const std::vector<double> rates = rates_in(cells), values = values_of(varied, quick);
  std::string script = "unset object\n";
  int tag = 1;
  for (const StabilityCell& cell : cells) {
    if (cell.simulator != simulator || cell.varied != varied) continue;
    const auto x = static_cast<double>(position_of(cell.rate_hz, rates));
    const auto y = static_cast<double>(position_of(cell.value, values));
    script += fmt::format(
        "set object {} rectangle from {},{} to {},{} fillcolor rgb '{}' fillstyle solid noborder\n",
        tag++, x - 0.47, y - 0.45, x + 0.47, y + 0.45, look_of(cell.verdict).color);
  }
  return script + fmt::format(
                      "set title {} font ',14'\nset xlabel '{}' font ',12'\nset xtics ({}) font "
                      "',11'\nset ytics ({}) font ',11'\nset label 400 {} at screen 0.012, graph "
                      "0.5 font ',14'\n"
                      "plot [-0.6:{}] [-0.6:{}] NaN notitle\n",
                      gnuplot_quoted(place.top ? axis_of(varied) : ""),
                      place.bottom ? "steps a second" : "", tics(rates, !place.bottom),
                      tics(values, false), gnuplot_quoted(place.left ? simulator : ""),
                      static_cast<double>(rates.size()) - 0.4,
                      static_cast<double>(values.size()) - 0.4);
}

// The legend under the title: a colored square and its label for each fault.
std::string legend() {
  std::string script;
  double x = 0.05;
  for (int i = 0; i < 7; ++i) {
    const Look look = look_of(static_cast<Verdict>(i));
    script += fmt::format(
        "set label {0} '\u25a0' at screen {1}, screen 1-50*pixel font ',24' textcolor '{2}'\n"
        "set label {3} {4} at screen {5}, screen 1-50*pixel font ',14'\n",
        200 + i, x, look.color, 300 + i, gnuplot_quoted(look.words), x + 0.02);
    x += 0.045 + 0.0063 * static_cast<double>(std::string_view(look.words).size());
  }
  return script;
}
}  // namespace

void draw_stability(const StudyOptions& options, const std::vector<StabilityCell>& cells) {
  const std::vector<std::string> names = simulators_in(cells);
  const int height_px = panel_height_px * static_cast<int>(names.size()) + 212;
  const std::string caption =
      "A cube of 100 g pushed by 10 cm at 0.1 m/s, then 1 s of rest, with the paper's coupling but "
      "for what is varied (with the spring the cube's mass goes as its root; the torsional spring "
      "is loaded by pushing 8 mm off center; two cubes, 5 mm out of line, are swept by the long "
      "side). Grey: refused. A cell shows the gravest fault. " +
      provenance(options);
  std::string script =
      gnuplot_header({"stability.svg", width_px, height_px, "Where methods fail", caption}) +
      legend() +
      fmt::format(
          "unset grid\nunset key\nset tics scale 0.3\n"
          "set multiplot layout {},{} margins screen 0.185, screen 0.985, screen caption_top + "
          "62*pixel, screen 1-110*pixel spacing screen 0.055, screen 18*pixel\n",
          names.size(), all_varied.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (Varied varied : all_varied) {
      const bool left = varied == all_varied.front();
      script +=
          panel(cells, names[i], varied, {i == 0, i + 1 == names.size(), left}, options.quick);
      script += "unset label\n";  // prevents title, legend and caption in each panel
    }
  }
  draw(options, "stability", script + "unset multiplot\n");
}

}  // namespace heft
