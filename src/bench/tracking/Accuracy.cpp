#include "bench/tracking/Accuracy.h"

namespace heft {

namespace {
constexpr std::string_view columns =
    "picture,detector,refinement,decimate,region_of_interest,pictures,board_found,effector_found,"
    "board_median_mm,board_p95_mm,board_median_deg,board_p95_deg,tip_median_mm,tip_p95_mm,"
    "effector_median_deg,effector_p95_deg,time_median_ms,time_p95_ms";

FilmPlan plan_for(int width_px, bool quick) {
  FilmPlan plan;
  plan.width_px = width_px;
  plan.n_takes = quick ? 2 : width_px == 640 ? 24 : 20;
  plan.n_pictures = quick ? 4 : 6;
  return plan;
}

void write(const std::vector<MethodResult>& results, const StudyOptions& options) {
  CsvFile csv(options, "accuracy.csv", columns);
  for (const auto& [width_px, name, s] : results)
    csv.row(size_name(width_px), name.detector, name.refinement, name.decimate,
            name.region_of_interest ? "yes" : "no", s.n, s.board_found, s.effector_found,
            or_nan(s.board_median_mm), or_nan(s.board_p95_mm), or_nan(s.board_median_deg),
            or_nan(s.board_p95_deg), or_nan(s.tip_median_mm), or_nan(s.tip_p95_mm),
            or_nan(s.effector_median_deg), or_nan(s.effector_p95_deg), s.time_median_ms,
            s.time_p95_ms);
}
}  // namespace

std::vector<MethodResult> study_accuracy(const StudyOptions& options, StudyProgress& progress) {
  std::vector<MethodResult> results;
  for (const int width_px : picture_widths_px) {
    progress.next("every method at " + size_name(width_px));
    const auto methods = all_methods(width_px, options.quick);
    const auto films = film(plan_for(width_px, options.quick), methods);
    for (std::size_t m = 0; m < methods.size(); ++m)
      results.push_back({width_px, methods[m], summary_of(films[m].errors())});
  }
  write(results, options);
  draw(options, "accuracy", accuracy_chart(results, options));
  return results;
}

}  // namespace heft
