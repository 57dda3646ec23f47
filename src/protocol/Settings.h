// Changes to a parsed file from the command line: "coupling.stiffness_n_per_m=100",
// "block.sorting.trials=4" (an array's table is named by its `name`, or by its kind).
#pragma once

#include <string>
#include <vector>

#include "protocol/TomlDocument.h"

namespace heft {

/// Puts each setting's value, written as in TOML, at its place in the tree. A key that the tree
/// does not hold is added, for the file's own reader to judge.
/// @throws Error (usage) for a setting without "=", with a value that is no TOML, or on no table
void apply_settings(TomlTable& root, const std::vector<std::string>& settings);

}  // namespace heft
