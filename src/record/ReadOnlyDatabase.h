// Opening a log for reading, wherever it lies: beside a running writer, after a crash, or on a
// medium that can't be written.
#pragma once

#include <memory>
#include <string>

namespace SQLite {
class Database;
}

namespace heft {

/// @throws Error when there is no such file, or it can't be read
std::unique_ptr<SQLite::Database> open_for_reading(const std::string& path);

}  // namespace heft
