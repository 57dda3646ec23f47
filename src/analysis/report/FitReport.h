// Fits as text for people and as JSON for programs.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "inference/Fit.h"

namespace heft {

struct NamedFit {
  std::optional<std::string> group;
  Fit fit;
};

/// A table a group, and why there is no threshold where there is none.
std::string fits_as_text(std::span<const NamedFit> fits);

/// A list of objects: group, parameters (value, se, low, high, fixed; null for what does not
/// exist), log_likelihood, n_trials, identifiable, why (null where identifiable); indecision has
/// threshold_75_g beside the parameters too.
std::string fits_as_json(std::span<const NamedFit> fits);

}  // namespace heft
