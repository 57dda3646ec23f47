// How people hold and move the effector over the board: what the synthetic camera films. Seeded, so
// that every run films the same.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {

/// The shipped apparatus: A4 board of 6 x 4 tags, box effector with a tag on five faces, or the
/// wider one with slanted faces (effector_two_faces.toml).
enum class EffectorBody { box, two_faces };
struct EffectorPrint {
  double tag_m = 0.032;
  double tip_margin_m = 0.004;            ///< white between the tags and the tip's edge
  bool only_top = false;                  ///< a single tag, on the top face
  EffectorBody body = EffectorBody::box;  ///< the other one's tags are as its file has them
};
Apparatus bench_apparatus(int width_px, const EffectorPrint& print = {});

/// Held from behind above the board, as people do who know that its tags must be seen: the tip away
/// from the participant within 40 deg and 14 deg lowered to 3 deg raised, its middle 25 to 55 mm
/// above the table.
enum class Grip {
  any,       ///< rolled by up to 34 deg; often the top face alone is seen
  two_faces  ///< rolled by 40 to 57 deg to either side, the tip away within 17 deg
};
Pose random_grip(std::uint64_t seed, std::uint64_t number, Grip grip = Grip::any);

enum class Motion {
  stroke,  ///< to and fro along a random direction in the table's plane, 0.4 m/s in the middle
  swipe,   ///< from rest to 0.5 m/s within 0.1 s, straight on for 0.24 s, back to rest
  hold     ///< stays where it is
};

/// One grip and how it moves. Starts at 0 s.
struct Take {
  Pose grip;  ///< in the middle of the motion
  Eigen::Vector3d direction;
  Motion motion = Motion::stroke;

  Pose at(double t_s) const;
  double speed_m_s(double t_s) const;  ///< of the effector's center
};

Take take(Motion motion, std::uint64_t seed, std::uint64_t number, Grip grip = Grip::any);

inline constexpr double film_rate_hz = 30;

}  // namespace heft
