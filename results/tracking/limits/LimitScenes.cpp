// What stands in front of the camera at each limit.
#include <cmath>

#include "base/Random.h"
#include "results/tracking/TrackingStudy.h"

namespace heft {

namespace {
constexpr int width_px = 640;
constexpr std::uint64_t seed = 4;
constexpr double usual_distance_m = 0.45, usual_pitch_rad = 52 * M_PI / 180;
constexpr double px_per_m = 540 / usual_distance_m;  // across the line of sight
constexpr double cells_per_tag = 8;

LimitScene usual(std::uint64_t number, const EffectorPrint& print = {}) {
  return {bench_apparatus(width_px, print), {}, take(Motion::hold, seed, number), 0};
}

using SceneOf = std::function<LimitScene(double, std::uint64_t)>;

Limit limit(const char* name, const char* label, std::vector<double> values, SceneOf scene,
            bool logarithmic = false) {
  return {name, label, logarithmic, std::move(values), std::move(scene)};
}

template <typename Change>
SceneOf changed(Change change) {
  return [change](double value, std::uint64_t number) {
    LimitScene scene = usual(number);
    change(scene, value);
    return scene;
  };
}

LimitScene small_tags(double side_px, std::uint64_t number) {
  return usual(number, {side_px / px_per_m, 0.004});
}

LimitScene tags_under_fingers(double margin_mm, std::uint64_t number) {
  return usual(number, {0.032, margin_mm / 1e3});
}

// A single tag, nothing in front of it, seen from so many degrees off its front.
LimitScene oblique(double off_deg, std::uint64_t number) {
  LimitScene scene = usual(number, {0.032, 0.004, true});
  scene.settings.hand = false;
  RandomStream random(seed, "oblique", number);
  const Pose& camera_from_board = scene.settings.camera_from_board;
  const Eigen::Vector3d middle_m(0, 0, 0.1);
  const Eigen::Vector3d eye_m =
      camera_from_board.orientation.conjugate() * -camera_from_board.position_m;
  const Eigen::Vector3d sight = (eye_m - middle_m).normalized();
  const auto towards = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), sight);
  const double way = 2 * M_PI * random.uniform(), spin = 2 * M_PI * random.uniform();
  const Eigen::Vector3d axis = towards * Eigen::Vector3d(std::cos(way), std::sin(way), 0);
  scene.take.grip = {middle_m, Eigen::AngleAxisd(off_deg * M_PI / 180, axis) * towards *
                                   Eigen::AngleAxisd(spin, Eigen::Vector3d::UnitZ())};
  return scene;
}

// The middle of a swipe; the shutter stays open until a point has moved so many cells.
LimitScene smeared(double cells, std::uint64_t number) {
  LimitScene scene = usual(number);
  scene.take = take(Motion::swipe, seed, number);
  scene.t_s = 0.22;
  const double cell_m = 0.032 / cells_per_tag;
  scene.settings.optics.exposure_s = cells * cell_m / scene.take.speed_m_s(scene.t_s);
  return scene;
}
}  // namespace

std::vector<Limit> limits() {
  using S = LimitScene;
  const auto noise = [](S& s, double sd) { s.settings.optics.noise = sd; };
  const auto blur = [](S& s, double sd_px) { s.settings.optics.blur_px = sd_px; };
  const auto exposure = [](S& s, double light) { s.settings.optics.exposure = light; };
  const auto distance = [](S& s, double distance_m) {
    s.settings.camera_from_board = camera_above_board(distance_m, usual_pitch_rad);
  };
  const auto tone = [](S& s, double gamma) { s.settings.optics.gamma = gamma; };
  return {limit("tag_size_px", "side of the effector's tags (pixels)",
                {38, 32, 27, 23, 20, 17, 14, 11}, small_tags),
          limit("obliqueness_deg", "single tag, angle off its front (degrees)",
                {0, 15, 30, 45, 60, 68, 74, 80}, oblique),
          limit("motion_blur_cells", "motion during the exposure (cells of a tag)",
                {0, 0.25, 0.5, 0.75, 1, 1.4, 1.8, 2.4}, smeared),
          limit("noise_sd", "noise (gray levels of 255, SD)", {0, 3, 6, 10, 15, 20, 30},
                changed(noise)),
          limit("defocus_px", "blur by lens and focus (pixels, SD)",
                {0.4, 0.6, 0.9, 1.2, 1.6, 2, 2.5, 3}, changed(blur)),
          limit("exposure", "light (1: paper just below white)",
                {0.05, 0.1, 0.2, 0.4, 0.7, 1, 1.4, 2, 3}, changed(exposure), true),
          limit("tags_from_tip_mm", "tags moved towards the fingers (mm from the tip)",
                {4, 8, 12, 16, 20, 26, 34, 42}, tags_under_fingers),
          limit("distance_m", "camera to board (m)", {0.3, 0.4, 0.5, 0.65, 0.8, 1, 1.25, 1.5},
                changed(distance)),
          limit("gamma", "tone curve (gamma; 1: linear, elsewhere here: sRGB)",
                {2.2, 2, 1.8, 1.6, 1.4, 1.2, 1}, changed(tone))};
}

}  // namespace heft
