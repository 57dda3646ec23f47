// Declaration of configuration tables. Each config type has visit_keys(config, visit), which calls
// visit(key, field) or visit(key, field, range) for every key in the order of its file. File
// readers, checks, reports and help are visitors. An optional field may be missing; an enumeration
// field takes the names of its enumerators.
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/Error.h"
#include "base/Names.h"

namespace heft {

/// Largest magnitude of a setting in any unit; larger ones could overflow.
inline constexpr double furthest = 1e12;
/// Smallest value of a positive setting; smaller ones could underflow.
inline constexpr double least = 1e-9;

/// Range of a real-valued key.
struct Range {
  double low = -furthest, high = furthest;
  bool low_open = false, high_open = false;
  bool holds(double value) const;
  std::string text() const;  ///< suffix of "a number", e.g. ", at least 0"
};
inline constexpr Range any_number{};
inline constexpr Range above_zero{least, furthest};
inline constexpr Range zero_or_more{0};

/// Range of an integer key.
struct WholeRange {
  std::int64_t low = 0;
  std::int64_t high = std::numeric_limits<int>::max();
  std::string text() const;  ///< "a whole number, at least 0"
};

/// The values of a parameter on a grid, ascending. In a file: one number, a list, or a table
/// {from, to, step} or {from, to, n, spacing}.
struct ValueGrid {
  std::vector<double> values{};
  bool operator==(const ValueGrid&) const = default;
};

struct ConfigKey {
  std::string_view name, meaning;
  bool is_required = false;
  std::string_view report = {};  ///< format in reports: "floor {} g"; empty: not reported
};

/// `Config` is `Type` or `const Type`, the parameter types of visit_keys.
template <typename Config, typename Type>
concept ConfigOf = std::same_as<std::remove_const_t<Config>, Type>;

/// A mistake in a config: an invalid value or an invalid combination.
struct ConfigMistake {
  /// Keys concerned. A reader reports the mistake at the first of them in the file, unless the file
  /// has another mistake at one of them.
  std::vector<std::string_view> keys;
  std::string what;                    ///< "floor is 3", `lacks "floor"`
  std::string expected;                ///< "below the ceiling 2"
  std::optional<std::size_t> index{};  ///< of the value, if the key is a list

  /// "floor is 3, expected below the ceiling 2"
  std::string text() const;
};
using ConfigMistakes = std::vector<ConfigMistake>;

/// All mistakes of a config; what() has one line each.
class InvalidConfig : public Error {
 public:
  /// @param kind of the config, e.g. "up_down"
  InvalidConfig(std::string_view kind, ConfigMistakes mistakes);
  const ConfigMistakes& mistakes() const { return mistakes_; }

 private:
  ConfigMistakes mistakes_;
};

/// Returns the config if its check() finds no mistake. @throws InvalidConfig otherwise
template <typename Config>
Config valid_config(Config config) {
  if (ConfigMistakes mistakes = config.check(); !mistakes.empty())
    throw InvalidConfig(Config::kind, std::move(mistakes));
  return config;
}

/// Visitor that collects the values outside their range.
class RangeCheck {
 public:
  void operator()(const ConfigKey& key, double value, const Range& range);
  void operator()(const ConfigKey& key, const std::optional<double>& value, const Range& range) {
    if (value) (*this)(key, *value, range);
  }
  void operator()(const ConfigKey& key, const std::vector<double>& values, const Range& range);
  void operator()(const ConfigKey& key, const ValueGrid& grid, const Range& range);
  void operator()(const ConfigKey& key, int value, const WholeRange& range);
  template <typename Value>
  void operator()(const ConfigKey&, const Value&) {}  // no range

  ConfigMistakes mistakes;
};

/// The values of a config outside their keys' ranges.
template <typename Config>
ConfigMistakes out_of_range(const Config& config) {
  RangeCheck check;
  visit_keys(config, check);
  return std::move(check.mistakes);
}

/// Visitor that joins the values of reported keys: "floor 0 g, ceiling none".
class KeysReport {
 public:
  template <typename Value, typename... Ranges>
  void operator()(const ConfigKey& key, const Value& value, const Ranges&...) {
    if (key.report.empty()) return;
    if constexpr (std::is_enum_v<Value>)
      add(key, std::string(name_of(value)));
    else
      add(key, text_of(value));
  }

  std::string text;

 private:
  static std::string text_of(double value);
  static std::string text_of(int value);
  static std::string text_of(bool value);
  static std::string text_of(const std::optional<double>& value);
  static std::string text_of(const std::vector<double>& values);
  static std::string text_of(const std::vector<std::string>& values);
  static std::string text_of(const ValueGrid& grid);
  void add(const ConfigKey& key, const std::string& value);
};

/// The settings of a config as a report prints them.
template <typename Config>
std::string keys_report(const Config& config) {
  KeysReport report;
  visit_keys(config, report);
  return std::move(report.text);
}

}  // namespace heft
