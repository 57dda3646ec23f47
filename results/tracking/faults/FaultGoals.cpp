// What the goals say of cameras that are not ideal.
#include <array>
#include <tuple>

#include "results/tracking/TrackingStudy.h"

namespace heft {

namespace {
struct FaultGoal {
  std::string_view what, fault;
  double value, goal_mm;  ///< at 640x480; half of it at 1280x720 where halved
  bool halved = true;
};
constexpr std::array tip_goals{
    FaultGoal{"film curve", "film", 1, 1.1},
    FaultGoal{"S-curve", "s_curve", 0.6, 1.1},
    FaultGoal{"a shadow's edge that takes 40 %", "shadow", 0.4, 1},
    FaultGoal{"Bayer and JPEG 80", "mosaic_jpeg", 20, 0.8},
    FaultGoal{"noise 10", "noise", 10, 1.5},
    FaultGoal{"a third of the light, noise 10", "dim_noise", 0.7, 2.5},
    FaultGoal{"rolling shutter 25 ms, 0.25 m/s", "rolling_25ms", 0.25, 1.2, false},
    FaultGoal{"rolling shutter 25 ms, 0.5 m/s", "rolling_25ms", 0.5, 2, false},
    FaultGoal{"a shadow's edge that takes 60 %", "shadow", 0.6, 1, false},
    FaultGoal{"30 % of the last picture", "last_picture", 0.3, 1, false},
    FaultGoal{"focus breathing of 0.4 %", "breathing", 0.4, 1, false},
    FaultGoal{"defocus of 1.5 px", "defocus", 1.5, 1, false}};
constexpr double breathing_board_goal_mm = 0.5, found_goal = 90.0 / 96;
constexpr double board_goal_mm = 0.12, times_better = 6;

double times(const FaultPoint& point) {
  return or_nan(point.plain.tip_mm.p95) / or_nan(point.ours.tip_mm.p95);
}

// Files that are wrong are as wrong for both.
bool is_of_pictures(const FaultPoint& point) {
  return point.fault != "effector_print" && point.fault != "board_print" &&
         point.fault != "focal_length";
}

std::optional<Goal> worst_times(const std::vector<FaultPoint>& points, int width_px) {
  const FaultPoint* worst = nullptr;
  for (const FaultPoint& point : points)
    if (point.width_px == width_px && is_of_pictures(point) &&
        (!worst || !(times(point) >= times(*worst))) && point.plain.tip_mm.p95 &&
        point.ours.tip_mm.p95)
      worst = &point;
  if (!worst) return std::nullopt;
  return Goal{fmt::format("tip p95 of apriltag + solvePnP over ours, worst fault ({} {:g}) at {}",
                          worst->fault, worst->value, size_name(width_px)),
              times_better, "times", true, times(*worst)};
}

// Pictures, and how many of them have false poses.
struct Count {
  int n = 0, n_false = 0;

  void add(const ErrorSummary& summary) {
    n += summary.n;
    n_false += summary.n_false;
  }
};
}  // namespace

std::vector<Goal> fault_goals(const std::vector<FaultPoint>& points) {
  std::vector<Goal> goals;
  for (const int width_px : picture_widths_px) {
    const std::string at = " at " + size_name(width_px);
    for (const FaultGoal& goal : tip_goals)
      if (const FaultPoint* point = point_of(points, std::string(goal.fault), goal.value, width_px))
        goals.push_back({fmt::format("tip p95, {}{}", goal.what, at),
                         goal.goal_mm / (goal.halved && width_px > 640 ? 2 : 1), "mm", false,
                         or_nan(point->ours.tip_mm.p95)});
    for (const auto& [fault, value, what] : {std::tuple{"noise", 10.0, "noise 10"},
                                             {"dim_noise", 0.7, "a third of the light, noise 10"}})
      if (const FaultPoint* point = point_of(points, fault, value, width_px))
        goals.push_back({fmt::format("board in camera, p95, {}{}", what, at), board_goal_mm, "mm",
                         false, or_nan(point->ours.board_mm.p95)});
    if (const FaultPoint* point = point_of(points, "breathing", 0.4, width_px))
      goals.push_back({"board in camera, p95, focus breathing of 0.4 %" + at,
                       breathing_board_goal_mm, "mm", false, or_nan(point->ours.board_mm.p95)});
    if (const FaultPoint* point = point_of(points, "defocus", 1.5, width_px))
      goals.push_back({"effector found, defocus of 1.5 px" + at, found_goal, "", true,
                       point->ours.effector_found});
    if (const auto goal = worst_times(points, width_px)) goals.push_back(*goal);
  }
  return goals;
}

Goal count_false_poses(const StudyParts& parts) {
  Count count;
  for (const GoalFilms& films : parts.films_by_size)
    for (const GoalFilms::Pair* pair : {&films.strokes, &films.swipes, &films.holds})
      count.add(summary_of(pair->ours.errors()));
  for (const LimitPoint& point : parts.limits) count.add(point.ours);
  for (const FaultPoint& point : parts.faults)
    if (is_of_pictures(point)) count.add(point.ours);
  return {fmt::format("false poses (10 mm or 5 deg) in {} pictures of all kinds", count.n), 0,
          "poses", false, static_cast<double>(count.n_false)};
}

}  // namespace heft
