// Reads the keys of a TOML table into typed fields. Mistakes are collected with their places, so
// that a file's mistakes are reported together. Read every key, close(), then check fields against
// each other with good().
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/Keys.h"
#include "protocol/toml/TomlDocument.h"

namespace heft {

class MassCurve;

/// Positions and sizes in meters.
inline constexpr Range on_earth{-1e6, 1e6};
inline constexpr Range size_on_earth{least, 1e6};

class TableReader {
 public:
  TableReader(const TomlTable& root, Mistakes& mistakes);

  // Each leaves `field` unchanged if the key is absent or its value a mistake.
  void read(std::string_view key, double& field, const Range& range = any_number);
  void read(std::string_view key, std::optional<double>& field, const Range& range = any_number);
  void read(std::string_view key, int& field, const WholeRange& range = {});
  void read(std::string_view key, std::uint64_t& field, const WholeRange& range);
  void read(std::string_view key, bool& field);
  /// A text on one line.
  void read(std::string_view key, std::string& field);
  /// A text of several lines.
  void read_lines(std::string_view key, std::string& field);
  /// One or more numbers.
  void read(std::string_view key, std::vector<double>& field, const Range& range = any_number);
  /// A number, a list, {from, to, step} or {from, to, n, spacing = "linear"|"log"}.
  void read(std::string_view key, ValueGrid& field, const Range& range = any_number);
  /// One or more texts on one line each, none of them empty.
  void read(std::string_view key, std::vector<std::string>& field);
  void read(std::string_view key, Eigen::Vector2d& field, const Range& range = any_number);
  void read(std::string_view key, Eigen::Vector3d& field, const Range& range = any_number);
  /// One or more pairs [a, b]; none after a mistake.
  void read(std::string_view key, std::vector<Eigen::Vector2d>& pairs, const Range& of_a,
            const Range& of_b);
  /// Pairs [mass in g, value] of ascending masses.
  void read(std::string_view key, MassCurve& field, const Range& values);
  /// As many points [x, y, z] as the field has.
  void read(std::string_view key, std::span<Eigen::Vector3d> points);
  /// One number for all three, or three numbers.
  void read_size(std::string_view key, Eigen::Vector3d& field);
  template <typename Enum>
  requires std::is_enum_v<Enum>
  void read(std::string_view key, Enum& field) {
    const auto name = read_name(key, EnumNames<Enum>::names);
    if (name) field = *named<Enum>(*name);
  }
  /// Every key that the config's visit_keys declares.
  template <typename Config>
  void read_keys(Config& config) {
    visit_keys(config, [&](const ConfigKey& key, auto& field, const auto&... range) {
      if (key.is_required) require({key.name});
      read(key.name, field, range...);
    });
  }
  /// One of `names`; none if the key is absent or its value a mistake.
  std::optional<std::string> read_name(std::string_view key,
                                       std::span<const std::string_view> names);
  /// As read_name for a required key. After a mistake, gives the most likely name, so that the rest
  /// of the table can be checked.
  std::optional<std::string> read_nearest_name(std::string_view key,
                                               std::span<const std::string_view> names);
  /// The table [key], if it exists.
  std::optional<TableReader> table(std::string_view key);
  /// Reads the table [key] and closes it, if it exists.
  template <typename Read>
  void in_table(std::string_view key, const Read& read) {
    auto inner = table(key);
    if (!inner) return;
    read(*inner);
    inner->close();
  }
  /// The tables [[key]], in order.
  std::vector<TableReader> tables(std::string_view key);

  /// Requires these keys.
  void require(std::initializer_list<std::string_view> keys);
  /// Reports unread keys and missing required ones: a misspelled key once, not also as missing.
  void close();

  bool has(std::string_view key) const { return find(key) != nullptr; }
  bool has_table(std::string_view key) const;
  bool is_list(std::string_view key) const;
  /// In alphabetical order.
  std::vector<std::string> keys() const;
  /// Whether no mistake was found at any of these keys.
  bool good(std::initializer_list<std::string_view> keys) const;
  /// Reports a config's mistakes, once the table is closed: each at the first existing of its keys,
  /// unless one of them already has a mistake.
  void note(const ConfigMistakes& mistakes);
  /// Reports a mistake at the key's value, or at the table if the key is absent.
  void mistake(std::string_view key, const std::string& message);
  /// Reports a mistake at the i-th value of an array.
  void mistake(std::string_view key, std::size_t i, const std::string& message);
  TomlPlace place() const { return place_; }
  /// The table's name in messages: "[layout]", "[[block.staircase]]", "the file".
  const std::string& title() const { return title_; }

 private:
  TableReader(const TomlTable& table, TomlPlace place, std::string path, std::string title,
              Mistakes& mistakes);
  std::string path_to(std::string_view key) const;
  const TomlEntry* find(std::string_view key) const;
  const TomlEntry* take(std::string_view key);
  const TomlEntry* take_misspelled(std::string_view key);
  void refuse(const TomlNode& node, std::string_view key, const std::string& expected);
  void refuse_unknown(const TomlEntry& entry);
  void read_spaced(std::string_view key, ValueGrid& field, const Range& range);
  std::optional<double> number(const TomlNode& node, std::string_view key, const Range& range);
  std::optional<std::int64_t> whole(std::string_view key, const WholeRange& range);
  std::optional<std::vector<double>> numbers(std::string_view key, const Range& range,
                                             std::size_t count);
  std::optional<std::vector<double>> numbers(const TomlNode& node, std::string_view key,
                                             const Range& range, std::size_t count);

  const TomlTable* table_;
  TomlPlace place_;
  std::string path_, title_;
  Mistakes* mistakes_;
  std::set<std::string, std::less<>> known_, mistaken_;
  std::vector<std::string> required_;
};

}  // namespace heft
