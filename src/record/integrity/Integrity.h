// Whether a log is sound as a file: for doctor and replay.
#pragma once

#include <string>
#include <vector>

namespace heft {

/// Pages, types, rules and references of the whole file, as SQLite checks them.
/// @return a sentence for each fault found; empty when the file is sound
/// @throws Error when it can't be read at all or is no heft log
std::vector<std::string> check_integrity(const std::string& path);

}  // namespace heft
