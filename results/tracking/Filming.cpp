#include "results/tracking/Filming.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/Pose.h"
#include "base/math/Quantiles.h"
#include "results/Study.h"
#include "results/tracking/TrackingStudy.h"
#include "tracking/detection/MarkerBody.h"

namespace heft {

namespace {
double degrees_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return rotation_vector(a.conjugate() * b).norm() * 180 / M_PI;
}

bool well_seen(const Intrinsics& camera, const Tag& tag, const Pose& camera_from_board,
               const Pose& board_from_effector) {
  const Eigen::Vector3d center = camera_from_board * (board_from_effector * tag_center_m(tag));
  const Eigen::Vector3d normal =
      camera_from_board.orientation * (board_from_effector.orientation * tag_normal(tag));
  if (-normal.dot(center.normalized()) < std::cos(75 * M_PI / 180)) return false;
  return std::ranges::all_of(tag.corners_m, [&](const Eigen::Vector3d& corner_m) {
    const Eigen::Vector3d p = camera_from_board * (board_from_effector * corner_m);
    const Eigen::Vector2d pixel = project(camera, p);
    return p.z() > 0.05 && pixel.x() > 0 && pixel.y() > 0 && pixel.x() < camera.width_px - 1 &&
           pixel.y() < camera.height_px - 1;
  });
}
struct Place {
  double distance_m, pitch_deg;
};
constexpr std::array places{Place{0.42, 46}, Place{0.45, 52}, Place{0.48, 58}, Place{0.44, 60}};

// Takes spread over the phases of a stroke; a swipe is filmed from shortly before it starts.
double start_of(Motion motion, int take) {
  constexpr double between_starts_s = 0.37;
  return motion == Motion::swipe ? -0.05 : between_starts_s * take;
}

// A camera in one place.
class Studio {
 public:
  Studio(const Apparatus& apparatus, const Place& place, const Optics& optics, std::uint64_t seed)
      : apparatus_(apparatus),
        tip_m_(tip_of(apparatus.effector)),
        settings_(placed(place, optics)),
        camera_(apparatus, settings_, seed) {}

  void film_take(const FilmPlan& plan, int number, const std::vector<TrackingMethod>& methods,
                 std::vector<MethodFilm>& films) {
    const Take what = take(plan.motion, plan.seed, static_cast<std::uint64_t>(number), plan.grip);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      methods[m].reset();
      films[m].takes.push_back(what);
      films[m].pictures.emplace_back();
    }
    for (int i = 0; i < plan.n_pictures; ++i) {
      const double t_s = start_of(plan.motion, number) + i / film_rate_hz;
      const Image image = camera_.picture([&](double at_s) { return what.at(at_s); }, t_s,
                                          static_cast<std::uint64_t>(number * plan.n_pictures + i));
      for (std::size_t m = 0; m < methods.size(); ++m)
        films[m].pictures.back().push_back(measure(methods[m], image, t_s, what.at(t_s)));
    }
  }

 private:
  static SyntheticSettings placed(const Place& place, const Optics& optics) {
    SyntheticSettings settings;
    settings.optics = optics;
    settings.camera_from_board = camera_above_board(place.distance_m, place.pitch_deg * M_PI / 180);
    return settings;
  }

  Measured measure(const TrackingMethod& method, const Image& image, double t_s,
                   const Pose& truth) {
    const double began_s = thread_cpu_s();
    const MethodPoses poses = method.track(image, t_s);
    const double took_s = thread_cpu_s() - began_s;
    Measured measured{
        t_s, truth, tags_in_view(apparatus_, settings_.camera_from_board, truth), poses, {}};
    measured.error = error_of(measured.poses, settings_.camera_from_board, truth, tip_m_);
    measured.error.time_ms = 1e3 * took_s;
    return measured;
  }

  Apparatus apparatus_;
  Eigen::Vector3d tip_m_;
  SyntheticSettings settings_;
  SyntheticCamera camera_;
};
}  // namespace

int tags_in_view(const Apparatus& apparatus, const Pose& camera_from_board,
                 const Pose& board_from_effector) {
  return static_cast<int>(std::ranges::count_if(apparatus.effector.tags, [&](const Tag& tag) {
    return well_seen(apparatus.camera, tag, camera_from_board, board_from_effector);
  }));
}

Eigen::Vector3d tip_of(const MarkerBody& effector) {
  return {effector.size_m.x() / 2, 0, 0};
}

double or_nan(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

TrackedError error_of(const MethodPoses& poses, const Pose& camera_from_board,
                      const Pose& board_from_effector, const Eigen::Vector3d& tip_m) {
  TrackedError error;
  if (poses.camera_from_board) {
    error.board_mm =
        1e3 * (poses.camera_from_board->position_m - camera_from_board.position_m).norm();
    error.board_deg =
        degrees_between(poses.camera_from_board->orientation, camera_from_board.orientation);
  }
  if (poses.board_from_effector) {
    error.tip_mm = 1e3 * (*poses.board_from_effector * tip_m - board_from_effector * tip_m).norm();
    error.effector_deg =
        degrees_between(poses.board_from_effector->orientation, board_from_effector.orientation);
    error.quality = poses.quality;
  }
  return error;
}

std::vector<MethodFilm> film(const FilmPlan& plan, const std::vector<MethodName>& names) {
  const Apparatus apparatus = bench_apparatus(plan.width_px, plan.print);
  std::vector<TrackingMethod> methods;
  for (const MethodName& name : names) methods.push_back(make_method(name, apparatus));
  std::vector<MethodFilm> films(methods.size());
  const int n_places = std::min(plan.n_takes, static_cast<int>(places.size()));
  for (int place = 0; place < n_places; ++place) {
    Studio studio(apparatus, places[static_cast<std::size_t>(place)], plan.optics, plan.seed);
    for (int i = place; i < plan.n_takes; i += n_places) studio.film_take(plan, i, methods, films);
  }
  return films;
}

std::vector<TrackedError> MethodFilm::errors() const {
  std::vector<TrackedError> all;
  for (const auto& take : pictures)
    for (const Measured& picture : take) all.push_back(picture.error);
  return all;
}

ErrorSummary summary_of(const std::vector<TrackedError>& errors) {
  double found = 0;  // fraction, of the kind at hand
  const auto quantiles_of = [&](auto TrackedError::*kind) {
    std::vector<double> values;
    for (const TrackedError& error : errors)
      if (const std::optional<double> value = error.*kind) values.push_back(*value);
    found = static_cast<double>(values.size()) / static_cast<double>(errors.size());
    return Quantiles{quantile(values, 0.5), quantile(values, 0.95)};
  };
  ErrorSummary summary;
  summary.n = static_cast<int>(errors.size());
  summary.board_mm = quantiles_of(&TrackedError::board_mm);
  summary.board_found = found;
  summary.board_deg = quantiles_of(&TrackedError::board_deg);
  summary.tip_mm = quantiles_of(&TrackedError::tip_mm);
  summary.effector_found = found;
  summary.effector_deg = quantiles_of(&TrackedError::effector_deg);
  summary.quality = quantiles_of(&TrackedError::quality);
  summary.n_false = static_cast<int>(std::ranges::count_if(errors, &TrackedError::is_false));
  summary.time_ms = quantiles_of(&TrackedError::time_ms);
  return summary;
}

namespace {
FilmPlan plan_for(int width_px, Motion motion, bool quick) {
  FilmPlan plan{width_px, motion, 1, 12, 2, Grip::any, {}, {}};
  if (quick) return plan;
  const int times = width_px == 640 ? 2 : 1;
  plan.n_takes = motion == Motion::hold ? 10 * times : 20 * times;
  plan.n_pictures = motion == Motion::swipe ? 15 : 30;
  return plan;
}
}  // namespace

GoalFilms film_for_goals(int width_px, bool quick, StudyProgress& progress) {
  GoalFilms goal_films;
  goal_films.width_px = width_px;
  const std::vector methods{our_method(width_px), plain_method(width_px)};
  const auto filmed = [&](Motion motion, const std::string& name) {
    progress.next(name + " at " + size_name(width_px));
    auto films = film(plan_for(width_px, motion, quick), methods);
    return GoalFilms::Pair{std::move(films[0]), std::move(films[1])};
  };
  goal_films.strokes = filmed(Motion::stroke, "strokes");
  goal_films.swipes = filmed(Motion::swipe, "swipes");
  goal_films.holds = filmed(Motion::hold, "holds");
  return goal_films;
}

}  // namespace heft
