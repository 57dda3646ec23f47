// The list of tasks, closed at compile time. A new task is one entry here and its own files.
#pragma once

#include <any>
#include <array>
#include <string_view>

#include "base/Names.h"
#include "tasks/Adjustment.h"
#include "tasks/Comparison.h"
#include "tasks/Estimation.h"
#include "tasks/Introduction.h"
#include "tasks/Judgment.h"
#include "tasks/Sorting.h"

namespace heft {

template <typename... Kinds>
struct KindsOfTask {
  static constexpr std::array<const TaskDeclaration*, sizeof...(Kinds)> declarations{
      &Kinds::task...};

  /// Calls visit.operator()<Kind>() for each task.
  template <typename Visit>
  static void each(Visit&& visit) {
    (visit.template operator()<Kinds>(), ...);
  }

  /// Calls visit.operator()<Kind>() for the named task. @return whether it exists
  template <typename Visit>
  static bool call(std::string_view name, Visit&& visit) {
    return ((name == Kinds::task.name && (visit.template operator()<Kinds>(), true)) || ...);
  }
};

using Tasks = KindsOfTask<Introduction, Sorting, Comparison, Estimation, Judgment, Adjustment>;

/// The task's offer from ScreenState::offer; empty: its default.
template <typename Kind>
typename Kind::Offer offer_of(const std::any& offer) {
  const auto* its = std::any_cast<typename Kind::Offer>(&offer);
  return its ? *its : typename Kind::Offer{};
}

}  // namespace heft
