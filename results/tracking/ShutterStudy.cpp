// How exactly a rolling shutter's read-out is found from a board that is waved. The synthetic
// camera's board lies on the table, so the one that is waved is an effector: a thin box with the
// board's tags on it.
#include <cmath>

#include "results/tracking/faults/FaultStudy.h"
#include "tracking/calibration/ShutterCalibration.h"

namespace heft {

namespace {
constexpr int width_px = 640;

Apparatus waved_board() {
  Apparatus apparatus = bench_apparatus(width_px);
  apparatus.effector = apparatus.board;
  apparatus.effector.size_m = {0.30, 0.20, 0.002};
  for (Tag& tag : apparatus.effector.tags)
    for (Eigen::Vector3d& corner_m : tag.corners_m) corner_m.z() = 0.001;
  apparatus.board.tags.clear();
  return apparatus;
}

// To and fro, up and down, and turned, as people do: up to .4 m/s.
Pose waved(double t_s) {
  const Eigen::Vector3d way_m(0.03 * std::sin(9 * t_s), 0.025 * std::sin(7 * t_s + 1),
                              0.02 * std::sin(5 * t_s));
  return {Eigen::Vector3d(0, 0, 0.06) + way_m,
          Eigen::Quaterniond(Eigen::AngleAxisd(0.1 * std::sin(6 * t_s), Eigen::Vector3d::UnitZ()))};
}
}  // namespace

Goal find_readout(bool quick) {
  constexpr double readout_s = 0.025;
  const Apparatus apparatus = waved_board();
  SyntheticSettings settings;
  settings.hand = false;
  settings.motion_samples = 1;
  settings.optics.readout_s = readout_s;
  SyntheticCamera camera(apparatus, settings, 1);
  TagViewer viewer(apparatus.effector);
  std::vector<TimedView> views;
  for (int i = 0; i < (quick ? 4 : 40); ++i) {
    const double t_s = i / film_rate_hz;
    const Image picture =
        camera.picture([](double at_s) { return waved(at_s); }, t_s, static_cast<std::uint64_t>(i));
    views.push_back({t_s, viewer.view(picture, apparatus.camera)});
  }
  const auto found = calibrate_shutter(apparatus.effector, apparatus.camera, views);
  return {fmt::format("read-out of 25 ms found from {} pictures of a waved board at {}, error",
                      views.size(), size_name(width_px)),
          1, "ms", false, 1e3 * std::abs(found.readout_s - readout_s)};
}

}  // namespace heft
