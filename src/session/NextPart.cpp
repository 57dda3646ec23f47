#include "session/NextPart.h"

#include <fmt/format.h>

#include <filesystem>

namespace heft {

namespace fs = std::filesystem;

std::string next_part(const std::string& path) {
  const fs::path whole(path);
  std::string candidate = path;
  for (int part = 2; fs::exists(candidate); ++part)
    candidate = (whole.parent_path() /
                 fmt::format("{}-{}{}", whole.stem().string(), part, whole.extension().string()))
                    .string();
  return candidate;
}

Setup with_next_parts(Setup options) {
  const auto [view, file] = split_name(options.view);
  if (!file.empty()) options.view = view + ":" + next_part(file);
  if (!options.record_camera.empty()) options.record_camera = next_part(options.record_camera);
  return options;
}

}  // namespace heft
