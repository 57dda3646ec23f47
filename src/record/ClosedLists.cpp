#include "record/ClosedLists.h"

#include <array>

namespace heft {

namespace {
template <typename Enum>
constexpr ClosedList list() {
  return {closed_list<Enum>, EnumNames<Enum>::names};
}
constexpr std::array lists{list<Task>(),         list<Label>(),   list<ActionKind>(),
                           list<TrialStatus>(),  list<Outcome>(), list<EventKind>(),
                           list<SessionState>(), list<Finish>(),  list<Censored>(),
                           list<Purpose>()};
}  // namespace

std::span<const ClosedList> closed_lists() {
  return lists;
}

}  // namespace heft
