// What a failed write tells the person in front of the screen.
#pragma once

#include <exception>
#include <optional>
#include <string>

#include "base/Error.h"
#include "experiment/Event.h"

namespace heft {

class LogFile;

/// `the answer "label cube 2 heaviest" of trial 7`, `the event "cubes_reset" of trial 7`
std::string description(const Event& event, std::optional<int> trial_number);

/// What could not be saved, where, why, and what to do.
/// @param reason what was caught: SQLite's exception, DisplacedLog, or a row that can't be kept
/// @param next what to do once the cause is gone, e.g. "start again"
Error write_error(const std::string& what, const LogFile& file, const std::exception& reason,
                  const std::string& next);

}  // namespace heft
