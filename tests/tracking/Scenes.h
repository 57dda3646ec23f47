// The default apparatus (A4 board of 6 x 4 tags, box effector with five tags at its tip) and random
// poses of its effector, for tests.
#pragma once

#include <cmath>

#include "base/Random.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {

inline MarkerBody grid_board(int columns, int rows, double tag_m, double pitch_m) {
  MarkerBody board;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double x = (column - (columns - 1) / 2.0) * pitch_m;
      const double y = ((rows - 1) / 2.0 - row) * pitch_m, h = tag_m / 2;
      board.tags.push_back({row * columns + column,
                            {Eigen::Vector3d(x - h, y + h, 0), Eigen::Vector3d(x + h, y + h, 0),
                             Eigen::Vector3d(x + h, y - h, 0), Eigen::Vector3d(x - h, y - h, 0)}});
    }
  return board;
}

inline const SyntheticCamera::EffectorPath out_of_view = [](double) { return std::nullopt; };

/// @param tag_m 0: none
inline MarkerBody box_effector(double tag_m) {
  MarkerBody effector;
  effector.size_m = {0.09, 0.04, 0.04};
  if (tag_m == 0) return effector;
  int id = 30;
  for (const BoxFace face :
       {BoxFace::tip, BoxFace::top, BoxFace::left, BoxFace::right, BoxFace::bottom}) {
    const Eigen::Vector2d center_m(0, face == BoxFace::tip ? 0 : 0.025);
    effector.tags.push_back(tag_on(face_frame(effector.size_m, face), id++, center_m, tag_m));
  }
  return effector;
}

inline Apparatus default_apparatus(int width_px) {
  return {default_camera(width_px, width_px == 640 ? 480 : 720), grid_board(6, 4, 0.040, 0.048),
          box_effector(0.032)};
}

/// Held from behind above the board, the tip away from the participant, as people hold a stick.
inline Pose random_held_pose(RandomStream& random) {
  const auto within = [&](double half) { return half * (2 * random.uniform() - 1); };
  const double yaw = M_PI / 2 + within(0.7), pitch = 0.1 + within(0.4), roll = within(0.6);
  const Eigen::Quaterniond q = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
  return {{within(0.08), -0.02 + within(0.05), 0.045 + within(0.02)}, q};
}

}  // namespace heft
