// Reads the keys of one TOML table into typed fields. Every mistake is noted at its place and
// reading goes on, so that a file's mistakes are reported together. The order is: read every key,
// close(), then check fields against each other with good().
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

/// Places and sizes in meters.
inline constexpr Range on_earth{-1e6, 1e6};
inline constexpr Range size_on_earth{least, 1e6};

class TableReader {
 public:
  TableReader(const TomlTable& root, Mistakes& mistakes);

  // Each leaves `field` as it is where the key is absent or its value a mistake.
  void read(std::string_view key, double& field, const Range& range = any_number);
  void read(std::string_view key, std::optional<double>& field, const Range& range = any_number);
  void read(std::string_view key, int& field, const WholeRange& range = {});
  void read(std::string_view key, std::uint64_t& field, const WholeRange& range);
  void read(std::string_view key, bool& field);
  void read(std::string_view key, std::string& field);
  /// Any number of numbers, but not none.
  void read(std::string_view key, std::vector<double>& field, const Range& range = any_number);
  /// Any number of texts that are not empty, but not none.
  void read(std::string_view key, std::vector<std::string>& field);
  void read(std::string_view key, Eigen::Vector2d& field, const Range& range = any_number);
  void read(std::string_view key, Eigen::Vector3d& field, const Range& range = any_number);
  /// Any number of pairs [a, b], but not none; none after a mistake.
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
  /// One of `names`; none where the key is absent or its value a mistake.
  std::optional<std::string> read_name(std::string_view key,
                                       std::span<const std::string_view> names);
  /// As read_name, but the key must be there, and where it or its value is misspelled, gives what
  /// was most likely meant: so that the table can be checked further.
  std::optional<std::string> read_nearest_name(std::string_view key,
                                               std::span<const std::string_view> names);
  /// The table [key], if it is there.
  std::optional<TableReader> table(std::string_view key);
  /// Reads the table [key] and closes it, if it is there.
  template <typename Read>
  void in_table(std::string_view key, const Read& read) {
    auto inner = table(key);
    if (!inner) return;
    read(*inner);
    inner->close();
  }
  /// The tables [[key]], in order.
  std::vector<TableReader> tables(std::string_view key);

  /// Says that these keys must be there.
  void require(std::initializer_list<std::string_view> keys);
  /// Notes the keys that nothing has read, and those required that are missing: a misspelled key
  /// once, not also as a missing one.
  void close();

  bool has(std::string_view key) const { return find(key) != nullptr; }
  bool has_table(std::string_view key) const;
  bool is_list(std::string_view key) const;
  /// By name.
  std::vector<std::string> keys() const;
  /// Whether no mistake was noted at any of these keys.
  bool good(std::initializer_list<std::string_view> keys) const;
  /// Notes what a config's check() found, once the table is closed: each mistake at the first of
  /// its keys that is there, and not where a mistake was noted at one of them.
  void note(const ConfigMistakes& mistakes);
  /// Notes a mistake at the key's value, or at the table where the key is absent.
  void mistake(std::string_view key, const std::string& message);
  /// Notes a mistake at the i-th value of an array.
  void mistake(std::string_view key, std::size_t i, const std::string& message);
  TomlPlace place() const { return place_; }
  /// How messages call the table: "[layout]", "[[block.staircase]]", "the file".
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
