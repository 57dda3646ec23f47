// The log of an earlier program, tests/golden/logs/version_5.db, to be upgraded.
#pragma once

#include <filesystem>
#include <string>

#include "SourceFolder.h"

namespace heft::test {

/// Puts a copy that may be written to `file`.
inline void copy_older_log(const std::string& file) {
  namespace fs = std::filesystem;
  fs::copy_file(fs::path(source_folder()) / "tests/golden/logs/version_5.db", file,
                fs::copy_options::overwrite_existing);
  fs::permissions(file, fs::perms::owner_write, fs::perm_options::add);
}

}  // namespace heft::test
