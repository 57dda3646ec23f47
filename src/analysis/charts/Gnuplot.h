// Running gnuplot and writing its language. Scripts hold their data and everything else, so a chart
// can be drawn again from its script alone.
#pragma once

#include <string>
#include <string_view>

namespace heft {

/// A gnuplot string: 'text' with its quotes doubled, on one line.
std::string gnuplot_quoted(std::string_view text);

/// What every chart has.
struct ChartFrame {
  std::string svg_file;
  int width_px = 0, height_px = 0;
  std::string title;    ///< one line at the top
  std::string caption;  ///< at the bottom, in as many lines as it needs
};

/// Size, fonts, colors, output, title and caption. Defines `pixel` (of the height) and
/// `caption_top`, in screen coordinates, for placing the rest.
std::string gnuplot_header(const ChartFrame& frame);

/// Where the next plot is: from left to right as parts of the chart's width, its top and bottom
/// in pixels from the chart's top.
std::string gnuplot_place(double left, double right, int top_px, int bottom_px);

/// Runs a script in a folder.
/// @return false when gnuplot is not installed
/// @throws Error when it fails
bool run_gnuplot(const std::string& folder, const std::string& script_file);

}  // namespace heft
