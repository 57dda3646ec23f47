// The report as one HTML page.
#pragma once

#include <string>
#include <vector>

#include "analysis/Summary.h"

namespace heft {

struct DrawnChart {
  std::string title;
  std::string svg;  ///< the whole file
};

std::string report_page(const Summary& summary, const std::vector<DrawnChart>& charts);

}  // namespace heft
