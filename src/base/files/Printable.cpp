#include "base/files/Printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace heft {

Letter first_letter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t n = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < n) return {};
  char32_t code = first & (0x7Fu >> n);
  for (std::size_t i = 1; i < n; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  const bool is_too_long = (n == 3 && code < 0x800) || (n == 4 && code < 0x10000);
  const bool is_half_a_pair = code >= 0xD800 && code < 0xE000;
  return is_too_long || is_half_a_pair || code > 0x10FFFF ? Letter{} : Letter{code, n};
}

std::vector<std::string_view> letters_of(std::string_view text) {
  std::vector<std::string_view> letters;
  while (!text.empty()) {
    const std::size_t n = std::max<std::size_t>(1, first_letter(text).n_bytes);
    letters.push_back(text.substr(0, n));
    text.remove_prefix(n);
  }
  return letters;
}

bool is_control(char32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0);
}

namespace {
bool changes_direction(char32_t code) {
  return (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069) ||
         code == 0x200E || code == 0x200F || code == 0x061C;
}

std::string escaped_except(std::string_view text, std::string_view kept) {
  std::string shown;
  while (!text.empty()) {
    const auto [code, n] = first_letter(text);
    if (n == 0)
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
    else if (is_control(code) && !(n == 1 && kept.find(text[0]) != std::string_view::npos))
      shown += fmt::format("\\x{:02x}", static_cast<std::uint32_t>(code));
    else if (changes_direction(code) || code == 0x2028 || code == 0x2029)
      shown += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(code));
    else
      shown += text.substr(0, n);
    text.remove_prefix(n > 0 ? n : 1);
  }
  return shown;
}
}  // namespace

std::string escaped(std::string_view text) {
  return escaped_except(text, "\n\t");
}

std::string escaped_line(std::string_view text) {
  return escaped_except(text, "");
}

std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  constexpr std::size_t longest = 200;
  if (text.size() <= longest) return text;
  std::size_t cut = longest;
  while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80) --cut;
  return text.substr(0, cut) + "...";
}

std::string shell_quoted(const std::string& word) {
  constexpr auto plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:,+=@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  if (escaped_line(word) == word) {
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
  }
  std::string quoted = "$'";  // ANSI-C quoting (bash, zsh)
  for (const char c : word) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\'' || c == '\\')
      quoted += std::string("\\") + c;
    else if (byte < 0x20 || byte >= 0x7F)
      quoted += fmt::format("\\{:03o}", byte);
    else
      quoted += c;
  }
  return quoted + "'";
}

}  // namespace heft
