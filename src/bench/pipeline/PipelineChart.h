// What the stages cost, and its chart.
#pragma once

#include <string>
#include <vector>

#include "bench/Study.h"

namespace heft {

struct BudgetLine {
  std::string stage;
  double median_ms = 0, p95_ms = 0;
};

struct Budget {
  int width_px = 0;
  std::vector<BudgetLine> stages;  ///< in their order
  BudgetLine whole;                ///< all but physics, of the same picture
  int n_pictures = 0;

  /// The project's goal for the whole picture without physics.
  double goal_ms() const { return width_px == 640 ? 8 : 15; }
};

/// Stacked bars with each stage's median, one a picture size, and the goals.
std::string pipeline_chart(const std::vector<Budget>& budgets, const StudyOptions& options);

}  // namespace heft
