// The charts of a Summary, as gnuplot scripts that hold their data.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/Summary.h"

namespace heft {

struct Chart {
  std::string name;       ///< of its files, without extension: NAME.gp draws NAME.svg
  std::string title;      ///< what it shows; stands in the report, too
  std::string script;     ///< gnuplot; empty: there is nothing to draw
  std::string caption{};  ///< how to read it
  int n = 0;              ///< participants, or what the caption says is counted
  std::string csv{};      ///< the report's file with its figures
};

/// In the order of the report; those there is something to draw for.
std::vector<Chart> charts_of(const Summary& summary);

/// The color that the paper's figures have in every chart.
inline constexpr std::string_view published_color = "#c0561f";

// Each where it has data, otherwise an empty script.
Chart sorting_chart(const Summary& summary);
Chart jnd_chart(const Summary& summary);
Chart tracks_chart(const Summary& summary);
Chart choice_chart(const Summary& summary);
std::vector<Chart> multiples_charts(const Summary& summary);
std::vector<Chart> people_charts(const Summary& summary);
Chart label_chart(const Summary& summary);
Chart published_chart(const Summary& summary);
Chart participant_flow_chart(const Summary& summary);
std::vector<Chart> person_charts(const Summary& summary);  ///< thresholds, tracking

/// The beginning of a chart's script: 720 pixels wide, its key between title and axes.
/// @param axes gnuplot's lines about them
std::string framed(const Chart& chart, const Summary& summary, int height_px,
                   std::string_view axes);

/// "Made by: heft analyse --db heft.db --out report (heft 0.1.0)"
std::string caption_of(const Summary& summary);

}  // namespace heft
