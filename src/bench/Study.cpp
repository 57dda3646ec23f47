#include "bench/Study.h"

#include <array>

#include "base/PlugTable.h"

namespace heft {

namespace {
constexpr std::array<StudyEntry, 0> table{};
}  // namespace

std::span<const StudyEntry> studies() {
  return table;
}

const StudyEntry& study_named(std::string_view name) {
  return entry_named("study", name, studies());
}

}  // namespace heft
