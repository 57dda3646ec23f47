#include "analysis/charts/Gnuplot.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <vector>

#include "analysis/report/Table.h"
#include "base/Error.h"

namespace heft {

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
