// Enumerations that have names in files, logs and on the command line, and the nearest valid name
// to a mistyped one.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

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

/// The candidate with the smallest edit distance to `wanted`, if it is near enough to be meant.
std::optional<std::string> nearest_name(std::string_view wanted,
                                        std::span<const std::string_view> candidates);

/// "a", "b" or "c"
std::string quoted_list(std::span<const std::string_view> names);

}  // namespace heft
