#include "bench/tracking/TrackingStudy.h"

#include <fstream>

#include "bench/comparison/ComparisonTracker.h"
#include "bench/tracking/Readme.h"

namespace heft {

void run_tracking_study(const StudyOptions& options) {
  keep_opencv_on_one_thread();
  const int n_sizes = static_cast<int>(picture_widths_px.size());
  std::vector<Goal> goals;
  {
    StudyProgress progress(n_sizes * (1 + headline_parts) + limit_parts + goal_parts);
    const auto accuracy = study_accuracy(options, progress);
    std::vector<Headline> headlines;
    for (const int width_px : picture_widths_px)
      headlines.push_back(film_headline(width_px, options.quick, progress));
    const auto filters = study_filters(headlines.front(), options);
    const auto limits = study_limits(options, progress);
    goals = study_goals(headlines, options, progress);
    std::ofstream(options.out + "/README.md")
        << tracking_readme(accuracy, limits, filters, goals, options);
  }
  fmt::print("{}", as_text(goals));
}

}  // namespace heft
