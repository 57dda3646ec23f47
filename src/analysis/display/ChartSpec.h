// Declarations of charts: measures, axes and splits. ChartShapes.cpp draws each shape.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/dataset/StudyEstimate.h"

namespace heft {

enum class ChartShape {
  points,   ///< estimates with intervals against a coordinate, side by side where they share one
  lines,    ///< the same, joined
  linked,   ///< each participant's estimates against a coordinate, joined
  people,   ///< each participant in a column, ordered by the first measure
  scatter,  ///< each participant's second measure against their first
  matrix,   ///< counts by two coordinates
};

/// Estimates that are drawn in the same way.
struct ChartSeries {
  const Measure* measure = nullptr;
  std::string title{};  ///< in the key; empty: the measure's heading, or what splits the series
  /// Only estimates with this coordinate.
  std::pair<std::string_view, std::string> only{};
  /// A measure whose interval is drawn as a band behind it.
  std::string_view band{};
};

struct ChartSpec {
  std::string name, title, caption, csv;
  ChartShape shape = ChartShape::points;
  int importance = 50;  ///< the order in the report, the smallest first
  std::vector<ChartSeries> series{};
  /// Coordinate on the x axis ("condition", "reference_g", "level_g"); of a matrix, the columns.
  std::string_view x{};
  std::string_view y{};  ///< of a matrix: the rows
  /// Coordinates by which series and panels are divided.
  std::vector<std::string_view> split{}, panels{};
  /// A measure that is drawn as a line where it belongs, such as chance.
  const Measure* reference = nullptr;
  bool participants = false;  ///< points: each participant's beside; lines: a thin line each
  bool diagonal = false;      ///< where x equals y
  std::string x_label{}, y_label{};
  std::string axes{};  ///< gnuplot's further lines about the axes

  /// Whether a series has a band; then each participant is a thin line.
  bool has_bands() const {
    return std::ranges::any_of(series, [](const ChartSeries& one) { return !one.band.empty(); });
  }
};

}  // namespace heft
