// A closed list of types that files call by name: each has `static constexpr std::string_view kind`
// and defaults.
#pragma once

#include <array>
#include <string_view>
#include <variant>

namespace heft {

template <typename... Kind>
struct NamedKinds {
  using Any = std::variant<Kind...>;
  static constexpr std::array<std::string_view, sizeof...(Kind)> names{Kind::kind...};

  /// The defaults of the kind of that name, one of `names`.
  static Any defaults(std::string_view name) {
    Any any;
    ((name == Kind::kind ? void(any = Kind{}) : void()), ...);
    return any;
  }

  /// Calls visit with the defaults of every kind.
  template <typename Visit>
  static void for_each(Visit&& visit) {
    (visit(Kind{}), ...);
  }
};

}  // namespace heft
