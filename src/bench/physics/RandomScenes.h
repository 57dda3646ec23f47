// Scenes as people make them: hands that start and stop, sway, tremble and turn, seen by a camera,
// among cubes that stand alone, staggered, stacked or in a row. What a rate keeps in all but a few
// of a thousand of these is what it may promise.
#pragma once

#include <array>
#include <cstdint>

#include "bench/physics/Scenes.h"

namespace heft {

/// What is in a random scene.
enum class Setting {
  straight,
  one,
  aside,
  turning,
  pair,
  staggered,
  row,
  stack,
  tower,
  thrown,
  gain,
  speed_limit
};

template <>
struct EnumNames<Setting> {
  static constexpr std::array<std::string_view, 12> names{
      "straight", "one",   "aside", "turning", "pair", "staggered",
      "row",      "stack", "tower", "thrown",  "gain", "speed_limit"};
};

/// Whether rigid bodies have one answer. A cube on four corners that is made to turn, or to carry,
/// has many.
constexpr bool has_one_answer(Setting setting) {
  return setting != Setting::aside && setting != Setting::turning && setting != Setting::stack &&
         setting != Setting::tower;
}

/// Poses a second of its path.
int poses_hz_of(const BenchScene& random_scene);

/// The n-th of a seed: the same on every machine, so that any one can be looked at alone. Where
/// rigid bodies have more than one answer, contacts give a little.
BenchScene random_scene(Setting setting, std::uint64_t seed, int n);

}  // namespace heft
