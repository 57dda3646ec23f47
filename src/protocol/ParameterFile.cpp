#include "protocol/ParameterFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "base/Printable.h"
#include "protocol/Mistakes.h"

namespace heft {

namespace {
// None where the value is no finite number, truth value or text.
std::optional<std::variant<double, bool, std::string>> value_of(const TomlNode& node) {
  if (const auto* boolean = std::get_if<bool>(&node.value)) return *boolean;
  if (const auto* text = std::get_if<std::string>(&node.value)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&node.value))
    return static_cast<double>(*whole);
  const auto* number = std::get_if<double>(&node.value);
  if (number && std::isfinite(*number)) return *number;
  return std::nullopt;
}
}  // namespace

std::vector<Parameter> parse_parameters(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  std::vector<Parameter> parameters;
  for (const TomlEntry& entry : parse_toml(text, file)) {
    if (auto value = value_of(entry.node))
      parameters.push_back(
          {entry.key, std::move(*value), {file, entry.node.place.line, entry.node.place.column}});
    else
      mistakes.add(entry.node.place,
                   fmt::format("{} is {}, expected a finite number, a text, true or false",
                               printable(entry.key), shown(entry.node)));
  }
  mistakes.throw_if_any();
  std::ranges::sort(parameters, {}, [](const Parameter& parameter) {
    return std::tuple(parameter.place.line, parameter.place.column);
  });
  return parameters;
}

}  // namespace heft
