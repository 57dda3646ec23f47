// Jitter at rest against lag in motion, filter by filter, on the poses that our tracker measured.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/StudyFiles.h"
#include "bench/tracking/Headline.h"
#include "bench/tracking/Smoothers.h"

namespace heft {

struct FilterResult {
  std::string family, setting;
  double jitter_mm = 0;  ///< RMS distance of the tip from its mean while held still
  double lag_ms = 0;     ///< the delay that explains strokes best; negative: runs ahead
  double stroke_p95_mm = 0, swipe_p95_mm = 0;  ///< of the tip; swipes at 0.5 m/s

  std::string name() const { return setting.empty() ? family : family + ", " + setting; }
};

/// A tip's path after filtering, for one take.
struct FilteredTake {
  const Take* take;
  std::vector<double> t_s;
  std::vector<Pose> poses;
  std::vector<Velocity> velocities;
};

/// Starts the filter afresh for each take and after each picture without the effector; one entry
/// for each stretch between.
std::vector<FilteredTake> filtered(const MethodFilm& film, const SmootherEntry& filter);

/// RMS distance of the tip from its mean over each stretch's part after settle_s; none when
/// nothing is that long.
std::optional<double> jitter_mm(const std::vector<FilteredTake>& holds,
                                const Eigen::Vector3d& tip_m);

std::vector<FilterResult> study_filters(const Headline& headline, const StudyOptions& options);

std::string filter_chart(const std::vector<FilterResult>& results, const StudyOptions& options);

}  // namespace heft
