// Looking up a plug by its name in the one table that names them all.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "base/Error.h"

namespace heft {

/// "there is no simulator "bulet", did you mean "bullet"?; expected "bullet", "bullet-ea"..."
/// @return an error of usage
Error unknown_name(std::string_view kind, std::string_view name,
                   std::span<const std::string_view> known);

/// The names of a table, in its order.
template <typename Entry>
std::vector<std::string_view> names_in(std::span<const Entry> table) {
  std::vector<std::string_view> names;
  for (const Entry& entry : table) names.push_back(entry.name);
  return names;
}

/// The entry of that name.
/// @param kind what the table holds, for the message
/// @throws Error (usage) naming the nearest and all names when there is none
template <typename Entry>
const Entry& entry_named(std::string_view kind, std::string_view name,
                         std::span<const Entry> table) {
  for (const Entry& entry : table)
    if (entry.name == name) return entry;
  throw unknown_name(kind, name, names_in(table));
}

}  // namespace heft
