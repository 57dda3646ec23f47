#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include "base/Error.h"
#include "base/files/TextFile.h"
#include "record/export/Export.h"

namespace heft {

namespace {
std::string bytes_of(std::string_view digits) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
  return bytes;
}

std::string exclusive_or(std::string text, char with) {
  for (char& c : text) c = static_cast<char>(c ^ with);
  return text;
}

std::string random_key() {
  std::array<unsigned char, 32> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw Error(fmt::format("cannot create a key: {}", std::strerror(errno)));
  return fmt::format("{:02x}", fmt::join(bytes, ""));
}

// Refuses keys that were not drawn at random: a random key has fewer than nine different digits
// with a probability of 1e-14.
std::string key_in(const std::string& file) {
  constexpr std::size_t n_digits = 64, least_different = 9;
  std::string key = read_text_file(file);
  if (key.ends_with('\n')) key.pop_back();
  const std::string format = fmt::format(
      "expected one line of {} random hexadecimal digits (0-9, a-f), as of openssl rand -hex 32; a "
      "missing file is created",
      n_digits);
  const auto refuse = [&](std::string_view what) {
    throw Error(fmt::format("{}: {}, {}.", file, what, format), ExitCode::invalid_file);
  };
  const std::set<char> different(key.begin(), key.end());
  if (key.find_first_not_of("0123456789abcdef") != std::string::npos) refuse("this is no key");
  if (key.size() != n_digits) refuse(fmt::format("a key of {} digits", key.size()));
  if (different.size() < least_different)
    refuse(fmt::format("a key of {} different digits can be guessed", different.size()));
  return key;
}
}  // namespace

std::string hmac_sha256(std::string_view key, std::string_view text) {
  constexpr std::size_t block = 64;
  std::string padded = key.size() > block ? bytes_of(sha256(key)) : std::string(key);
  padded.resize(block, '\0');
  const std::string inner = bytes_of(sha256(exclusive_or(padded, 0x36) + std::string(text)));
  return sha256(exclusive_or(padded, 0x5c) + inner);
}

std::string pseudonym(std::string_view key, std::string_view person) {
  constexpr std::size_t n_digits = 12;
  return fmt::format("p{}", hmac_sha256(key, person).substr(0, n_digits));
}

PseudonymKey pseudonym_key(const std::string& file) {
  if (!create_file(file, 0600)) return {file, key_in(file), false};
  const std::string key = random_key();
  std::ofstream out(file, std::ios::binary);
  out << key << '\n';
  out.close();
  if (!out) {
    std::filesystem::remove(file);
    throw Error(fmt::format("cannot write the key {}: {}", file, std::strerror(errno)));
  }
  return {file, key, true};
}

}  // namespace heft
