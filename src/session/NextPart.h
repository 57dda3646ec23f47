// Where a session that goes on writes what it wrote to a file before: beside it. A video can't be
// added to, and a recording must not be mixed with the one of before.
#pragma once

#include <string>

#include "apparatus/SessionSetup.h"

namespace heft {

/// The path itself where nothing is there, else the first free one of "film-2.avi", "film-3.avi"...
std::string next_part(const std::string& path);

/// The options with free paths for the view's video and the kept camera pictures.
Setup with_next_parts(Setup options);

}  // namespace heft
