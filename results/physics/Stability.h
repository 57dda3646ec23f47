// Map of failures: every method at every rate, over decades of spring stiffness, torsional
// stiffness, damping, cube mass, and mass of a second cube that is pushed along.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/Names.h"
#include "results/Study.h"
#include "results/physics/scenes/Measurements.h"

namespace heft {

/// The varied parameter; the others are the paper's.
enum class Varied { stiffness, torsional_stiffness, damping, cube_mass, second_cube_mass };

inline constexpr std::array all_varied{Varied::stiffness, Varied::torsional_stiffness,
                                       Varied::damping, Varied::cube_mass,
                                       Varied::second_cube_mass};

template <>
struct EnumNames<Varied> {
  static constexpr std::array<std::string_view, 5> names{
      "stiffness_n_per_m", "torsional_stiffness_nm_per_rad", "damping_ratio", "cube_mass_kg",
      "second_cube_mass_kg"};
};

/// From mild to severe.
enum class Verdict {
  stable,
  creeps,      ///< a cube moves by more than a micrometer while the hand is still
  rings,       ///< the clone moves back and forth by more than 20 um while the hand is still
  penetrates,  ///< boxes overlap by more than 0.1 mm
  wrong_lag,   ///< at the end of the stroke, by more than 2 % and 0.1 mm
  blows_up,
  outside_model  ///< the scene is outside the simulator's model
};

template <>
struct EnumNames<Verdict> {
  static constexpr std::array<std::string_view, 7> names{
      "stable", "creeps", "rings", "penetrates", "wrong_lag", "blows_up", "outside_model"};
};

/// A push of 10 cm at 0.1 m/s, then a second of rest; of two cubes, one 5 mm behind the other, by
/// the effector's long side.
BenchScene stability_scene(Varied varied, double value);

/// The most severe fault of a run through a stability_scene.
/// @param reference at reference_rate_hz
Verdict judge(const SimulatorEntry& simulator, const BenchScene& scene, const SceneTrack& reference,
              int rate_hz);

struct StabilityCell {
  std::string simulator;
  Varied varied = Varied::stiffness;
  double value = 0;
  int rate_hz = 0;
  Verdict verdict = Verdict::stable;
};

/// The values of a parameter in the map.
std::vector<double> values_of(Varied varied, bool quick);

/// stability.csv and stability.svg
void study_stability(const StudyOptions& options);

void draw_stability(const StudyOptions& options, const std::vector<StabilityCell>& cells);

}  // namespace heft
