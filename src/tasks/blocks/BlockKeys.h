// Keys that blocks of several tasks share. A block declares its keys, except `name`, in a member
// visit_keys(visit) (base/files/Keys.h); the reader fills the fields by their types, check()
// reports invalid values.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/SimulationChoices.h"
#include "base/files/Keys.h"

namespace heft {

/// The name of a technique, at the key `condition` or `technique`.
template <typename Name>
struct ByTechnique {
  Name& name;
};
template <typename Name>
ByTechnique(Name&) -> ByTechnique<Name>;

/// Number of trials that are rendered with a technique.
struct TechniqueTrials {
  std::string technique;
  int trials = 0;
};

/// A real object that the participant lifts.
struct RealObject {
  static constexpr std::size_t longest_name = 24;  ///< in characters: it is a button

  std::string name;  ///< as the participant reads it
  double mass_g = 0;

  template <typename Visit>
  void visit_keys(Visit&& visit) {
    visit(ConfigKey{"name", "as the participant reads it", true}, name);
    visit(ConfigKey{"mass_g", "of the object", true}, mass_g, above_zero);
  }
};

int total_of(const std::vector<TechniqueTrials>& trials);

/// Trials of each mass or set of cubes: a number with `condition`, or trials = { soft = 3, hard = 3
/// }.
template <typename Trials>
struct TrialsOfEach {
  Trials& trials;
  std::string_view number_key;  ///< "trials_per_mass"
};
template <typename Trials>
TrialsOfEach(Trials&, std::string_view) -> TrialsOfEach<Trials>;

/// More than any session needs; bounds the cost of drawing an order.
inline constexpr int most_trials = 500;

/// Key of blocks whose cubes may differ in friction.
inline constexpr ConfigKey table_friction_key{
    "table_friction", "of the cube of each mass with the table; default: physics.friction"};

/// What a block chooses for its participants to do, by topic, for reports.
using Choices = std::vector<std::pair<std::string, std::string>>;

/// Adds the friction of the block's cubes, if they have their own.
void add_friction(Choices& choices, const std::string& block, const std::vector<double>& masses_g,
                  const std::vector<double>& table_friction);

/// Checks the number of masses, and that there is a friction for each.
ConfigMistakes mistakes_in_number_of_cubes(const std::vector<double>& masses_g,
                                           const std::vector<double>& table_friction,
                                           std::size_t fewest, std::size_t most);

/// The same, and that masses differ.
/// @param why reason why equal ones are refused
/// @param or_friction cubes of one mass may differ in friction instead
ConfigMistakes mistakes_in_cubes(const std::vector<double>& masses_g,
                                 const std::vector<double>& table_friction, std::size_t fewest,
                                 std::size_t most, std::string_view why, bool or_friction = false);

}  // namespace heft
