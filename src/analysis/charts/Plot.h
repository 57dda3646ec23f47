// gnuplot scripts of charts, from panels of layers. A layer has data and the commands that draw
// them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/charts/Charts.h"

namespace heft {

struct PlotLayer {
  std::string rows;   ///< data; empty: `how` is a function of x, or the layer is left out
  std::string how;    ///< "using 1:2 with points linecolor '#222222'"
  std::string title;  ///< in the key; empty: omitted
  bool key_only = false;
};

struct PlotPanel {
  std::string title;
  std::string axes;  ///< gnuplot's lines about this panel alone
  std::vector<PlotLayer> layers;
  int tics_px = 0;  ///< height of turned names below it

  void add(std::string rows, std::string how, std::string in_key = "") {
    if (!rows.empty()) layers.push_back({std::move(rows), std::move(how), std::move(in_key)});
  }
};

struct PlotFrame {
  int panel_width_px = 600, panel_height_px = 320;
  int most_columns = 3;
  int left_px = 108, gap_x_px = 44, gap_y_px = 108;
  std::string axes{};    ///< gnuplot's lines about all panels
  std::string legend{};  ///< a line below the title
};

/// Puts the panels in rows; the key is above them and names each title once.
void put_script(Chart& chart, const Summary& summary, const PlotFrame& frame,
                const std::vector<PlotPanel>& panels);

/// The looks of series: they differ in sign and dash, not only in color.
std::string_view series_color(std::size_t index);
int series_sign(std::size_t index);
int series_dash(std::size_t index);

/// A gnuplot string: 'text' with its quotes doubled, on one line.
std::string gnuplot_quoted(std::string_view text);

/// File, size and texts of a chart of any kind.
struct ChartFrame {
  std::string svg_file;
  int width_px = 0, height_px = 0;
  std::string title;    ///< one line at the top
  std::string caption;  ///< at the bottom, in as many lines as it needs
};

/// Size, fonts, colors, output, title and caption. Defines `pixel` (of the height) and
/// `caption_top`, in screen coordinates, for placing the rest.
std::string gnuplot_header(const ChartFrame& frame);

/// Sets the place of the next plot.
/// @param left,right fractions of the chart's width
/// @param top_px,bottom_px from the chart's top
std::string gnuplot_place(double left, double right, int top_px, int bottom_px);

/// Runs a script in a folder.
/// @return false when gnuplot is not installed
/// @throws Error when it fails
bool run_gnuplot(const std::string& folder, const std::string& script_file);

}  // namespace heft
