// The charts of a Summary, as gnuplot scripts that hold their data.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/dataset/Summary.h"
#include "analysis/display/ChartSpec.h"

namespace heft {

struct Chart {
  std::string name;       ///< of its files, without extension: NAME.gp draws NAME.svg
  std::string title;      ///< what it shows; in the report too
  std::string script;     ///< gnuplot; empty: there is nothing to draw
  std::string caption{};  ///< how to read it
  int n = 0;              ///< participants, or what the caption says is counted
  std::string csv{};      ///< the report's file with its figures
  int least_n = 0;        ///< the fewest participants of an estimate; 0: not counted
};

/// In the order of the report; charts without data are left out.
std::vector<Chart> charts_of(const Summary& summary);

/// None to draw: an empty script. @param of_participants the section's
Chart draw(const ChartSpec& spec, const Summary& summary, const Estimates& of_participants);

/// Color of the paper's figures in every chart.
inline constexpr std::string_view published_color = "#c0561f";

/// "Made by: heft analyse --db heft.db --out report (heft 0.1.0)"
std::string caption_of(const Summary& summary);

// Chart of staircases, which are not estimates.
Chart tracks_chart(const Summary& summary);
std::vector<Chart> multiples_charts(const Summary& summary);

}  // namespace heft
