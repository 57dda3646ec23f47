// What sessions of versions 1 and 2 were run with. They told it in their headers (run_options, a
// JSON object) and in deviations, {"option", "from", "to"} each, when they went on with something
// else. Private to this room.
#pragma once

#include <optional>
#include <string>

#include "experiment/Setup.h"
#include "record/SessionHeader.h"

namespace heft {

/// What it was started with. A simulator that was not named is the protocol's and stays empty.
/// @throws Error when the header's options can't be read
Setup older_setup(const SessionHeader& header);

/// The setup after a deviation of that kind; none for any other deviation.
std::optional<Setup> after_deviation(const Setup& setup, const std::string& detail);

}  // namespace heft
