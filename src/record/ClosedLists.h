// The closed lists of the log: each enumeration's names stand in a table, which the columns that
// use it refer to. Private to this room.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "experiment/Event.h"
#include "experiment/Rows.h"
#include "record/SessionHeader.h"

namespace heft {

/// The table of an enumeration's names.
template <typename Enum>
inline constexpr std::string_view closed_list = "";
template <>
inline constexpr std::string_view closed_list<Task> = "list_task";
template <>
inline constexpr std::string_view closed_list<Label> = "list_label";
template <>
inline constexpr std::string_view closed_list<ActionKind> = "list_action";
template <>
inline constexpr std::string_view closed_list<TrialStatus> = "list_status";
template <>
inline constexpr std::string_view closed_list<Outcome> = "list_outcome";
template <>
inline constexpr std::string_view closed_list<EventKind> = "list_event";
template <>
inline constexpr std::string_view closed_list<SessionState> = "list_state";
template <>
inline constexpr std::string_view closed_list<Finish> = "list_finish";
template <>
inline constexpr std::string_view closed_list<Censored> = "list_censored";
template <>
inline constexpr std::string_view closed_list<Purpose> = "list_purpose";

struct ClosedList {
  std::string_view table;
  std::span<const std::string_view> names;
};

/// All of them.
std::span<const ClosedList> closed_lists();

}  // namespace heft
