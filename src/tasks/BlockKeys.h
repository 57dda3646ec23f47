// How a task's block describes the keys that protocols give it. Its visit_keys(visit) calls
// visit(key, field) for each key but `name`; the reader fills the fields by their types. `check()`
// says what is wrong with a block's values, whoever filled it in.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/DefaultTechniques.h"

namespace heft {

struct BlockKey {
  std::string_view name;
  bool required = false;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool high_open = false;  ///< `high` itself is refused
};

/// A mistake in a block's values: the key, the value's place in it where it is a list, and what was
/// found and expected.
struct KeyMistake {
  std::string key;
  std::optional<std::size_t> index;
  std::string message;
  std::vector<std::string> also = {};  ///< other keys that it is about
};

/// The least mass of a cube, g: below it is only underflow.
inline constexpr double least_mass_g = 1e-9;

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

/// Trials of each mass: `trials_per_mass` with `condition`, or trials = { C1 = 3, C2 = 3 }.
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
std::vector<KeyMistake> mistakes_in_masses(const std::vector<double>& masses_g, std::size_t fewest,
                                           std::size_t most, std::string_view why);

}  // namespace heft
