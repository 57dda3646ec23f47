// A display as the window system tells of it. How large it is in millimeters nobody tells reliably:
// that is measured (heft calibrate display).
#pragma once

#include <optional>
#include <string>

namespace heft {

struct DisplayFacts {
  int number = 0;  ///< from 0, as --display takes it
  std::string name;
  int w_px = 0, h_px = 0;
  std::optional<double> refresh_hz;
  double scale = 1;  ///< pixels a unit of the window system
};

/// A display as it was measured; a file holds it.
struct DisplayMeasures {
  int w_px = 0, h_px = 0;
  double w_mm = 0, h_mm = 0;
  double eye_distance_mm = 0;
};

}  // namespace heft
