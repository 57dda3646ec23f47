#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/math/Quantiles.h"
#include "physics/Drive.h"
#include "results/tracking/faults/FaultStudy.h"
#include "tracking/calibration/CameraCalibration.h"
#include "tracking/calibration/ViewCollector.h"
#include "tracking/synthetic/BoardViews.h"

namespace heft {

namespace {
constexpr double gross_flip_deg = 20;
constexpr double see_through_delay_s = 0.05;

const SmootherEntry& our_filter() {
  return smoothers()[1];
}

// Of the tip while the effector is fast.
std::vector<TrackedError> while_swiping(const MethodFilm& film) {
  std::vector<TrackedError> errors;
  for (std::size_t take = 0; take < film.takes.size(); ++take)
    for (const Measured& picture : film.pictures[take])
      if (film.takes[take].speed_m_s(picture.t_s) >= swiping_m_s) errors.push_back(picture.error);
  return errors;
}

// Where both found the effector.
struct Both {
  std::vector<TrackedError> ours, plain;
};
Both found_by_both(const GoalFilms::Pair& pair) {
  const auto ours = pair.ours.errors(), plain = pair.plain.errors();
  Both both;
  for (std::size_t i = 0; i < ours.size(); ++i)
    if (ours[i].tip_mm && plain[i].tip_mm) {
      both.ours.push_back(ours[i]);
      both.plain.push_back(plain[i]);
    }
  return both;
}

double ratio(std::optional<double> of, std::optional<double> to) {
  return or_nan(of) / or_nan(to);
}

// The clone of condition C1 is drawn over the filmed effector: how far its tip is from the real
// one.
double clone_p95_mm(const MethodFilm& swipes, const Eigen::Vector3d& tip_m) {
  Scene scene;
  scene.coupling.decoupled = false;
  std::vector<double> off_mm;
  for (const FilteredTake& take : filtered(swipes, our_filter())) {
    Drive drive(make_simulator("bullet"), scene, 240);
    for (std::size_t i = 0; i < take.t_s.size(); ++i) {
      const WorldState& world = drive.advance({take.t_s[i], take.poses[i], take.velocities[i]});
      if (take.take->speed_m_s(take.t_s[i]) >= swiping_m_s)
        off_mm.push_back(1e3 *
                         (world.clone.pose * tip_m - take.take->at(take.t_s[i]) * tip_m).norm());
    }
  }
  return or_nan(quantile(off_mm, 0.95));
}

// The filtered pose carried on along its velocity, against where the effector is by then.
double prediction_rms_mm(const MethodFilm& strokes, const Eigen::Vector3d& tip_m) {
  double sum = 0, n = 0;
  for (const FilteredTake& take : filtered(strokes, our_filter()))
    for (std::size_t i = 5; i < take.t_s.size(); ++i) {
      const Pose ahead =
          predicted({take.t_s[i], take.poses[i], take.velocities[i]}, see_through_delay_s);
      const Pose truth = take.take->at(take.t_s[i] + see_through_delay_s);
      sum += (ahead * tip_m - truth * tip_m).squaredNorm();
      ++n;
    }
  return n > 0 ? 1e3 * std::sqrt(sum / n) : std::numeric_limits<double>::quiet_NaN();
}

void add_size(std::vector<Goal>& goals, const GoalFilms& goal_films) {
  const bool small = goal_films.width_px == 640;
  const std::string at = " at " + size_name(goal_films.width_px);
  const Eigen::Vector3d tip_m = tip_of(bench_apparatus(goal_films.width_px).effector);
  const ErrorSummary ours = summary_of(goal_films.strokes.ours.errors());
  const auto add = [&](const std::string& what, double goal, const std::string& unit,
                       double reached, bool at_least = false) {
    goals.push_back({what + at, goal, unit, at_least, reached});
  };
  add("board in camera, p95", 0.05, "mm", or_nan(ours.board_mm.p95));
  add("board in camera, p95", 0.03, "deg", or_nan(ours.board_deg.p95));
  add("effector's tip in board, p95", small ? 0.42 : 0.17, "mm", or_nan(ours.tip_mm.p95));
  add("effector in board, p95", small ? 0.5 : 0.3, "deg", or_nan(ours.effector_deg.p95));
  const auto swiping = while_swiping(goal_films.swipes.ours);
  if (!swiping.empty())
    add("tip at 0.5 m/s, 4 ms exposure, p95", 1.2, "mm", or_nan(summary_of(swiping).tip_mm.p95));
  add("tip's jitter when held still, filtered, RMS", 0.12, "mm",
      or_nan(jitter_mm(filtered(goal_films.holds.ours, our_filter()), tip_m)));
  add("C1's clone over the filmed effector at 0.5 m/s, p95", 1, "mm",
      clone_p95_mm(goal_films.swipes.ours, tip_m));
  add("prediction to the present, 50 ms, strokes of 0.4 m/s, RMS", 3, "mm",
      prediction_rms_mm(goal_films.strokes.ours, tip_m));
  const Both both = found_by_both(goal_films.strokes);
  if (both.ours.empty()) return;
  const ErrorSummary our = summary_of(both.ours), plain = summary_of(both.plain);
  add("tip p95 of apriltag + solvePnP over ours", 8, "times",
      ratio(plain.tip_mm.p95, our.tip_mm.p95), true);
  add("our time over that of apriltag + solvePnP", small ? 0.55 : 0.3, "times",
      ratio(our.time_ms.median, plain.time_ms.median));
}

// Strokes with two faces in view, in which the effector came out turned round.
Goal count_flips(bool quick) {
  FilmPlan plan{640, Motion::stroke, quick ? 2 : 520, quick ? 4 : 30, 3, Grip::two_faces, {}, {}};
  const auto films = film(plan, {our_method(plan.width_px)});
  int n = 0, flips = 0;
  for (const auto& take : films[0].pictures)
    for (const Measured& picture : take) {
      if (picture.tags_in_view < 2 || !picture.error.effector_deg) continue;
      ++n;
      if (*picture.error.effector_deg > gross_flip_deg) ++flips;
    }
  return {fmt::format("gross flips in {} pictures with two faces in view", n), 0, "flips", false,
          static_cast<double>(flips)};
}

// What a picture costs that nobody lit.
Goal time_in_the_dark(bool quick) {
  FilmPlan plan{640, Motion::stroke, quick ? 1 : 12, quick ? 4 : 15, 4, Grip::any, {}, {}};
  plan.optics.exposure = 0.3;
  plan.optics.noise = 10;
  const auto films = film(plan, {our_method(plan.width_px), plain_method(plan.width_px)});
  return {"our time over that of apriltag + solvePnP, a third of the light, noise 10, at 640x480",
          0.9, "times", false,
          ratio(summary_of(films[0].errors()).time_ms.median,
                summary_of(films[1].errors()).time_ms.median)};
}

void add_two_faces(std::vector<Goal>& goals, bool quick) {
  const auto two = compare_effector(EffectorBody::two_faces, 640, quick ? 3 : 200, 5);
  goals.push_back({"grips that show two tags of effector_two_faces.toml", 90, "%", true,
                   100 * two.two_in_view});
  goals.push_back({"tip p95, effector_two_faces.toml at 640x480", 0.35, "mm", false,
                   or_nan(two.summary.tip_mm.p95)});
}

// Cameras calibrated from as many views as the wizard asks for, each from views of its own: the
// worst one's, since a lab has one.
Goal calibrate_cameras(bool quick) {
  const Apparatus apparatus = bench_apparatus(640);
  const int n_cameras = quick ? 1 : 3;
  const int n_views = quick ? 6 : static_cast<int>(ViewCollector::enough);
  double worst_px = 0;
  for (int i = 0; i < n_cameras; ++i) {
    const BoardViews views = board_views(apparatus, n_views, 1, static_cast<std::uint64_t>(i + 1));
    const auto found = calibrate_camera(apparatus.board, views.images, views.names);
    worst_px = std::max(worst_px, ray_errors(found.camera, apparatus.camera).p95_px);
  }
  return {fmt::format("camera calibration from {} views, ray error, p95, worst of {} at 640x480",
                      n_views, n_cameras),
          0.2, "px", false, worst_px};
}
}  // namespace

std::string figure_text(double value, const std::string& unit) {
  return std::isnan(value) ? "-" : fmt::format("{:.3g} {}", value, unit);
}

std::vector<Goal> study_goals(const StudyParts& parts, const StudyOptions& options,
                              StudyProgress& progress) {
  std::vector<Goal> goals;
  for (const GoalFilms& goal_films : parts.films_by_size) add_size(goals, goal_films);
  for (const BoundResult& bound : parts.bounds)
    goals.push_back(
        {fmt::format("tip's RMS over what noise allows, {} at {}",
                     bound.tags == 1 ? "one tag" : "two tags", size_name(bound.width_px)),
         bound.tags == 1 ? 2.5 : 2, "times", false, bound.ratio()});
  std::ranges::move(fault_goals(parts.faults), std::back_inserter(goals));
  goals.push_back(find_readout(options.quick));
  goals.push_back(count_false_poses(parts));
  progress.next("in the dark, and with two faces");
  goals.push_back(time_in_the_dark(options.quick));
  add_two_faces(goals, options.quick);
  progress.next("looking for flips");
  goals.push_back(count_flips(options.quick));
  progress.next("calibrating cameras");
  goals.push_back(calibrate_cameras(options.quick));
  CsvFile csv(options, "goals.csv", "what,bound,goal,reached,unit,met");
  for (const Goal& goal : goals)
    csv.row(goal.what, goal.at_least ? "at least" : "at most", goal.goal, goal.reached, goal.unit,
            goal.met() ? "yes" : "no");
  return goals;
}

std::string as_text(const std::vector<Goal>& goals) {
  std::string text = fmt::format("{:<62} {:>14} {:>14}\n", "", "goal", "reached");
  for (const Goal& goal : goals)
    text += fmt::format(
        "{:<62} {:>14} {:>14}{}\n", goal.what,
        fmt::format("{} {}", goal.at_least ? ">=" : "<=", figure_text(goal.goal, goal.unit)),
        figure_text(goal.reached, goal.unit), goal.met() ? "" : "  MISSED");
  return text;
}

}  // namespace heft
