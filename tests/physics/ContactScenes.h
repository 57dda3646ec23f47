// Contact scenes with the hand's paths, for comparisons of simulators.
#pragma once

#include <functional>
#include <numbers>

#include "base/PoseTypes.h"
#include "physics/Pushes.h"

namespace heft {

struct ContactScene {
  std::string name;
  Scene scene;
  std::function<Pose(double t_s)> path;
  double duration_s = 1.5;
};

namespace contact_scenes {

/// From 0 to 1 with speed and acceleration zero at both ends.
inline double smooth(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10 + s * (6 * s - 15));
}

/// A smooth stroke of the effector, starting 2 mm before a cube at the origin.
inline auto smooth_push(double length_m, double duration_s, double heading_rad = 0,
                        double side_m = 0) {
  return [=](double t_s) {
    Stroke stroke;
    stroke.heading_rad = heading_rad;
    stroke.side_m = side_m;
    stroke.speed_m_s = 1;
    stroke.length_m = length_m;
    return stroke.at(length_m * smooth(t_s / duration_s));
  };
}

inline Scene turned(Scene scene, double yaw_rad) {
  for (Cube& cube : scene.cubes) cube.yaw_rad = yaw_rad;
  return scene;
}

inline Scene cubes(std::vector<Cube> list) {
  Scene scene;
  scene.cubes = std::move(list);
  return scene;
}

inline std::vector<ContactScene> all() {
  std::vector<ContactScene> list;
  for (double grams : {15.0, 200.0, 800.0, 1500.0}) {
    for (double degrees : {0.0, 30.0, 45.0}) {
      const double heading_rad = degrees * std::numbers::pi / 180;
      list.push_back({"push " + std::to_string(int(grams)) + " g " + std::to_string(int(degrees)),
                      turned(one_cube(grams / 1000), heading_rad),
                      smooth_push(0.12, 1.2, heading_rad)});
    }
  }
  list.push_back({"constant push 200 g", one_cube(0.2), along(Stroke{})});
  list.push_back({"tap", one_cube(0.2), [](double t_s) {
                    return upright_pose({-0.0655 + 0.008 * std::sin(20 * t_s), 0, 0.021}, 0);
                  }});
  list.push_back(
      {"press and slide off", one_cube(100), [](double t_s) {
         return upright_pose(
             {-0.0645 + 0.03 * smooth(t_s / 0.4), 0.06 * smooth((t_s - 0.4) / 0.8), 0.021}, 0);
       }});
  list.push_back({"off center", one_cube(0.2), smooth_push(0.08, 1.2, 0, 0.006)});
  list.push_back({"far off center", one_cube(0.1), smooth_push(0.06, 1.2, 0, 0.028)});
  list.push_back({"corner with yaw", turned(one_cube(0.2), 0.5), smooth_push(0.08, 1.2)});
  list.push_back(
      {"squeeze", one_cube(0.2), [](double t_s) {
         return upright_pose(
             {0.005, 0.003, 0.065 - 0.03 * smooth(t_s / 0.6) + 0.03 * smooth((t_s - 0.9) / 0.6)},
             0.1);
       }});
  list.push_back(
      {"three cubes side by side",
       cubes({cube_of(0.015, 0, -0.036), cube_of(0.2), cube_of(0.4, 0, 0.036)}),
       [](double t_s) {  // with the long side
         return upright_pose({-0.04 + 0.08 * smooth(t_s / 1.2), 0, 0.021}, std::numbers::pi / 2);
       }});
  list.push_back(
      {"three cubes one after another",
       cubes({cube_of(0.05, 0, 0.002), cube_of(0.1, 0.06, -0.03), cube_of(0.2, 0.08, 0.05)}),
       smooth_push(0.14, 1.4)});
  list.push_back(
      {"cube into cube", cubes({cube_of(0.1), cube_of(0.1, 0.05)}), smooth_push(0.1, 1.2)});
  list.push_back({"swipe at 2 m/s", one_cube(0.05),
                  [](double t_s) {
                    return upright_pose({-0.3 + 2 * std::min(t_s, 0.25), 0, 0.021}, 0);
                  },
                  0.5});
  list.push_back({"1 g before 100 g", cubes({cube_of(0.001, 0.0), cube_of(0.1, 0.036)}),
                  smooth_push(0.08, 1.2)});
  list.push_back({"1 kg before 1 g", cubes({cube_of(0.3, 0.0), cube_of(0.0003, 0.036)}),
                  smooth_push(0.12, 1.2)});
  return list;
}

/// The scenes with a unique rigid solution. In the others the load of rigid corners is
/// indeterminate, see Scene::contact_compliance_m_per_n, and small differences grow.
inline std::vector<ContactScene> well_posed() {
  std::vector<ContactScene> list = all();
  std::erase_if(list, [](const ContactScene& contact) {
    return contact.name == "far off center" || contact.name == "corner with yaw" ||
           contact.name == "three cubes one after another";
  });
  return list;
}

}  // namespace contact_scenes
}  // namespace heft
