// A setup as the JSON object that its event carries: every column, and the contents of its files.
#pragma once

#include <string>

#include "experiment/SessionConfig.h"

namespace heft {

std::string to_json(const SessionConfig& setup);

/// What the text does not have keeps its default: it came after the text was written.
/// @throws Error when it is no such object
SessionConfig setup_from_json(const std::string& text);

}  // namespace heft
