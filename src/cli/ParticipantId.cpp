#include "cli/ParticipantId.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string_view>

#include "base/Error.h"

namespace heft::cli {

namespace {

constexpr std::size_t most_bytes = 200;

// How many bytes a UTF-8 character has that begins with this one; 0: none begins so.
std::size_t character_length(unsigned char first) {
  if (first < 0x80) return 1;
  if (first < 0xC2) return 0;
  if (first < 0xE0) return 2;
  if (first < 0xF0) return 3;
  return first < 0xF5 ? 4 : 0;
}

// Takes the first character off the text; none where it is not UTF-8.
std::optional<char32_t> take_character(std::string_view& text) {
  constexpr std::array<char32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = character_length(first);
  if (length == 0 || length > text.size()) return std::nullopt;
  char32_t character = length == 1 ? first : first & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    const auto next = static_cast<unsigned char>(text[i]);
    if ((next & 0xC0) != 0x80) return std::nullopt;
    character = character << 6 | (next & 0x3F);
  }
  const bool surrogate = character >= 0xD800 && character <= 0xDFFF;
  if (character < least[length] || character > 0x10FFFF || surrogate) return std::nullopt;
  text.remove_prefix(length);
  return character;
}

bool is_control(char32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x2028 || c == 0x2029;  // with line separators
}

bool is_blank(char32_t c) {
  return c == ' ' || c == 0xA0 || c == 0x1680 || (c >= 0x2000 && c <= 0x200B) || c == 0x202F ||
         c == 0x205F || c == 0x3000 || c == 0xFEFF;
}

[[noreturn]] void refuse(const std::string& why) {
  throw Error(fmt::format("--participant: the id {}", why), ExitCode::usage);
}

}  // namespace

void check_participant(const std::string& id) {
  if (id.size() > most_bytes)
    refuse(fmt::format("has {} bytes, expected at most {}", id.size(), most_bytes));
  bool blank = true;
  for (std::string_view rest = id; !rest.empty();) {
    const auto character = take_character(rest);
    if (!character) refuse("is not valid UTF-8; is the terminal set to another encoding?");
    if (is_control(*character))
      refuse(
          fmt::format("holds the control character U+{:04X}; give it on one line, without "
                      "tabs or line ends",
                      static_cast<unsigned>(*character)));
    blank = blank && is_blank(*character);
  }
  if (blank) refuse("is empty or blank; give one that names the participant, such as 07");
}

}  // namespace heft::cli
