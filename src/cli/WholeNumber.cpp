#include "cli/WholeNumber.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>

namespace heft::cli {

namespace {
bool is_whole_number(const std::string& text, std::uint64_t least, std::uint64_t most) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos) return false;
  if (text.size() > 1 && text.front() == '0') return false;
  std::uint64_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc() && value >= least && value <= most;
}
}  // namespace

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  const auto refusal = [least, most](const std::string& text) {
    if (is_whole_number(text, least, most)) return std::string();
    return fmt::format("expected a whole number {}...{} in decimal digits, got \"{}\"", least, most,
                       text);
  };
  return {[refusal](std::string& text) { return refusal(text); }, ""};
}

CLI::Validator session_number() {
  return whole_number(1, std::numeric_limits<std::int64_t>::max());
}

}  // namespace heft::cli
