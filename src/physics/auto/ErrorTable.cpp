#include "physics/auto/ErrorTable.h"

namespace heft {

namespace {
constexpr auto table = std::to_array<KnownError>({
#include "physics/auto/ErrorTable.inc"
});
}  // namespace

std::span<const KnownError> known_errors() {
  return table;
}

}  // namespace heft
