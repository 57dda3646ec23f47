// A temporary folder, logs of earlier versions to copy into it, and the message of a failing call.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include "SourceFolder.h"
#include "base/Error.h"

namespace heft::test {

/// Removed with its contents.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_(::testing::TempDir() + "heft-record-XXXXXX") {
    if (::mkdtemp(path_.data()) == nullptr) throw std::runtime_error("no temporary folder");
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all, error);
    std::filesystem::remove_all(path_, error);
  }

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// Copies the log of an earlier version (tests/golden/logs) to a writable file.
inline void copy_older_log(const std::string& file, int version = 5) {
  namespace fs = std::filesystem;
  fs::copy_file(fs::path(source_folder()) / fmt::format("tests/golden/logs/version_{}.db", version),
                file, fs::copy_options::overwrite_existing);
  fs::permissions(file, fs::perms::owner_write, fs::perm_options::add);
}

/// @return the message of the Error that `work` throws; empty if it throws none
template <typename Work>
std::string failure(Work&& work) {
  try {
    std::forward<Work>(work)();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace heft::test
