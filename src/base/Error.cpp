#include "base/Error.h"

#include <fmt/format.h>

#include "base/files/Printable.h"

namespace heft {

namespace {
std::string listed(const std::vector<Mistake>& mistakes) {
  std::string text;
  for (const Mistake& mistake : mistakes) {
    if (!text.empty()) text += '\n';
    text += fmt::format("{}: {}", to_string(mistake.place), mistake.message);
  }
  return text;
}
}  // namespace

std::string to_string(const SourcePlace& place) {
  const std::string file = escaped_line(place.file);  // file names may hold line ends
  if (place.line == 0) return file;
  if (place.column == 0) return fmt::format("{}:{}", file, place.line);
  return fmt::format("{}:{}:{}", file, place.line, place.column);
}

InvalidFile::InvalidFile(std::vector<Mistake> mistakes)
    : Error(listed(mistakes), ExitCode::invalid_file), mistakes_(std::move(mistakes)) {}

}  // namespace heft
