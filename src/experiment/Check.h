// One line of the look at the apparatus before a session.
#pragma once

#include <string>

#include "base/Names.h"
#include "experiment/EventType.h"

namespace heft {

enum class CheckVerdict { ok, warning, failed };
template <>
struct EnumNames<CheckVerdict> {
  static constexpr std::array<std::string_view, 3> names{"ok", "warning", "failed"};
};

struct CheckResult {
  static constexpr EventType event_type{"check", EventRole::recorded};
  CheckVerdict verdict = CheckVerdict::ok;
  std::string name;     ///< "frame rate", "light"...
  std::string finding;  ///< the figure, and where it is not good what was expected and what to do

  static void event_columns(auto& check, auto& row) {
    row.json("name", check.name).json("verdict", check.verdict).json("finding", check.finding);
  }
  bool operator==(const CheckResult&) const = default;
};

}  // namespace heft
