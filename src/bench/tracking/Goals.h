// The project's goals for tracking and what the study reached.
#pragma once

#include <string>
#include <vector>

#include "bench/StudyFiles.h"
#include "bench/tracking/Headline.h"

namespace heft {

struct Goal {
  std::string what;
  double goal = 0;
  std::string unit;
  bool at_least = false;  ///< false: the figure may be at most the goal
  double reached = 0;     ///< not a number where there were no pictures for it

  bool met() const { return at_least ? reached >= goal : reached <= goal; }
};

/// Films for flips and calibrates cameras, too. Writes goals.csv.
/// @param headlines of 640x480 and 1280x720
std::vector<Goal> study_goals(const std::vector<Headline>& headlines, const StudyOptions& options,
                              StudyProgress& progress);

inline constexpr int goal_parts = 2;  ///< of progress

/// A table for people.
std::string as_text(const std::vector<Goal>& goals);

/// "0.043 mm": three significant digits.
std::string figure_text(double value, const std::string& unit);

}  // namespace heft
