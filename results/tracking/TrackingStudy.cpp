#include "results/tracking/TrackingStudy.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "results/tracking/comparison/ComparisonTracker.h"

namespace heft {

namespace {
constexpr double found_enough = 0.9;

const MethodResult* result_of(const std::vector<MethodResult>& all, int width_px,
                              const MethodName& name) {
  const auto at = std::ranges::find_if(
      all, [&](const MethodResult& r) { return r.width_px == width_px && r.name == name; });
  return at == all.end() ? nullptr : &*at;
}

std::string rounded(const std::optional<double>& value) {
  return value ? fmt::format("{:.2g}", *value) : "-";
}

std::string method_row(const MethodResult* result, std::string_view what) {
  if (!result) return "";
  const ErrorSummary& s = result->summary;
  return fmt::format("| {} | {} | {} / {} | {} / {} | {:.0f} % | {:.1f} |\n", what,
                     size_name(result->width_px), rounded(s.tip_mm.median), rounded(s.tip_mm.p95),
                     rounded(s.board_mm.median), rounded(s.board_mm.p95), 100 * s.effector_found,
                     or_nan(s.time_ms.median));
}

std::string method_table(const std::vector<MethodResult>& accuracy) {
  std::string text =
      "| | picture | tip, median / p95 mm | board, median / p95 mm | effector found | ms a picture "
      "|\n|---|---|---|---|---|---|\n";
  for (const int width_px : picture_widths_px) {
    MethodName cells = our_method(width_px), edges = cells, corners = cells;
    cells.refinement = "cells";
    edges.refinement = "edges + bias removed";
    corners.refinement = "corners";
    MethodName aruco{"aruco + solvePnP", "corners", 1, false};
    text +=
        method_row(result_of(accuracy, width_px, our_method(width_px)), "**heft**") +
        method_row(result_of(accuracy, width_px, cells), "heft, edge bias left in") +
        method_row(result_of(accuracy, width_px, edges), "heft, borders of tags alone") +
        method_row(result_of(accuracy, width_px, corners), "heft on AprilTag's corners") +
        method_row(result_of(accuracy, width_px, plain_method(width_px)), "AprilTag + solvePnP") +
        method_row(result_of(accuracy, width_px, aruco), "OpenCV's aruco + solvePnP");
  }
  return text;
}

// Between which values the share of pictures falls below found_enough.
std::string where_lost(const std::vector<LimitPoint>& points, const std::string& limit,
                       ErrorSummary LimitPoint::*who) {
  const LimitPoint* last = nullptr;
  std::string text = "-";
  for (const LimitPoint& point : points) {
    if (point.limit != limit) continue;
    if ((point.*who).effector_found < found_enough)
      return last ? fmt::format("{:g} (p95 {} mm)", last->value, rounded((last->*who).tip_mm.p95))
                  : std::string("never");
    last = &point;
    text = fmt::format("{:g}, the worst tried (p95 {} mm)", point.value,
                       rounded((point.*who).tip_mm.p95));
  }
  return text;
}

std::string limit_table(const std::vector<LimitPoint>& points) {
  std::string text = "| | heft | AprilTag + solvePnP |\n|---|---|---|\n";
  for (const Limit& limit : limits())
    text += fmt::format("| {} | {} | {} |\n", limit.label,
                        where_lost(points, limit.name, &LimitPoint::ours),
                        where_lost(points, limit.name, &LimitPoint::plain));
  return text;
}

// What removing the edge bias is worth where the tone curve is not sRGB.
std::string tone_table(const std::vector<LimitPoint>& points) {
  std::string text =
      "| tone curve | tip, median / p95 mm | with the bias left in |\n|---|---|---|\n";
  const auto errors = [](const ErrorSummary& s) {
    return fmt::format("{} / {}", rounded(s.tip_mm.median), rounded(s.tip_mm.p95));
  };
  for (const LimitPoint& point : points)
    if (point.limit == "gamma")
      text += fmt::format("| {} | {} | {} |\n",
                          point.value == 1 ? "linear" : fmt::format("gamma {:g}", point.value),
                          errors(point.ours), errors(point.bias_left_in));
  return text;
}

std::string filter_table(const std::vector<FilterResult>& filters) {
  std::string text =
      "| filter | jitter at rest, mm | lag, ms | tip at 0.5 m/s, p95 mm |\n|---|---|---|---|\n";
  for (const FilterResult& f : filters)
    text += fmt::format("| {} | {:.3f} | {:.1f} | {} |\n", f.filter.name(), f.jitter_mm, f.lag_ms,
                        std::isnan(f.swipe_p95_mm) ? "-" : fmt::format("{:.2f}", f.swipe_p95_mm));
  return text;
}

std::string goal_table(const std::vector<Goal>& goals) {
  std::string text = "| | goal | reached | |\n|---|---|---|---|\n";
  for (const Goal& goal : goals)
    text += fmt::format("| {} | {} {} | {} | {} |\n", goal.what, goal.at_least ? "≥" : "≤",
                        figure_text(goal.goal, goal.unit), figure_text(goal.reached, goal.unit),
                        goal.met() ? "met" : "**missed**");
  return text;
}
}  // namespace

std::string tracking_readme(const StudyParts& parts, const std::vector<Goal>& goals,
                            const StudyOptions& options) {
  return fmt::format(
      "# Tracking: what to choose when\n\n"
      "Written by the study ({}). The synthetic camera films everything, so the true poses are "
      "known. Times are processor times of one thread. They differ between machines, but their "
      "ratios hardly do.{}\n\n"
      "## Which tracker\n\n"
      "{}\n"
      "![error against time](accuracy.svg)\n\n"
      "Accuracy depends on where edges are measured: in linear light, not where the picture's tone "
      "curve has moved them. Searching a smaller picture misses small and slanted tags, but costs "
      "no accuracy. More pixels help more than any setting, so choose 1280x720 if the computer "
      "keeps up. `accuracy.csv` has every combination.\n\n"
      "By default the remaining edge bias is estimated and removed; keep this. A camera whose tone "
      "curve is exactly sRGB, as above, has no bias, and the estimate costs the difference between "
      "the first two rows of each size. Few cameras are that exact, and with others it keeps the "
      "tip in place (640x480, single pictures):\n\n"
      "{}\n"
      "## How close to the bound\n\n"
      "The pixels' noise bounds the mean error of every tracker from below (Cramér–Rao). The bound "
      "here is that of the tip from all pixels of the tags in view, with light, blur and the "
      "board's pose known. Held grips, single pictures, RMS:\n\n"
      "{}\n"
      "`bound.csv` has every picture.\n\n"
      "## Limits\n\n"
      "The last value at which the effector is found in nine of ten single pictures:\n\n"
      "{}\n"
      "![limits](limits.svg)\n\n"
      "Therefore use tags as large as the effector allows and well clear of the fingers, much "
      "light with a short exposure rather than a long exposure, a fixed focus, and no overexposed "
      "paper.\n\n"
      "## Camera faults\n\n"
      "Tone curves with shoulders, the camera's image processing, light, rolling shutters with a "
      "known read-out time, and wrong calibration files:\n\n"
      "![faults](faults.svg)\n\n"
      "`faults.csv` has the rate of found poses, errors, quality and false poses of each.\n\n"
      "## Which filter\n\n"
      "{}\n"
      "![filters](filters.svg)\n\n"
      "Over video, every millisecond of lag moves the clone off the filmed effector, which "
      "participants perceive as mass. Therefore only a filter without lag is used.\n\n"
      "## Goals\n\n"
      "{}",
      provenance(options),
      options.quick ? " **This was a quick run to see that it works: its figures mean nothing.**"
                    : "",
      method_table(parts.accuracy), tone_table(parts.limits), bound_table(parts.bounds),
      limit_table(parts.limits), filter_table(parts.filters), goal_table(goals));
}

void run_tracking_study(const StudyOptions& options) {
  keep_opencv_on_one_thread();
  const int n_sizes = static_cast<int>(picture_widths_px.size());
  std::vector<Goal> goals;
  StudyParts parts;
  {
    StudyProgress progress(n_sizes * (1 + goal_film_parts) + limit_parts + fault_parts +
                           bound_parts + goal_parts);
    parts.accuracy = study_accuracy(options, progress);
    for (const int width_px : picture_widths_px)
      parts.films_by_size.push_back(film_for_goals(width_px, options.quick, progress));
    parts.filters = study_filters(parts.films_by_size.front(), options);
    parts.limits = study_limits(options, progress);
    parts.faults = study_faults(options, progress);
    parts.bounds = study_bound(options, progress);
    goals = study_goals(parts, options, progress);
    std::ofstream(options.out + "/README.md") << tracking_readme(parts, goals, options);
  }
  fmt::print("{}", as_text(goals));
}

}  // namespace heft
