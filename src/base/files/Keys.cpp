#include "base/files/Keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace heft {

bool Range::holds(double value) const {
  return std::isfinite(value) && (low_open ? value > low : value >= low) &&
         (high_open ? value < high : value <= high);
}

std::string Range::text() const {
  std::string text;
  if (low == least)
    text += fmt::format(" above 0 ({} or more)", least);
  else if (low > -furthest)
    text += fmt::format("{} {}", low_open ? " above" : ", at least", low);
  if (high < furthest) text += fmt::format(" and {} {}", high_open ? "below" : "at most", high);
  return text;
}

std::string WholeRange::text() const {
  return high < WholeRange{}.high ? fmt::format("a whole number from {} to {}", low, high)
                                  : fmt::format("a whole number, at least {}", low);
}

std::string ConfigMistake::text() const {
  return fmt::format("{}, expected {}", what, expected);
}

InvalidConfig::InvalidConfig(std::string_view kind, ConfigMistakes mistakes)
    : Error([&] {
        std::string text;
        for (const ConfigMistake& mistake : mistakes)
          text += fmt::format("{}{}: {}", text.empty() ? "" : "\n", kind, mistake.text());
        return text;
      }()),
      mistakes_(std::move(mistakes)) {}

void RangeCheck::operator()(const ConfigKey& key, double value, const Range& range) {
  if (range.holds(value)) return;
  const char* number = std::isfinite(value) ? "a number" : "a finite number";
  mistakes.push_back({{key.name}, fmt::format("{} is {}", key.name, value), number + range.text()});
}

void RangeCheck::operator()(const ConfigKey& key, const std::vector<double>& values,
                            const Range& range) {
  if (key.is_required && values.empty())
    mistakes.push_back({{key.name}, fmt::format("{} has 0 numbers", key.name), "at least 1"});
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t n_before = mistakes.size();
    (*this)(key, values[i], range);
    if (mistakes.size() > n_before) mistakes.back().index = i;
  }
}

void RangeCheck::operator()(const ConfigKey& key, const ValueGrid& grid, const Range& range) {
  (*this)(key, grid.values, range);
  for (std::size_t i = 1; i < grid.values.size(); ++i)
    if (grid.values[i] <= grid.values[i - 1])
      mistakes.push_back(
          {{key.name},
           fmt::format("{} has {} after {}", key.name, grid.values[i], grid.values[i - 1]),
           "ascending values",
           i});
}

void RangeCheck::operator()(const ConfigKey& key, int value, const WholeRange& range) {
  if (value < range.low || value > range.high)
    mistakes.push_back({{key.name}, fmt::format("{} is {}", key.name, value), range.text()});
}

std::string KeysReport::text_of(double value) {
  return fmt::format("{:g}", value);
}
std::string KeysReport::text_of(int value) {
  return fmt::format("{}", value);
}
std::string KeysReport::text_of(bool value) {
  return value ? "yes" : "no";
}
std::string KeysReport::text_of(const std::optional<double>& value) {
  return value ? text_of(*value) : "none";
}
std::string KeysReport::text_of(const std::vector<double>& values) {
  return fmt::format("{:g}", fmt::join(values, ", "));
}
std::string KeysReport::text_of(const std::vector<std::string>& values) {
  return values.empty() ? "none" : fmt::format("{}", fmt::join(values, ", "));
}
std::string KeysReport::text_of(const ValueGrid& grid) {
  const std::vector<double>& values = grid.values;
  if (values.empty()) return "none";
  if (values.size() < 4) return text_of(values);
  return fmt::format("{:g} to {:g} ({} values)", values.front(), values.back(), values.size());
}

void KeysReport::add(const ConfigKey& key, const std::string& value) {
  const auto place = key.report.find("{}");
  if (!text.empty()) text += ", ";
  text += key.report.substr(0, place);
  text += value;
  if (value == "none") return;
  text += key.report.substr(place + 2);  // the unit
  if (value == "1" && text.ends_with('s')) text.pop_back();
}

}  // namespace heft
