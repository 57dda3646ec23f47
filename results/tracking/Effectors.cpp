// Which of the shipped effectors to print: random grips, each held still and filmed once.
#include <algorithm>
#include <cmath>
#include <fstream>

#include "results/tracking/TrackingStudy.h"
#include "results/tracking/comparison/ComparisonTracker.h"

namespace heft {

namespace {
constexpr std::array bodies{EffectorBody::box, EffectorBody::two_faces};

const char* file_of(EffectorBody body) {
  return body == EffectorBody::box ? "effector.toml" : "effector_two_faces.toml";
}

double fraction(const std::vector<Measured>& pictures, bool (*is)(const Measured&)) {
  return static_cast<double>(std::ranges::count_if(pictures, is)) /
         static_cast<double>(pictures.size());
}

std::string row_of(const EffectorResult& result) {
  const ErrorSummary& s = result.summary;
  return fmt::format("| `{}` | {} | {:.0f} % | {:.0f} % | {:.1f} % | {:.3f} / {:.2f} |\n",
                     file_of(result.body), size_name(result.width_px), 100 * result.two_in_view,
                     100 * result.two_faces, 100 * s.effector_found, or_nan(s.tip_mm.median),
                     or_nan(s.tip_mm.p95));
}

std::string readme(const std::vector<EffectorResult>& results, const StudyOptions& options) {
  std::string rows;
  for (const EffectorResult& result : results) rows += row_of(result);
  return fmt::format(
      "# Effectors: which one to print\n\n"
      "Written by the study ({}). {} random grips: rolled by up to 34 degrees, turned by up to 40 "
      "from straight ahead, lowered by up to 14. The synthetic camera films each grip once, from "
      "42 to 48 cm at 46 to 60 degrees above the table, and each picture is tracked alone.{}\n\n"
      "| effector | picture | grips that show two tags | poses from two faces | found | tip, "
      "median / p95 mm |\n"
      "|---|---|---|---|---|---|\n"
      "{}\n"
      "A tag counts as shown if it is seen from less than 75 degrees off its front. Of all prisms "
      "and boxes that were tried, those with faces at 0 and 45 degrees show two tags in the most "
      "grips for their size. At 60 degrees (a hexagon) the second face is often too slanted to be "
      "read; below 40 the body is too wide for a hand.\n",
      provenance(options), results.front().summary.n,
      options.quick ? " **This was a quick run to see that it works: its figures mean nothing.**"
                    : "",
      rows);
}
}  // namespace

EffectorResult compare_effector(EffectorBody body, int width_px, int n_grips, std::uint64_t seed) {
  FilmPlan plan{width_px, Motion::hold, n_grips, 1, seed, Grip::any, {}, {}};
  plan.print.body = body;
  const auto films = film(plan, {our_method(width_px)});
  std::vector<Measured> pictures;
  for (const auto& take : films[0].pictures) pictures.push_back(take.front());
  return {body, width_px, fraction(pictures, [](const Measured& m) { return m.tags_in_view >= 2; }),
          fraction(pictures, [](const Measured& m) { return m.poses.n_faces >= 2; }),
          summary_of(films[0].errors())};
}

void run_effector_study(const StudyOptions& options) {
  keep_opencv_on_one_thread();
  const int n_grips = options.quick ? 3 : 600;
  std::vector<EffectorResult> results;
  {
    StudyProgress progress(static_cast<int>(bodies.size() * picture_widths_px.size()));
    for (const int width_px : picture_widths_px)
      for (const EffectorBody body : bodies) {
        progress.next(fmt::format("{} at {}", file_of(body), size_name(width_px)));
        results.push_back(compare_effector(body, width_px, n_grips, options.seed));
      }
  }
  CsvFile csv(
      options, "effectors.csv",
      "effector,picture,grips,two_tags_in_view,two_faces,effector_found,tip_median_mm,tip_p95_mm");
  for (const EffectorResult& r : results)
    csv.row(file_of(r.body), size_name(r.width_px), r.summary.n, r.two_in_view, r.two_faces,
            r.summary.effector_found, or_nan(r.summary.tip_mm.median),
            or_nan(r.summary.tip_mm.p95));
  std::ofstream(options.out + "/README.md") << readme(results, options);
  for (const EffectorResult& result : results) fmt::print("{}", row_of(result));
}

}  // namespace heft
