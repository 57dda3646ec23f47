// Parameter files: flat `key = value` TOML whose keys another room knows (a responder's
// parameters).
#pragma once

#include <string>
#include <vector>

#include "experiment/Parameter.h"

namespace heft {

/// The file's parameters in its order. Tables and arrays are refused.
/// @throws InvalidFile with every mistake at its place
std::vector<Parameter> parse_parameters(const std::string& text, const std::string& file);

}  // namespace heft
