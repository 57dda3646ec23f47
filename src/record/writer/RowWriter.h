// Writes rows into tables, within the caller's transaction. Statements are prepared once. Private
// to record.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "record/schema/Digests.h"
#include "record/stream/EventSink.h"

namespace SQLite {
class Database;
class Statement;
}  // namespace SQLite

namespace heft {

/// Throws SQLite::Exception if the database fails, Error for an invalid row (NaN, too many cubes,
/// an unknown attempt).
class RowWriter {
 public:
  /// @param database must have its tables before the first row is written
  explicit RowWriter(SQLite::Database& database);
  RowWriter(RowWriter&&) noexcept;
  ~RowWriter();

  /// @return the new session's id
  std::int64_t write_session(const SessionHeader& header);

  void write(std::int64_t session_id, const RecordedEntry& entry);

  /// Writes or replaces an answer about the participant.
  void write_info(std::int64_t session_id, const std::string& key, const std::string& value);

  /// Writes the newest rows of trials and cubes, and the session's numbers of events and frames.
  /// Call it before each commit.
  void write_rest(std::int64_t session_id);

  /// The attempt's trial number, if the attempt is in the log.
  std::optional<int> trial_number(std::int64_t session_id, int attempt_index);

  /// Clears cached ids. Call it after a rollback.
  void forget();

 private:
  struct Attempt {
    std::int64_t session_id = 0;
    int attempt_index = 0;
    std::int64_t trial_id = 0;
    int trial_number = 0;
  };

  SQLite::Statement& statement(const std::string& sql);
  std::optional<Attempt> find_attempt(std::int64_t session_id, int attempt_index);
  std::int64_t trial_id(std::int64_t session_id, int attempt_index);
  std::optional<std::int64_t> trial_id_or_none(std::int64_t session_id, int attempt_index);
  std::optional<std::int64_t> setup_id(std::int64_t session_id, int setup_index);

  void write_event(std::int64_t session_id, const RecordedEvent& recorded);
  void write_setup(std::int64_t session_id, std::int64_t event_id, const SessionConfig& setup);
  void write_event_row(std::int64_t session_id, int attempt_index, const Event& event);
  void write_frame(std::int64_t session_id, const FrameRow& frame);
  void take_trial(std::int64_t session_id, const TrialRow& trial);
  void write_trial(std::int64_t session_id, const TrialRow& trial);
  void write_cubes_of_plan(std::int64_t session_id, const TrialRow& trial);
  void withdraw(std::int64_t session_id, const Changes& changes);
  void write_cube(std::int64_t session_id, const CubeRow& cube);
  void write_info_digest(std::int64_t session_id);
  template <typename... Keys>
  std::optional<std::int64_t> first_cell(const std::string& sql, const Keys&... keys);
  template <typename Row, typename... Keys>
  void insert(const std::string& sql, const Row& row, const Keys&... keys);

  SQLite::Database& database_;
  std::map<std::string, std::unique_ptr<SQLite::Statement>> statements_;
  std::optional<Attempt> last_attempt_;
  /// Rows that are newer than in the log. A trial changes with each contact and answer; only its
  /// last row of a transaction is written.
  std::map<int, TrialRow> changed_trials_;                ///< by attempt
  std::map<std::pair<int, int>, CubeRow> changed_cubes_;  ///< by attempt and slot
  std::set<std::string> tasks_;                           ///< with words in the log
  int n_new_events_ = 0, n_new_frames_ = 0;               ///< since the last write_rest()
  DigestChain chain_;
  RowDigest digest_;  ///< of the current row
};

}  // namespace heft
