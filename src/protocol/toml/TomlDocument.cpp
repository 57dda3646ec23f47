#include "protocol/toml/TomlDocument.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/files/Printable.h"

namespace heft {

namespace {
// Numbers that the library could not read, by line and column.
using Overflows = std::map<std::pair<int, int>, std::string>;

TomlPlace place_of(const toml::source_region& region) {
  return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

TomlNode converted(const toml::node& node, const Overflows& overflows);

TomlTable converted(const toml::table& table, const Overflows& overflows) {
  TomlTable entries;
  for (const auto& [key, node] : table)
    entries.push_back({std::string(key.str()), place_of(key.source()), converted(node, overflows)});
  return entries;
}

TomlArray converted(const toml::array& array, const Overflows& overflows) {
  TomlArray nodes;
  for (const toml::node& node : array) nodes.push_back(converted(node, overflows));
  return nodes;
}

TomlNode converted(const toml::node& node, const Overflows& overflows) {
  const TomlPlace place = place_of(node.source());
  if (const auto found = overflows.find({place.line, place.column}); found != overflows.end())
    return {place, TomlOverflow{found->second}};
  if (const auto* table = node.as_table()) return {place, converted(*table, overflows)};
  if (const auto* array = node.as_array()) return {place, converted(*array, overflows)};
  if (const auto* boolean = node.as_boolean()) return {place, boolean->get()};
  if (const auto* integer = node.as_integer()) return {place, integer->get()};
  if (const auto* number = node.as_floating_point()) return {place, number->get()};
  if (const auto* string = node.as_string()) return {place, string->get()};
  return {place, TomlDate{}};
}

// The byte at a line and column, where columns count characters of UTF-8.
std::size_t offset_of(std::string_view text, TomlPlace place) {
  std::size_t offset = 0;
  for (int line = 1; line < place.line && offset < text.size(); ++line)
    offset = std::min(text.find('\n', offset), text.size() - 1) + 1;
  const auto continues = [&] {
    return offset < text.size() && (static_cast<unsigned char>(text[offset]) & 0xC0) == 0x80;
  };
  for (int column = 1; column < place.column && offset < text.size(); ++column) {
    ++offset;
    while (continues()) ++offset;
  }
  return offset;
}

// The library reports a number beyond its type as a syntax error, which would hide all other
// mistakes. Replaces such a number by "nan" and remembers its text.
bool set_aside(std::string& text, const toml::parse_error& error, Overflows& overflows) {
  const std::string_view why = error.description();
  if (why.find("not representable in 64 bits") == std::string_view::npos &&
      why.find("could not be interpreted as a value") == std::string_view::npos)
    return false;
  const TomlPlace end_place = place_of(error.source());
  const std::size_t end = offset_of(text, end_place);
  std::size_t begin = end;
  const auto in_number = [](char c) {
    return std::string_view("0123456789abcdefABCDEFox_+-.").find(c) != std::string_view::npos;
  };
  while (begin > 0 && in_number(text[begin - 1])) --begin;
  const std::size_t length = end - begin;
  if (length < 3) return false;
  const int column = end_place.column - static_cast<int>(length);
  overflows[{end_place.line, column}] = text.substr(begin, length);
  text.replace(begin, length, "nan" + std::string(length - 3, ' '));
  return true;
}

[[noreturn]] void refuse(const std::string& file, TomlPlace place, const std::string& why) {
  throw InvalidFile(
      {{{file, place.line, place.column},
        fmt::format("not valid TOML: {}; the rest of the file was not checked", why)}});
}

// The library recurses for each dot of a key, which could overflow the stack.
void refuse_deep_keys(const std::string& text, const std::string& file) {
  constexpr auto most_dots = 3000;
  if (std::ranges::count(text, '.') > most_dots)
    refuse(file, {}, fmt::format("the file has more than {} dots, expected fewer", most_dots));
}
}  // namespace

TomlTable parse_toml(const std::string& text, const std::string& file) {
  constexpr std::size_t most_overflows = 100;  // each makes the library read the file again
  refuse_deep_keys(text, file);
  std::string readable = text;
  Overflows overflows;
  for (;;) {
    try {
      return converted(toml::parse(std::string_view(readable)), overflows);
    } catch (const toml::parse_error& error) {
      if (overflows.size() >= most_overflows || !set_aside(readable, error, overflows))
        refuse(file, place_of(error.source()), printable(std::string(error.description())));
    }
  }
}

std::string shown(const TomlNode& node) {
  struct Shown {
    std::string operator()(bool value) const { return value ? "true" : "false"; }
    std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
    std::string operator()(double value) const {
      const bool whole = std::isfinite(value) && value == std::floor(value);
      return whole && std::abs(value) < 1e15 ? fmt::format("{:.1f}", value)
                                             : fmt::format("{}", value);
    }
    std::string operator()(const std::string& value) const { return '"' + printable(value) + '"'; }
    std::string operator()(const TomlArray&) const { return "an array"; }
    std::string operator()(const TomlTable&) const { return "a table"; }
    std::string operator()(const TomlDate&) const { return "a date or time"; }
    std::string operator()(const TomlOverflow& value) const { return printable(value.text); }
  };
  return std::visit(Shown{}, node.value);
}

void Mistakes::add(TomlPlace place, std::string message) {
  const bool is_set = place.line == set_place.line;
  mistakes_.push_back({{is_set ? "--set" : file_, place.line, place.column}, std::move(message)});
}

InvalidFile Mistakes::as_error() const {
  std::vector<Mistake> sorted = mistakes_;
  std::ranges::stable_sort(sorted, {}, [](const Mistake& mistake) {
    return std::tuple(mistake.place.line, mistake.place.column);
  });
  return InvalidFile(std::move(sorted));
}

void Mistakes::throw_if_any() const {
  if (!mistakes_.empty()) throw as_error();
}

}  // namespace heft
