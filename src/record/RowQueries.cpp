#include "record/RowQueries.h"

#include <fmt/format.h>

namespace heft {

namespace {
std::string attempt_of(std::string_view table) {
  return fmt::format(
      "CASE WHEN trial_id IS NULL THEN 0 ELSE ifnull((SELECT attempt_index FROM trial WHERE "
      "trial.trial_id = {}.trial_id AND trial.session_id = ?1), 'trial ' || trial_id || ', which "
      "is not in this session') END AS trial_id",
      table);
}
}  // namespace

std::string in_session(std::string_view table, std::string_view id, std::string_view columns,
                       std::string_view condition) {
  return fmt::format("SELECT {}, {}, {} FROM {} WHERE session_id = ?1 AND {} ORDER BY {}", id,
                     attempt_of(table), columns, table, condition, id);
}

std::string frames_in_session(std::string_view columns) {
  // The inner query reads an index alone.
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

}  // namespace heft
