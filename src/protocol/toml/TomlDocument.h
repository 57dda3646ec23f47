// A TOML file as a tree of values with their places, and the collected mistakes. The only file that
// uses the TOML library; the readers of procedures, scenes and protocols interpret the values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/Error.h"

namespace heft {

struct TomlNode;
struct TomlEntry;
using TomlArray = std::vector<TomlNode>;
using TomlTable = std::vector<TomlEntry>;  ///< in no particular order; keys are unique

/// A date or time: valid TOML that no file uses.
struct TomlDate {};

/// A number too large for its type, as written.
struct TomlOverflow {
  std::string text;
};

/// Lines and columns count from 1, columns in characters.
struct TomlPlace {
  int line = 1, column = 1;
};
/// Of a value that --set gives.
inline constexpr TomlPlace set_place{0, 0};

struct TomlNode {
  TomlPlace place;
  std::variant<bool, std::int64_t, double, std::string, TomlArray, TomlTable, TomlDate,
               TomlOverflow>
      value;
};

struct TomlEntry {
  std::string key;
  TomlPlace place;
  TomlNode node;
};

/// @return the root table
/// @throws InvalidFile with the place of the first syntax error
TomlTable parse_toml(const std::string& text, const std::string& file);

/// A value for messages: short, on one line, without control characters.
std::string shown(const TomlNode& node);

class Mistakes {
 public:
  explicit Mistakes(std::string file) : file_(std::move(file)) {}
  void add(TomlPlace place, std::string message);
  /// All mistakes in order of place.
  InvalidFile as_error() const;
  /// @throws InvalidFile if there are any
  void throw_if_any() const;

 private:
  std::string file_;
  std::vector<Mistake> mistakes_;
};

}  // namespace heft
