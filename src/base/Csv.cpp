#include "base/Csv.h"

namespace heft {

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string without_formula(std::string_view text) {
  constexpr unsigned char first_printable = 0x20, delete_key = 0x7f;
  if (text.empty()) return "";
  const auto first = static_cast<unsigned char>(text.front());
  const bool is_control = first < first_printable || first == delete_key;
  const bool is_formula = std::string_view("=+-@'").find(text.front()) != std::string_view::npos;
  return (is_control || is_formula ? "'" : "") + std::string(text);
}

}  // namespace heft
