#include "base/files/TextFile.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sha2.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/Error.h"

namespace heft {

namespace {
namespace fs = std::filesystem;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return text.substr(0, 0);  // still at its place
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

[[noreturn]] void refuse_writing(const std::string& path, const std::string& why) {
  throw Error(fmt::format("cannot write {}: {}", path, why));
}

// Copies the file to the first free name.
std::string keep_beside(const std::string& path) {
  for (int i = 1;; ++i) {
    const std::string kept = path + ".before" + (i > 1 ? std::to_string(i) : "");
    std::error_code error;
    if (fs::copy_file(path, kept, error)) return kept;
    if (error != std::errc::file_exists)
      refuse_writing(kept,
                     error.message() + "; the existing file is copied there before it is replaced");
  }
}

void write_whole(const std::string& path, const std::string& text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) refuse_writing(path, std::strerror(errno));
  std::string_view left = text;
  bool written = true;
  while (written && !left.empty()) {
    const ssize_t n = ::write(file, left.data(), left.size());
    written = n > 0;
    if (written) left.remove_prefix(static_cast<std::size_t>(n));
  }
  written = written && fsync(file) == 0;
  const int reason = errno;
  ::close(file);
  if (written) return;
  ::unlink(path.c_str());
  refuse_writing(path, std::strerror(reason));
}
}  // namespace

std::string read_text_file(const std::string& path) {
  std::error_code unknown;  // opening the file reports the reason
  const fs::file_status there = fs::status(path, unknown);
  if (fs::is_directory(there))
    throw Error(fmt::format("can't read {}: it is a folder, expected a file", path));
  if (fs::exists(there) && !fs::is_regular_file(there))
    throw Error(fmt::format("can't read {}: it is a device or a pipe, expected a file", path));
  constexpr std::uintmax_t most_mb = 256, mb = 1 << 20;
  if (const auto size = fs::file_size(path, unknown); !unknown && size > most_mb * mb)
    throw Error(
        fmt::format("can't read {}: it has {} MB, expected at most {}", path, size / mb, most_mb));
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(fmt::format("can't read {}: {}", path, std::strerror(errno)));
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

bool create_file(const std::string& path, unsigned mode) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (file < 0 && errno != EEXIST) refuse_writing(path, std::strerror(errno));
  if (file >= 0) ::close(file);
  return file >= 0;
}

void require_writable(const std::string& path) {
  std::error_code unknown;
  const fs::file_status there = fs::status(path, unknown);
  if (fs::is_directory(there)) refuse_writing(path, "it is a folder, expected a file");
  if (fs::exists(there) && !fs::is_regular_file(there))
    refuse_writing(path, "it is a device or a pipe, expected a file");
  const fs::path folder = fs::path(path).parent_path();
  if (access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0)
    refuse_writing(path, fmt::format("{}; check that its folder exists and is writable",
                                     std::strerror(errno)));
}

std::string replace_text_file(const std::string& path, const std::string& text) {
  require_writable(path);
  // Replace the target of a symbolic link, not the link.
  const std::string target = fs::exists(path) ? fs::canonical(path).string() : path;
  const std::string kept = fs::exists(target) ? keep_beside(target) : "";
  const std::string temporary = target + ".new";
  write_whole(temporary, text);
  if (std::rename(temporary.c_str(), target.c_str()) != 0)
    refuse_writing(target, std::strerror(errno));
  return kept;
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  return text;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  text = without_byte_order_mark(text);
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const auto end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return lines;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const auto comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

std::optional<double> number_in(std::string_view cell) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::string sha256(std::string_view text) {
  std::array<char, SHA256_DIGEST_STRING_LENGTH> digest{};
  SHA256Data(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(), digest.data());
  return digest.data();
}

}  // namespace heft
