// Rows into tables, inside the transaction that the caller holds. Statements are prepared once.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "record/DigestChain.h"
#include "record/RecordedSession.h"
#include "record/RowDigest.h"

namespace SQLite {
class Database;
class Statement;
}  // namespace SQLite

namespace heft {

/// Throws SQLite::Exception where the database refuses, Error where a row can't be kept as it is
/// (not a number, too many cubes, an unknown attempt).
class RowWriter {
 public:
  /// @param database must have its tables when the first row is written
  explicit RowWriter(SQLite::Database& database);
  RowWriter(RowWriter&&) noexcept;
  ~RowWriter();

  /// @return the new session's id
  std::int64_t write_session(const SessionHeader& header);

  void write(std::int64_t session_id, const RecordedEntry& entry);

  /// What the participant told; told again, it takes the place of what was there.
  void write_info(std::int64_t session_id, const std::string& key, const std::string& value);

  /// The attempt's planned trial, if it is in the log.
  std::optional<int> trial_number(std::int64_t session_id, int attempt_index);

  /// After a rollback: what was looked up may be gone.
  void forget() {
    last_attempt_.reset();
    chain_.forget();
  }

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

  void write_event(std::int64_t session_id, const RecordedEvent& recorded);
  void write_event_row(std::int64_t session_id, int attempt_index, const Event& event);
  void write_frame(std::int64_t session_id, const FrameRow& frame);
  void write_trial(std::int64_t session_id, const TrialRow& trial);
  void write_masses(std::int64_t session_id, const TrialRow& trial);
  void write_cube(std::int64_t session_id, const CubeRow& cube);
  void write_answer(std::int64_t session_id, const AnswerRow& answer);
  void write_reversal(std::int64_t session_id, const ReversalRow& reversal);
  void write_estimate(std::int64_t session_id, const EstimateRow& estimate);
  void write_state(std::int64_t session_id, SessionState state);

  SQLite::Database& database_;
  std::map<std::string, std::unique_ptr<SQLite::Statement>> statements_;
  std::optional<Attempt> last_attempt_;
  DigestChain chain_;
  RowDigest digest_;  ///< of the row being written
};

}  // namespace heft
