// Names in files, logs and on the command line: of enumerators, of the entries of a table and of
// the types in a closed list; suggestions for mistyped names.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/Error.h"

namespace heft {

/// Specialize with `static constexpr std::array<std::string_view, N> names`, in the order of the
/// enumerators, which must count from 0.
template <typename Enum>
struct EnumNames;

template <typename Enum>
constexpr std::string_view name_of(Enum value) {
  return EnumNames<Enum>::names.at(static_cast<std::size_t>(value));
}

template <typename Enum>
constexpr std::optional<Enum> named(std::string_view name) {
  const auto& names = EnumNames<Enum>::names;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return static_cast<Enum>(i);
  return std::nullopt;
}

/// The candidate with the smallest edit distance to `wanted`; none when every distance exceeds both
/// 2 and half the length of `wanted`.
std::optional<std::string> nearest_name(std::string_view wanted,
                                        std::span<const std::string_view> candidates);

/// "1 trial" or "2 trials"
std::string counted(std::int64_t n, std::string_view what);

/// "a", "b" or "c"
std::string quoted_list(std::span<const std::string_view> names);

/// A usage error: there is no simulator "bulet", did you mean "bullet"?; expected "bullet", ...
Error unknown_name(std::string_view kind, std::string_view name,
                   std::span<const std::string_view> known);

/// The names of a table's entries, in order.
template <typename Entry>
std::vector<std::string_view> names_in(std::span<const Entry> table) {
  std::vector<std::string_view> names;
  for (const Entry& entry : table) names.push_back(entry.name);
  return names;
}

/// The entry of that name.
/// @param kind of the entries, for the message: "simulator"
/// @throws Error (usage) with the nearest name and all names when the name is unknown
template <typename Entry>
const Entry& entry_named(std::string_view kind, std::string_view name,
                         std::span<const Entry> table) {
  for (const Entry& entry : table)
    if (entry.name == name) return entry;
  throw unknown_name(kind, name, names_in(table));
}

/// A closed list of types: each has `static constexpr std::string_view kind` and defaults.
template <typename... Kind>
struct NamedKinds {
  using Any = std::variant<Kind...>;
  static constexpr std::array<std::string_view, sizeof...(Kind)> names{Kind::kind...};

  /// The default value of the kind of that name, which must be one of `names`.
  static Any defaults(std::string_view name) {
    Any any;
    ((name == Kind::kind ? void(any.template emplace<Kind>()) : void()), ...);
    return any;
  }

  /// Calls visit with the default value of every kind.
  template <typename Visit>
  static void for_each(Visit&& visit) {
    (visit(Kind{}), ...);
  }
};

}  // namespace heft
