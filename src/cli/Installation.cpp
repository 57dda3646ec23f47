#include "cli/Installation.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/Error.h"

namespace heft::cli {

std::string installed_file(const std::string& name) {
  // The program is built into a folder of the checkout.
  const auto program = std::filesystem::read_symlink("/proc/self/exe");
  const auto path = program.parent_path().parent_path() / name;
  if (!std::filesystem::exists(path))
    throw Error(fmt::format("{} is missing; is the program still in its checkout?", path.string()));
  return path.string();
}

}  // namespace heft::cli
