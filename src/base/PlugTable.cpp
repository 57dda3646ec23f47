#include "base/PlugTable.h"

#include <fmt/format.h>

#include "base/Names.h"

namespace heft {

Error unknown_name(std::string_view kind, std::string_view name,
                   std::span<const std::string_view> known) {
  const auto nearest = nearest_name(name, known);
  return Error(fmt::format("there is no {} \"{}\"{}; expected {}", kind, name,
                           nearest ? fmt::format(", did you mean \"{}\"?", *nearest) : "",
                           quoted_list(known)),
               ExitCode::usage);
}

}  // namespace heft
