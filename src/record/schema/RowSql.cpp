#include "record/schema/RowSql.h"

#include <algorithm>
#include <array>

namespace heft {

namespace {
template <typename Listed>
ClosedList list() {
  return {closed_list<Listed>, listed_names<Listed>()};
}

std::string attempt_of(std::string_view table) {
  return fmt::format(
      "CASE WHEN trial_id IS NULL THEN 0 ELSE ifnull((SELECT attempt_index FROM trial WHERE "
      "trial.trial_id = {}.trial_id AND trial.session_id = ?1), 'trial ' || trial_id || ', which "
      "is not in this session') END AS trial_id",
      table);
}

std::vector<std::string_view> columns_in(std::string_view list) {
  std::vector<std::string_view> columns;
  for (;;) {
    const auto comma = list.find(',');
    columns.push_back(list.substr(0, comma));
    if (comma == std::string_view::npos) return columns;
    list.remove_prefix(comma + 2);
  }
}
}  // namespace

std::span<const ClosedList> closed_lists() {
  static const std::array lists{list<TrialStatus>(), list<EventKind>(), list<SessionState>(),
                                list<StopReason>(),  list<Censored>(),  list<Purpose>()};
  return lists;
}

std::vector<std::string_view> words_for(std::string_view table, const TaskDeclaration& task) {
  std::vector<std::string_view> words;
  if (table == closed_list<Task>) words = {task.name};
  if (table == closed_list<Label>) words = {task.labels.begin(), task.labels.end()};
  if (table == closed_list<Outcome>) words = {task.outcomes.begin(), task.outcomes.end()};
  if (table == closed_list<ActionKind>)
    for (const ActionSpec& action : task.actions) words.push_back(action.kind);
  return words;
}

std::string in_session(std::string_view table, std::string_view id, std::string_view columns,
                       std::string_view condition) {
  return fmt::format("SELECT {}, {}, {} FROM {} WHERE session_id = ?1 AND {} ORDER BY {}", id,
                     attempt_of(table), columns, table, condition, id);
}

std::string frames_in_session(std::string_view columns) {
  // The inner query reads only an index.
  return fmt::format(
      "SELECT frame_id, {}, {} FROM frame WHERE frame_id IN (SELECT frame_id FROM frame WHERE "
      "session_id = ?1) ORDER BY frame_id",
      attempt_of("frame"), columns);
}

std::string in_trials(std::string_view table, std::string_view id, std::string_view columns) {
  return fmt::format(
      "SELECT {}, {}, {} FROM {} WHERE trial_id IN (SELECT trial_id FROM trial WHERE session_id = "
      "?1) ORDER BY {}",
      id, attempt_of(table), columns, table, id);
}

std::string insert_sql(std::string_view table, std::string_view columns) {
  std::string places = "?";
  for (auto n = std::count(columns.begin(), columns.end(), ','); n > 0; --n) places += ", ?";
  return fmt::format("INSERT INTO {} ({}) VALUES ({})", table, columns, places);
}

std::string upsert_sql(std::string_view table, std::string_view columns, std::string_view key) {
  const auto keys = columns_in(key);
  std::string changes;
  for (std::string_view column : columns_in(columns))
    // Assigning a key its own value would make SQLite search for rows that refer to it.
    if (std::find(keys.begin(), keys.end(), column) == keys.end())
      changes += fmt::format("{}{} = excluded.{}", changes.empty() ? "" : ", ", column, column);
  return fmt::format("{} ON CONFLICT ({}) DO UPDATE SET {}", insert_sql(table, columns), key,
                     changes);
}

}  // namespace heft
