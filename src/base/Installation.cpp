#include "base/Installation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/auxv.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <vector>

#include "base/Error.h"

namespace heft {

namespace {

std::filesystem::path program_folder() {
  std::error_code none;
  std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
  if (none)  // a root without /proc: as the program was called
    program = std::filesystem::canonical(reinterpret_cast<const char*>(getauxval(AT_EXECFN)));
  return program.parent_path();
}

// The parts of a list with colons, such as PATH holds.
std::vector<std::filesystem::path> listed(const char* variable, const char* without_it) {
  const char* value = std::getenv(variable);
  std::istringstream list(value && *value ? value : without_it);
  std::vector<std::filesystem::path> paths;
  for (std::string path; std::getline(list, path, ':');)
    if (!path.empty()) paths.emplace_back(path);
  return paths;
}

// A build folder lies in the checkout. The checkout's own place serves programs that were copied
// out of it on the machine that built them.
std::vector<std::filesystem::path> data_folders() {
  const std::filesystem::path here = program_folder();
  std::vector<std::filesystem::path> folders{
      here.parent_path(), here.parent_path() / "share" / "heft", here / "share" / "heft"};
  for (const std::filesystem::path& path : listed("XDG_DATA_DIRS", "/usr/local/share:/usr/share"))
    folders.push_back(path / "heft");
  folders.emplace_back(HEFT_CHECKOUT);
  return folders;
}

}  // namespace

std::string installed_file_or_none(const std::string& name) {
  for (const std::filesystem::path& folder : data_folders()) {
    std::error_code none;
    if (std::filesystem::exists(folder / name, none)) return (folder / name).string();
  }
  return "";
}

std::string installed_file(const std::string& name) {
  const std::string found = installed_file_or_none(name);
  if (!found.empty()) return found;
  std::vector<std::string> tried;
  for (const std::filesystem::path& folder : data_folders()) tried.push_back(folder.string());
  throw Error(
      fmt::format("{} is missing; it comes with heft, but is in none of {}. Put share/heft "
                  "of an installed heft beside the program",
                  name, fmt::join(tried, ", ")));
}

std::string bench_program() {
  const std::filesystem::path here = program_folder();
  std::vector<std::filesystem::path> folders{here, here.parent_path() / "libexec" / "heft"};
  for (const std::filesystem::path& path : listed("PATH", "")) folders.push_back(path);
  for (const std::filesystem::path& folder : folders)
    if (access((folder / "heft-bench").c_str(), X_OK) == 0) return (folder / "heft-bench").string();
  return "";
}

}  // namespace heft
