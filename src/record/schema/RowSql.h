// SQL from the rows' descriptions: names and declarations of columns, closed lists, queries and
// inserts. Private to record.
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/Event.h"
#include "experiment/Rows.h"
#include "record/schema/SessionHeader.h"
#include "tasks/Task.h"

namespace heft {

/// The table with the names of an enumeration, which columns refer to.
template <typename Enum>
inline constexpr std::string_view closed_list;
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
inline constexpr std::string_view closed_list<StopReason> = "list_stop_reason";
template <>
inline constexpr std::string_view closed_list<Censored> = "list_censored";
template <>
inline constexpr std::string_view closed_list<Purpose> = "list_purpose";

struct ClosedList {
  std::string_view table;
  std::vector<std::string_view> names;
};

/// Whether a type's values are names of a closed list.
template <typename Value>
inline constexpr bool is_listed = std::is_enum_v<Value> || is_word<Value>;

template <typename Listed>
std::vector<std::string_view> listed_names() {
  if constexpr (is_word<Listed>)
    return words_of<Listed>();
  else
    return {EnumNames<Listed>::names.begin(), EnumNames<Listed>::names.end()};
}

/// The lists of enumerations, filled when a log is created.
std::span<const ClosedList> closed_lists();

/// The lists of the tasks' words. A task's words are added with its name and edition when its first
/// trial starts, so a new task needs no new version of the log.
inline constexpr std::array<std::string_view, 4> word_lists{
    closed_list<Task>, closed_list<Label>, closed_list<ActionKind>, closed_list<Outcome>};

/// A task's words for a list.
std::vector<std::string_view> words_for(std::string_view table, const TaskDeclaration& task);

/// A visitor that collects names and declarations of columns.
class ColumnSql {
 public:
  template <typename Value>
  void operator()(const CellColumn& column, const Value&) {
    names.push_back(column.full_name());
    declarations.push_back(fmt::format("{} {}", names.back(), declared<Value>(column)));
  }

  std::vector<std::string> names, declarations;

 private:
  template <typename Value>
  static std::string declared(const CellColumn& column) {
    // A REAL column loses the sign of -0.0, which would change the bits of the physics.
    if (column.exact)
      return fmt::format("ANY NOT NULL CHECK (typeof({}) IN ('real', 'integer'))",
                         column.full_name());
    if constexpr (requires(Value value) { value.has_value(); })
      return type_of<typename Value::value_type>() + checked<typename Value::value_type>(column);
    else
      return type_of<Value>() + " NOT NULL" + checked<Value>(column);
  }
  template <typename Value>
  static std::string type_of() {
    if constexpr (is_listed<Value> || std::same_as<Value, std::string>)
      return "TEXT";
    else if constexpr (std::floating_point<Value>)
      return "REAL";
    else
      return "INTEGER";
  }
  template <typename Value>
  static std::string checked(const CellColumn& column) {
    if constexpr (is_listed<Value>)
      return fmt::format(" REFERENCES {}", closed_list<Value>);
    else if constexpr (std::same_as<Value, bool>)
      return fmt::format(" CHECK ({} IN (0, 1))", column.name);
    else
      return column.check.empty() ? "" : fmt::format(" CHECK ({} {})", column.name, column.check);
  }
};

template <typename Row>
ColumnSql sql_of() {
  ColumnSql sql;
  visit_cells(Row{}, sql);
  return sql;
}

/// "t_s, kind, slot"
template <typename Row>
std::string columns_of() {
  return fmt::format("{}", fmt::join(sql_of<Row>().names, ", "));
}

/// Start of a session's chains of digests. Parameter: the session's id.
inline constexpr auto chain_start_sql =
    "SELECT participant || '/' || protocol_sha256 || '/' || seed FROM session WHERE session_id = ?";

// The following queries select the row's id, the attempt index (0 without a trial; a text, which
// Cells refuses, if the session has no such trial), then `columns`; ordered by id. ?1 is the
// session.

/// Rows with a column session_id. @param condition SQL expression
std::string in_session(std::string_view table, std::string_view id, std::string_view columns,
                       std::string_view condition = "true");

/// The same for frames, using the index of sessions.
std::string frames_in_session(std::string_view columns);

/// Rows that belong to a session by their trial.
std::string in_trials(std::string_view table, std::string_view id, std::string_view columns);

/// INSERT INTO table(columns) VALUES (?, ?, ...)
std::string insert_sql(std::string_view table, std::string_view columns);

/// insert_sql that updates an existing row with the same key columns.
std::string upsert_sql(std::string_view table, std::string_view columns, std::string_view key);

}  // namespace heft
