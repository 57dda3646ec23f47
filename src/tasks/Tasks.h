// The list of tasks, closed at compile time: a further one is a line here and files of its own.
#pragma once

#include <any>
#include <array>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/Names.h"
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

/// @throws Error (usage) naming the nearest task where there is none of that name
const TaskDeclaration& task_named(std::string_view name);

/// The place of a task on the list; behind all where it is on none.
std::size_t place_of(std::string_view task);

/// The words of all tasks, each once, in the list's order.
template <typename List>
std::vector<std::string_view> words_of();
template <>
std::vector<std::string_view> words_of<Task>();
template <>
std::vector<std::string_view> words_of<ActionKind>();
template <>
std::vector<std::string_view> words_of<Label>();
template <>
std::vector<std::string_view> words_of<Outcome>();

/// An action by its kind, which fills the same columns in every task. @return null: no task has it
const ActionSpec* action_named(std::string_view kind);

/// Orders keys that begin with a task as the list does.
struct InTaskOrder {
  bool operator()(const Task& a, const Task& b) const {
    return (*this)(std::tuple(a), std::tuple(b));
  }
  template <typename Key>
  requires requires { std::tuple_size<Key>::value; }
  bool operator()(const Key& a, const Key& b) const {
    const std::size_t place_a = place_of(std::get<0>(a)), place_b = place_of(std::get<0>(b));
    return place_a != place_b ? place_a < place_b : a < b;
  }
};

}  // namespace heft
