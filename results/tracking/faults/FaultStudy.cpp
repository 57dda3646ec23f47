#include "results/tracking/faults/FaultStudy.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tracking/camera/Intrinsics.h"

namespace heft {

namespace {
constexpr std::uint64_t seed = 12;
// The camera's tone curve is learned from the first pictures, which are not counted. Of a moving
// effector, only pictures after some others count.
constexpr int unmeasured = 4, run_up = 2, measured_in_motion = 2;
constexpr int n_measured = 200;           // pictures a point
constexpr double between_takes_s = 0.37;  // no multiple of what changes over time

struct Moving {
  Pose grip;  ///< at middle_s
  Eigen::Vector3d velocity_m_s;
  double middle_s;

  Pose at(double t_s) const {
    return {grip.position_m + (t_s - middle_s) * velocity_m_s, grip.orientation};
  }
};

Moving moving(double speed_m_s, std::uint64_t number) {
  const Take one = take(Motion::stroke, seed, number);
  return {one.grip, speed_m_s * one.direction, between_takes_s * static_cast<double>(number)};
}

// When the row is read in which the effector's center is seen.
double own_row_s(const FaultScene& scene, const Moving& path, double t_s) {
  const Intrinsics& camera = scene.apparatus.camera;
  const Eigen::Vector3d at_m = scene.settings.camera_from_board * path.at(t_s).position_m;
  return camera.readout_s * project(camera, at_m).y() / camera.height_px;
}

// One fault of one size by both trackers.
class FaultFilm {
 public:
  FaultFilm(const Fault& fault, double value, int width_px)
      : scene_(changed(fault, value, width_px)),
        camera_(scene_.apparatus, scene_.settings, seed),
        methods_{make_method(our_method(width_px), scene_.apparatus),
                 make_method(plain_method(width_px), scene_.apparatus)} {}

  // Until so many pictures are measured.
  void add(int n_first, int n_pictures) {
    const auto n = static_cast<std::size_t>(n_pictures);
    for (int i = 0; errors_[0].size() < n; ++i) {
      const auto number = static_cast<std::uint64_t>(i);
      const Moving path = moving(scene_.speed_m_s, number);
      for (const TrackingMethod& method : methods_) method.reset();
      n_lost_ = 0;
      const bool is_film = scene_.speed_m_s > 0 || scene_.apparatus.camera.readout_s > 0;
      const int last = is_film ? run_up + measured_in_motion : 1;
      const int middle = last / 2;
      for (int picture = 0; picture < last; ++picture)
        add_picture(path, path.middle_s + (picture - middle) / film_rate_hz,
                    8 * number + static_cast<std::uint64_t>(picture),
                    i >= n_first && (last == 1 || picture >= run_up));
    }
  }

  const std::vector<TrackedError>& errors(std::size_t method) const { return errors_[method]; }

 private:
  static FaultScene changed(const Fault& fault, double value, int width_px) {
    FaultScene scene{bench_apparatus(width_px), {}};
    fault.change(scene, value);
    return scene;
  }

  void add_picture(const Moving& path, double t_s, std::uint64_t number, bool counts) {
    if (camera_.drops(number)) return static_cast<void>(++n_lost_);
    const double seen_s = t_s + own_row_s(scene_, path, t_s);
    // By a file without times, a lost picture's time is the next one's.
    const double late_s = scene_.has_times ? 0 : n_lost_ / film_rate_hz;
    const Image image = camera_.picture([&](double at_s) { return path.at(at_s); }, t_s, number);
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const MethodPoses poses = methods_[m].track(image, t_s - late_s);
      const Pose truth = path.at(poses.effector_t_s ? *poses.effector_t_s + late_s : seen_s);
      if (counts)
        errors_[m].push_back(error_of(poses, scene_.settings.camera_from_board, truth,
                                      tip_of(scene_.apparatus.effector)));
    }
  }

  FaultScene scene_;
  SyntheticCamera camera_;
  std::array<TrackingMethod, 2> methods_;
  std::array<std::vector<TrackedError>, 2> errors_;
  int n_lost_ = 0;  ///< pictures of this take
};

void write(const std::vector<FaultPoint>& points, const StudyOptions& options) {
  CsvFile csv(options, "faults.csv",
              "fault,value,picture,method,pictures,effector_found,board_p95_mm,tip_median_mm,tip_"
              "p95_mm,quality_median,false_poses");
  for (const FaultPoint& point : points)
    for (const bool ours : {true, false}) {
      const ErrorSummary& s = ours ? point.ours : point.plain;
      csv.row(point.fault, point.value, size_name(point.width_px),
              ours ? "heft" : "apriltag + solvePnP", s.n, s.effector_found, or_nan(s.board_mm.p95),
              or_nan(s.tip_mm.median), or_nan(s.tip_mm.p95),
              ours ? or_nan(s.quality.median) : or_nan({}), s.n_false);
    }
}
}  // namespace

const FaultPoint* point_of(const std::vector<FaultPoint>& points, const std::string& fault,
                           double value, int width_px) {
  const auto at = std::ranges::find_if(points, [&](const FaultPoint& point) {
    return point.fault == fault && point.value == value && point.width_px == width_px;
  });
  return at == points.end() ? nullptr : &*at;
}

std::vector<FaultPoint> study_faults(const StudyOptions& options, StudyProgress& progress) {
  std::vector<FaultPoint> points;
  for (const int width_px : picture_widths_px) {
    progress.next("faults of cameras at " + size_name(width_px));
    for (const Fault& fault : faults())
      for (std::size_t i = 0; i < (options.quick ? 1 : fault.values.size()); ++i) {
        FaultFilm film(fault, fault.values[i], width_px);
        film.add(options.quick ? 0 : unmeasured, options.quick ? 1 : n_measured);
        points.push_back({fault.name, fault.values[i], width_px, summary_of(film.errors(0)),
                          summary_of(film.errors(1))});
      }
  }
  write(points, options);
  draw_faults(points, options);
  return points;
}

}  // namespace heft
