#include "analysis/charts/Plot.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>
#include <vector>

#include "analysis/display/Table.h"
#include "base/Error.h"

namespace heft {

namespace {
constexpr std::array<std::string_view, 7> all_colors{"#2f6fb0", "#8a8f98", "#3c8d5a", "#7a5aa6",
                                                     "#b58a00", "#c2407e", "#222222"};
constexpr std::array<int, 7> all_signs{7, 5, 9, 2, 6, 4, 11};
constexpr int title_px = 44, key_line_px = 19, axis_px = 62, right_px = 24;

// gnuplot's key has columns as wide as its longest title.
int key_lines(const std::vector<const PlotLayer*>& layers, int width_px) {
  if (layers.empty()) return 0;
  std::size_t longest = 0;
  for (const PlotLayer* layer : layers) longest = std::max(longest, layer->title.size());
  const int n_columns = std::max(1, width_px / (70 + 8 * static_cast<int>(longest)));
  return (static_cast<int>(layers.size()) + n_columns - 1) / n_columns;
}

// The first layer of each title.
std::vector<const PlotLayer*> layers_in_key(const std::vector<PlotPanel>& panels) {
  std::vector<const PlotLayer*> layers;
  for (const PlotPanel& panel : panels)
    for (const PlotLayer& layer : panel.layers)
      if (!layer.title.empty() &&
          std::ranges::find(layers, layer.title, &PlotLayer::title) == layers.end())
        layers.push_back(&layer);
  return layers;
}

// Range of a panel whose values are all the same, for which gnuplot would print a warning. None for
// other panels.
std::string range_of_one_value(const PlotPanel& panel) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const PlotLayer& layer : panel.layers) {
    std::istringstream rows(layer.rows);
    for (std::string row; std::getline(rows, row);) {
      std::istringstream columns(row);
      double x = 0, value = 0;
      for (columns >> x; columns >> value;) {
        least = std::min(least, value);
        most = std::max(most, value);
      }
    }
  }
  if (least != most) return "";
  const double half = least == 0 ? 1 : 0.01 * std::abs(least);
  return fmt::format("set yrange [{}:{}]\n", least - half, least + half);
}

std::string panel_text(const PlotPanel& panel, std::size_t index, bool has_range) {
  std::string blocks, terms;
  for (std::size_t i = 0; i < panel.layers.size(); ++i) {
    const PlotLayer& layer = panel.layers[i];
    if (layer.key_only) continue;
    std::string data;
    if (!layer.rows.empty()) {
      data = fmt::format("$p{}_{}", index, i);
      blocks += fmt::format("{} << END\n{}END\n", data, layer.rows);
    }
    terms += fmt::format("{}{} {} notitle", terms.empty() ? "" : ", ", data, layer.how);
  }
  const std::string range =
      has_range || panel.axes.find("yrange") != std::string::npos ? "" : range_of_one_value(panel);
  return blocks + panel.axes + range +
         (panel.title.empty() ? "unset title\n"
                              : fmt::format("set title {} offset 0,-0.6 font ',12'\n",
                                            gnuplot_quoted(panel.title))) +
         "plot " + (terms.empty() ? "NaN notitle" : terms) + "\nunset label\n" +
         (range.empty() ? "" : "set autoscale y\n");
}

// A plot without axes, its points outside: the key alone.
std::string key_text(const std::vector<const PlotLayer*>& layers, int top_px) {
  if (layers.empty()) return "";
  std::string terms;
  for (const PlotLayer* layer : layers) {
    const std::string how = layer->rows.empty() && !layer->key_only
                                ? "using 1:2 " + layer->how.substr(layer->how.find("with"))
                                : layer->how;
    terms += fmt::format("{}$outside {} title {}", terms.empty() ? "" : ", ", how,
                         gnuplot_quoted(layer->title));
  }
  return fmt::format(
      "$outside << END\n9 9 9 9\nEND\nunset logscale\nunset border\nunset tics\nunset grid\n"
      "unset xlabel\nunset ylabel\nunset title\nunset object\nset xrange [0:1]\nset yrange [0:1]\n"
      "set lmargin at screen 0.02\nset rmargin at screen 0.98\nset tmargin at screen 0.98\n"
      "set bmargin at screen 0.02\n"
      "set key at screen 0.5, screen 1-{}*pixel center top horizontal samplen 2\nplot {}\n",
      top_px, terms);
}
}  // namespace

std::string_view series_color(std::size_t index) {
  return all_colors.at(index % all_colors.size());
}
int series_sign(std::size_t index) {
  return all_signs.at(index % all_signs.size());
}
int series_dash(std::size_t index) {
  return static_cast<int>(index % 5) + 1;
}

void put_script(Chart& chart, const Summary& summary, const PlotFrame& frame,
                const std::vector<PlotPanel>& panels) {
  const int n_columns = std::min(frame.most_columns, static_cast<int>(panels.size()));
  const int n_rows = (static_cast<int>(panels.size()) + n_columns - 1) / n_columns;
  const int step_x_px = frame.panel_width_px + frame.gap_x_px;
  int tics_px = 0;
  for (const PlotPanel& panel : panels) tics_px = std::max(tics_px, panel.tics_px);
  const int step_y_px = frame.panel_height_px + frame.gap_y_px + tics_px;
  const int width_px = std::max(620, frame.left_px + n_columns * step_x_px + right_px);
  const int legend_px = frame.legend.empty() ? 0 : 20;
  const int panel_title_px = panels.front().title.empty() ? 12 : 30;
  const std::vector<const PlotLayer*> in_key = layers_in_key(panels);
  const int top_px =
      title_px + legend_px + panel_title_px + key_line_px * key_lines(in_key, width_px - 40);
  const int caption_px = 30 + 14 * static_cast<int>(caption_of(summary).size() * 6 / 596);
  const int height_px = top_px + n_rows * step_y_px - frame.gap_y_px + axis_px + caption_px;
  chart.script =
      gnuplot_header({chart.name + ".svg", width_px, height_px, chart.title, caption_of(summary)});
  if (!frame.legend.empty())
    chart.script += fmt::format(
        "set label {} at screen 0.5, screen 1-{}*pixel center font ',11' textcolor '#555555'\n",
        gnuplot_quoted(frame.legend), title_px);
  if (n_columns > 1) chart.script += "set tics font ',11'\n";
  chart.script += "set multiplot\nunset key\n" + frame.axes;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const int column = static_cast<int>(i) % n_columns, row = static_cast<int>(i) / n_columns;
    const int left_px = frame.left_px + column * step_x_px, y_px = top_px + row * step_y_px;
    chart.script +=
        gnuplot_place(1.0 * left_px / width_px, 1.0 * (left_px + frame.panel_width_px) / width_px,
                      y_px, y_px + frame.panel_height_px);
    chart.script += column == 0 ? frame.axes : "unset ylabel\n";
    chart.script += panel_text(panels[i], i, frame.axes.find("yrange") != std::string::npos);
  }
  chart.script += key_text(in_key, title_px - 6 + legend_px) + "unset multiplot\n";
}

namespace {
constexpr int caption_line_px = 14;
constexpr int caption_character_px = 6;
}  // namespace

std::string gnuplot_quoted(std::string_view text) {
  // gnuplot takes a quote that comes first for the end of an empty string, escaped or not.
  std::string quoted = text.starts_with('\'') ? "' " : "'";
  for (char c : text) {
    if (c == '\'')
      quoted += "''";
    else
      quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return quoted + '\'';
}

std::string gnuplot_header(const ChartFrame& frame) {
  const auto lines = wrapped(
      frame.caption, static_cast<std::size_t>((frame.width_px - 24) / caption_character_px));
  const int caption_px = caption_line_px * static_cast<int>(lines.size()) + 12;
  std::string script = fmt::format(
      "set terminal svg noenhanced size {0},{1} font 'DejaVu Sans,Arial,sans-serif,14' "
      "background '#ffffff'\n"
      "set output {2}\n"
      "set encoding utf8\n"
      "set pointintervalbox 0\n"
      "set errorbars 0.6\n"
      "set border 3 linecolor '#555555'\n"
      "set tics nomirror out textcolor '#333333'\n"
      "set grid ytics linetype 1 linecolor '#e4e4e4'\n"
      "pixel = 1.0/{1}\ncaption_top = {3}*pixel\n"
      "set label {4} at screen 0.5, screen 1-22*pixel center font ',16'\n",
      frame.width_px, frame.height_px, gnuplot_quoted(frame.svg_file), caption_px,
      gnuplot_quoted(frame.title));
  int y_px = caption_px - caption_line_px;
  for (const std::string& line : lines) {
    script += fmt::format(
        "set label {} at screen {:.4f}, screen {}*pixel font ',10' textcolor '#777777'\n",
        gnuplot_quoted(line), 12.0 / frame.width_px, y_px);
    y_px -= caption_line_px;
  }
  return script;
}

std::string gnuplot_place(double left, double right, int top_px, int bottom_px) {
  return fmt::format(
      "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
      "set tmargin at screen 1-{}*pixel\nset bmargin at screen 1-{}*pixel\n",
      left, right, top_px, bottom_px);
}

bool run_gnuplot(const std::string& folder, const std::string& script_file) {
  std::string program = "gnuplot", script = script_file;
  std::array<char*, 3> arguments{program.data(), script.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) return false;
  if (error != 0) throw Error(fmt::format("can't start gnuplot: {}", std::strerror(error)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error(
        fmt::format("gnuplot could not draw {}/{}; its message is above. The tables are "
                    "written; run gnuplot on that file to see more.",
                    folder, script_file));
  return true;
}

}  // namespace heft
