// Keys that blocks of several tasks share. A block declares its keys, except `name`, in a member
// visit_keys(visit) (base/files/Keys.h); the reader fills the fields by their types, check()
// reports invalid values.
#pragma once

#include <string>
#include <string_view>
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

int total_of(const std::vector<TechniqueTrials>& trials);

/// Trials of each mass: `trials_per_mass` with `condition`, or trials = { soft = 3, hard = 3 }.
template <typename Trials>
struct TrialsOfEachMass {
  Trials& trials;
};
template <typename Trials>
TrialsOfEachMass(Trials&) -> TrialsOfEachMass<Trials>;

/// More than any session needs; bounds the cost of drawing an order.
inline constexpr int most_trials = 500;

/// Checks masses that must all differ.
/// @param why reason why equal masses are refused
ConfigMistakes mistakes_in_masses(const std::vector<double>& masses_g, std::size_t fewest,
                                  std::size_t most, std::string_view why);

}  // namespace heft
