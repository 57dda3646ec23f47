#include "bench/tracking/Limits.h"

namespace heft {

namespace {
constexpr int width_px = 640;
constexpr std::uint64_t seed = 4;

MethodName bias_left_in() {
  MethodName name = our_method(width_px);
  name.refinement = "edges";
  return name;
}

// A picture on its own: what came before is forgotten.
TrackedError one_error(TrackingMethod& method, const LimitScene& scene, const Image& picture) {
  method.reset();
  return error_of(method.track(picture, 0), scene.settings.camera_from_board,
                  scene.take.at(scene.t_s), tip_of(scene.apparatus.effector));
}

LimitPoint at_value(const Limit& limit, double value, int n_pictures) {
  const LimitScene first = limit.scene(value, 0);  // they differ in their takes alone
  SyntheticCamera camera(first.apparatus, first.settings, seed);
  const auto our = make_method(our_method(width_px), first.apparatus);
  const auto without = make_method(bias_left_in(), first.apparatus);
  const auto plain = make_method(plain_method(width_px), first.apparatus);
  std::vector<TrackedError> our_errors, without_errors, plain_errors;
  for (int i = 0; i < n_pictures; ++i) {
    const auto number = static_cast<std::uint64_t>(i);
    const LimitScene scene = limit.scene(value, number);
    const Image picture =
        camera.picture([&](double t_s) { return scene.take.at(t_s); }, scene.t_s, number);
    our_errors.push_back(one_error(*our, scene, picture));
    without_errors.push_back(one_error(*without, scene, picture));
    plain_errors.push_back(one_error(*plain, scene, picture));
  }
  return {limit.name, value, summary_of(our_errors), summary_of(without_errors),
          summary_of(plain_errors)};
}

void write(const std::vector<LimitPoint>& points, const StudyOptions& options) {
  CsvFile csv(options, "limits.csv",
              "limit,value,method,refinement,pictures,board_found,effector_found,board_p95_mm,tip_"
              "median_mm,"
              "tip_p95_mm,effector_p95_deg");
  for (const LimitPoint& point : points)
    for (const auto& [name, s] : {std::pair{our_method(width_px), point.ours},
                                  {bias_left_in(), point.bias_left_in},
                                  {plain_method(width_px), point.plain}})
      csv.row(point.limit, point.value, name.detector, name.refinement, s.n, s.board_found,
              s.effector_found, or_nan(s.board_p95_mm), or_nan(s.tip_median_mm),
              or_nan(s.tip_p95_mm), or_nan(s.effector_p95_deg));
}
}  // namespace

std::vector<LimitPoint> study_limits(const StudyOptions& options, StudyProgress& progress) {
  std::vector<LimitPoint> points;
  for (const Limit& limit : limits()) {
    progress.next("limits: " + limit.name);
    const auto n_values = options.quick ? 2 : limit.values.size();
    for (std::size_t i = 0; i < n_values; ++i)
      points.push_back(at_value(limit, limit.values[i], options.quick ? 1 : 32));
  }
  write(points, options);
  draw(options, "limits", limits_chart(points, options));
  return points;
}

}  // namespace heft
