// Scenes and strokes that the physics tests share.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "base/PoseTypes.h"
#include "physics/DecouplingSimulator.h"

namespace heft {

/// Names of the simulators in the table that satisfy a condition.
template <typename Holds>
std::vector<std::string> simulators_where(const Holds& holds) {
  std::vector<std::string> names;
  for (const SimulatorEntry& entry : simulators())
    if (holds(entry)) names.emplace_back(entry.name);
  return names;
}

/// Simulators that model every hand movement.
inline const std::vector<std::string> every_solver = simulators_where(
    [](const SimulatorEntry& entry) { return entry.for_sessions && entry.fit_for.several_cubes; });
/// Simulators of one straight push.
inline const std::vector<std::string> every_straight_one =
    simulators_where([](const SimulatorEntry& entry) { return !entry.for_sessions; });

/// A hand that stays where it is.
inline auto held(const Pose& pose) {
  return [pose](double) { return pose; };
}

inline Cube cube_of(double mass_kg, double x_m = 0, double y_m = 0) {
  Cube cube;
  cube.mass_kg = mass_kg;
  cube.position_m = {x_m, y_m, 0.0175};
  return cube;
}

inline Scene one_cube(double mass_kg) {
  Scene scene;
  scene.cubes = {cube_of(mass_kg)};
  return scene;
}

/// The effector, tip first, from 2 mm before a cube at the origin, at constant speed, then still.
struct Stroke {
  double speed_m_s = 0.1;
  double length_m = 0.1;
  double heading_rad = 0;  ///< the direction of the stroke and of the effector
  double side_m = 0;       ///< of the effector from the line through the cube's center
  double height_m = 0.021;

  Eigen::Vector3d direction() const { return {std::cos(heading_rad), std::sin(heading_rad), 0}; }
  double duration_s() const { return length_m / speed_m_s; }

  Pose at(double t_s) const {
    const double along_m = -0.0645 + std::min(std::max(t_s, 0.0) * speed_m_s, length_m);
    const Eigen::Vector3d across(-std::sin(heading_rad), std::cos(heading_rad), 0);
    Eigen::Vector3d at_m = along_m * direction() + side_m * across;
    at_m.z() = height_m;
    return upright_pose(at_m, heading_rad);
  }
};

/// Steps a world along a path; `see(t_s, target, state)` is called after each step.
template <typename Path, typename See>
WorldState run(DecouplingSimulator& simulator, const Scene& scene, const Path& path,
               double duration_s, double rate_hz, const See& see) {
  simulator.reset(scene, path(0.0));
  const int n = static_cast<int>(std::lround(duration_s * rate_hz));
  for (int i = 1; i <= n; ++i) {
    const double t_s = i / rate_hz;
    const Pose target = path(t_s);
    simulator.step(target, 1 / rate_hz);
    see(t_s, target, simulator.state());
  }
  return simulator.state();
}

template <typename Path>
WorldState run(DecouplingSimulator& simulator, const Scene& scene, const Path& path,
               double duration_s, double rate_hz = 240) {
  return run(simulator, scene, path, duration_s, rate_hz,
             [](double, const Pose&, const WorldState&) {});
}

inline auto along(const Stroke& stroke) {
  return [stroke](double t_s) { return stroke.at(t_s); };
}

}  // namespace heft
