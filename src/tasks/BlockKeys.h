// What blocks of several tasks have among their keys. A block declares them as base/files/Keys.h
// says, in a member visit_keys(visit), all but `name`; the reader fills the fields by their types.
// `check()` says what is wrong with a block's values, from a file or not.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/SimulationChoices.h"
#include "base/files/Keys.h"

namespace heft {

/// A technique by its name, at `condition` or `technique`.
template <typename Name>
struct ByTechnique {
  Name& name;
};
template <typename Name>
ByTechnique(Name&) -> ByTechnique<Name>;

/// So many trials are rendered with this technique.
struct TechniqueTrials {
  std::string technique;
  int trials = 0;
};

int total_of(const std::vector<TechniqueTrials>& trials);

/// Trials of each mass: `trials_per_mass` with `condition`, or trials = { soft = 3, hard = 3 }.
template <typename Trials>
struct TrialsOfEachMass {
  Trials& trials;
};
template <typename Trials>
TrialsOfEachMass(Trials&) -> TrialsOfEachMass<Trials>;

/// Beyond any session, and what drawing an order takes.
inline constexpr int most_trials = 500;

/// What is wrong with masses of cubes of which each is there once.
/// @param why equal ones are refused
ConfigMistakes mistakes_in_masses(const std::vector<double>& masses_g, std::size_t fewest,
                                  std::size_t most, std::string_view why);

}  // namespace heft
