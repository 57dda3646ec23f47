// The list of tasks, closed at compile time: a further one is a line here and files of its own.
#pragma once

#include <any>
#include <array>
#include <string_view>

#include "tasks/Comparison.h"
#include "tasks/Estimation.h"
#include "tasks/Introduction.h"
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

  /// Calls visit.operator()<Kind>() for the task of that name. @return whether there is one
  template <typename Visit>
  static bool call(std::string_view name, Visit&& visit) {
    return ((name == Kinds::task.name && (visit.template operator()<Kinds>(), true)) || ...);
  }
};

using Tasks = KindsOfTask<Introduction, Sorting, Comparison, Estimation>;

/// What a task offers, out of a screen's or a trial's; empty there: that of a trial as such.
template <typename Kind>
typename Kind::Offer offer_of(const std::any& offer) {
  const auto* its = std::any_cast<typename Kind::Offer>(&offer);
  return its ? *its : typename Kind::Offer{};
}

}  // namespace heft
