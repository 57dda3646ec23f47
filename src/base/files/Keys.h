// What a table of settings holds, declared once: each config has visit_keys(config, visit), which
// calls visit(key, field) or visit(key, field, range) for every key in the order of its file.
// Readers of files, checks, reports and help are visitors. The field's type says the rest: an
// optional may be missing, an enumeration is a list of names.
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

/// Beyond this much of any unit lies no experiment, only overflow.
inline constexpr double furthest = 1e12;
/// Below this much of what must be above zero lies only underflow.
inline constexpr double least = 1e-9;

/// The numbers a key takes.
struct Range {
  double low = -furthest, high = furthest;
  bool low_open = false, high_open = false;
  bool holds(double value) const;
  std::string text() const;  ///< what it adds to "a number", e.g. ", at least 0"
};
inline constexpr Range any_number{};
inline constexpr Range above_zero{least, furthest};
inline constexpr Range zero_or_more{0};

/// Whole numbers that a key takes.
struct WholeRange {
  std::int64_t low = 0;
  std::int64_t high = std::numeric_limits<int>::max();
  std::string text() const;  ///< "a whole number, at least 0"
};

struct ConfigKey {
  std::string_view name, meaning;
  bool is_required = false;
  std::string_view report = {};  ///< how a report names its value: "floor {} g"; empty: not at all
};

/// `Config` is `Type` or `const Type`: what visit_keys takes.
template <typename Config, typename Type>
concept ConfigOf = std::same_as<std::remove_const_t<Config>, Type>;

/// A mistake in a config: a value, or values that don't fit together.
struct ConfigMistake {
  /// That it is about. A reader puts it at the first that its file has, and leaves it out where the
  /// file has another mistake at one of them.
  std::vector<std::string_view> keys;
  std::string what;                    ///< "floor is 3", `lacks "floor"`
  std::string expected;                ///< "below the ceiling 2"
  std::optional<std::size_t> index{};  ///< of the value in a list

  /// "floor is 3, expected below the ceiling 2"
  std::string text() const;
};
using ConfigMistakes = std::vector<ConfigMistake>;

/// All mistakes of a config, one line each in what().
class InvalidConfig : public Error {
 public:
  /// @param what_it_is of the config, e.g. "up_down"
  InvalidConfig(std::string_view what_it_is, ConfigMistakes mistakes);
  const ConfigMistakes& mistakes() const { return mistakes_; }

 private:
  ConfigMistakes mistakes_;
};

/// The config, where its check() finds nothing. @throws InvalidConfig
template <typename Config>
Config valid_config(Config config) {
  if (ConfigMistakes mistakes = config.check(); !mistakes.empty())
    throw InvalidConfig(Config::kind, std::move(mistakes));
  return config;
}

// Visitors
// -----------------------------------------------------------------------------------------

/// Notes every value that is outside its range.
class RangeCheck {
 public:
  void operator()(const ConfigKey& key, double value, const Range& range);
  void operator()(const ConfigKey& key, const std::optional<double>& value, const Range& range) {
    if (value) (*this)(key, *value, range);
  }
  void operator()(const ConfigKey& key, const std::vector<double>& values, const Range& range);
  void operator()(const ConfigKey& key, int value, const WholeRange& range);
  template <typename Value>
  void operator()(const ConfigKey&, const Value&) {}  // every value of its type

  ConfigMistakes mistakes;
};

/// The values outside their keys' ranges.
template <typename Config>
ConfigMistakes out_of_range(const Config& config) {
  RangeCheck check;
  visit_keys(config, check);
  return std::move(check.mistakes);
}

/// Joins what reports say of each key: "floor 0 g, ceiling none".
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
  void add(const ConfigKey& key, const std::string& value);
};

/// What a report says was chosen.
template <typename Config>
std::string keys_report(const Config& config) {
  KeysReport report;
  visit_keys(config, report);
  return std::move(report.text);
}

}  // namespace heft
