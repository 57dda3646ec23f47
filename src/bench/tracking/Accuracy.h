// Error against time per picture for every detector, decimation and refinement.
#pragma once

#include <vector>

#include "bench/Study.h"
#include "bench/StudyFiles.h"
#include "bench/tracking/Filming.h"

namespace heft {

struct MethodResult {
  int width_px = 0;
  MethodName name;
  ErrorSummary summary;
};

/// Films strokes at both picture sizes, has every method track them, writes accuracy.csv and
/// accuracy.svg.
std::vector<MethodResult> study_accuracy(const StudyOptions& options, StudyProgress& progress);

/// The gnuplot script of accuracy.svg.
std::string accuracy_chart(const std::vector<MethodResult>& results, const StudyOptions& options);

/// The sizes that the goals are stated for.
inline constexpr std::array picture_widths_px{640, 1280};
inline std::string size_name(int width_px) {
  return width_px == 640 ? "640x480" : "1280x720";
}

}  // namespace heft
