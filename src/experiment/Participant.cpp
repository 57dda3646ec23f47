#include "experiment/Participant.h"

#include <fmt/format.h>

#include "base/files/Printable.h"

namespace heft {

namespace {
bool is_blank(char32_t c) {
  return c == ' ' || c == 0xA0 || c == 0x1680 || (c >= 0x2000 && c <= 0x200B) || c == 0x202F ||
         c == 0x205F || c == 0x3000 || c == 0xFEFF;
}

constexpr char32_t line_separator = 0x2028, paragraph_separator = 0x2029;
}  // namespace

std::optional<std::string> wrong_with_id(const std::string& id) {
  constexpr std::size_t most_bytes = 200;
  if (id.size() > most_bytes)
    return fmt::format("has {} bytes, expected at most {}", id.size(), most_bytes);
  bool blank = true;
  for (std::string_view rest = id; !rest.empty();) {
    const auto [code, n] = first_letter(rest);
    if (n == 0) return "is not valid UTF-8; check the encoding of the terminal";
    if (is_control(code) || code == line_separator || code == paragraph_separator)
      return fmt::format("contains the control character U+{:04X}; use one line without tabs",
                         static_cast<unsigned>(code));
    blank = blank && is_blank(code);
    rest.remove_prefix(n);
  }
  if (blank) return "is empty or blank; use an id such as 07";
  return std::nullopt;
}

}  // namespace heft
