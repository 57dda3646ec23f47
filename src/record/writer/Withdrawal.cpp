#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/Error.h"
#include "base/files/TextFile.h"
#include "record/file/Failures.h"
#include "record/file/LogFile.h"
#include "record/integrity/Seals.h"
#include "record/reader/LogReader.h"
#include "record/schema/Binding.h"
#include "record/schema/Digests.h"
#include "record/schema/RowSql.h"
#include "record/schema/Schema.h"
#include "record/writer/SessionLog.h"

namespace heft {

namespace fs = std::filesystem;

namespace {
// What is kept of the session's header, once its rows are removed. Of the participant's answers,
// the place in a study is kept, so that this id is not given again (StudyPlaces.h).
SessionHeader tombstone_of(const SessionHeader& header, const std::string& when_utc,
                           SQLite::Database& database) {
  SessionHeader kept;
  kept.protocol_name = header.protocol_name;
  kept.purpose = header.purpose;
  kept.heft_version = header.heft_version;
  kept.log_version = header.log_version;
  kept.protocol_sha256 = sha256("");
  kept.run_options =
      nlohmann::json{{"withdrawn_utc", when_utc}, {"missing_ids", missing_ids(database)}}.dump();
  return kept;
}

void remove_rows(SQLite::Database& database, std::int64_t session_id) {
  const auto remove = [&](const char* table, const char* condition) {
    SQLite::Statement statement(database, fmt::format("DELETE FROM {} WHERE {}", table, condition));
    run(statement, session_id);
  };
  for (const char* table : {"cube", "answer"})
    remove(table, "trial_id IN (SELECT trial_id FROM trial WHERE session_id = ?)");
  for (const char* table :
       {"frame", "event", "reversal", "estimate", "participant_parameter", "trial", "setup"})
    remove(table, "session_id = ?");
  remove("participant_info",
         "session_id = ? AND key NOT IN ('study', 'study_place', 'study_participants')");
}

void write_tombstone(SQLite::Database& database, std::int64_t session_id,
                     const SessionHeader& kept) {
  RowDigest digest;
  digest.begin("session", "");
  std::string assigned;
  for (const std::string& column : sql_of<SessionHeader>().names) assigned += column + " = ?, ";
  SQLite::Statement update(
      database, fmt::format("UPDATE session SET {}n_events = 0, n_frames = 0, info_digest = '{}', "
                            "state = 'withdrawn', digest = ? WHERE session_id = {}",
                            assigned, info_digest(database, session_id), session_id));
  Binding row(update);
  row.also_into(digest);
  bind_row(row, kept);
  row.run_with_digest();
}

// Rewrites the file without the rows that were removed from it.
// @return why they may still be in the file, and what to do; empty: they are overwritten
std::string overwrite_removed_rows(LogFile& file) {
  SQLite::Database& database = file.database();
  try {
    database.exec("VACUUM");
    SQLite::Statement checkpoint(database, "PRAGMA wal_checkpoint(TRUNCATE)");
    const bool is_done = checkpoint.executeStep() && checkpoint.getColumn(0).getInt() == 0;
    return is_done ? "" : "another program has the log open. Close it";
  } catch (const SQLite::Exception& error) {
    const SqliteFailure failure = explained(error, &database);
    return fmt::format("{}. {}", failure.reason, failure.advice);
  }
}

Withdrawal withdraw(LogFile& file, std::int64_t session_id, const SessionHeader& header,
                    const std::string& when_utc) {
  SQLite::Database& database = file.database();
  // Removed pages are overwritten, not only marked as free.
  database.exec("PRAGMA secure_delete = ON");
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  seal_sessions(database);
  remove_rows(database, session_id);
  write_tombstone(database, session_id, tombstone_of(header, when_utc, database));
  Withdrawal done;
  done.head = seal(database, session_id);
  transaction.commit();
  done.why_not_overwritten = overwrite_removed_rows(file);
  file.check_in_place();
  return done;
}

// Of any name: backups and copies are renamed.
bool is_database(const fs::path& file) {
  constexpr std::string_view begins = "SQLite format 3";
  std::string bytes(begins.size(), '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return in && bytes == begins;
}

bool holds_session(const fs::path& file, const std::string& participant,
                   const std::string& started_utc) {
  SQLite::Database other(file.string(), SQLite::OPEN_READONLY);
  distrust(other);
  SQLite::Statement query(other, "SELECT 1 FROM session WHERE participant = ? AND started_utc = ?");
  Binding binding(query, participant, started_utc);
  return binding.step();
}

// Whether the id is a cell or a word of the text, not a part of another id.
bool names_participant(const std::string& text, const std::string& participant) {
  const auto is_outside = [&](std::size_t at) {
    return at >= text.size() || (std::isalnum(static_cast<unsigned char>(text[at])) == 0);
  };
  for (auto at = text.find(participant); at != std::string::npos;
       at = text.find(participant, at + 1))
    if ((at == 0 || is_outside(at - 1)) && is_outside(at + participant.size())) return true;
  return false;
}

// @return whether a database is a log with the session; true if it cannot be read, because a
// damaged or unfinished copy may hold anything
bool may_hold_session(const fs::path& file, const SessionHeader& header) {
  try {
    return holds_session(file, header.participant, header.started_utc);
  } catch (const std::exception&) {
    return true;
  }
}

bool is_text_about(const fs::path& file, const std::string& participant) {
  constexpr std::array<std::string_view, 4> texts{".csv", ".tsv", ".json", ".html"};
  if (std::ranges::find(texts, std::string_view(file.extension().native())) == texts.end())
    return false;
  try {
    return names_participant(read_text_file(file.string()), participant);
  } catch (const Error&) {
    return false;  // not readable
  }
}
}  // namespace

Withdrawal withdraw_session(const std::string& db, std::int64_t session_id,
                            const std::string& when_utc) {
  LogFile file(db);
  const SessionRow session = LogReader(db).session(session_id);
  if (session.state == SessionState::withdrawn)
    throw Error(fmt::format("the data of session {} in {} were already withdrawn", session_id, db),
                ExitCode::usage);
  try {
    return withdraw(file, session_id, session.header, when_utc);
  } catch (const SQLite::Exception& error) {
    throw sqlite_error(fmt::format("cannot withdraw session {} from {}", session_id, db), error,
                       &file.database());
  }
}

std::string finish_withdrawals(const std::string& db) {
  LogFile file(db);
  return overwrite_removed_rows(file);
}

CopiesOfSession copies_of_session(const std::set<std::string>& folders, const std::string& db,
                                  const SessionHeader& header) {
  CopiesOfSession copies;
  std::set<fs::path> seen{fs::weakly_canonical(db)};  // a folder may be in another
  const auto options = fs::directory_options::skip_permission_denied;
  for (const std::string& folder : folders) {
    std::error_code unreadable;
    for (auto entry = fs::recursive_directory_iterator(folder, options, unreadable);
         !unreadable && entry != fs::recursive_directory_iterator(); entry.increment(unreadable)) {
      if (!entry->is_regular_file(unreadable) ||
          !seen.insert(fs::weakly_canonical(entry->path())).second)
        continue;
      const fs::path& file = entry->path();
      if (!is_database(file)) {
        if (is_text_about(file, header.participant)) copies.texts.insert(file.string());
      } else if (may_hold_session(file, header)) {
        copies.logs.insert(file.string());
      }
    }
  }
  return copies;
}

}  // namespace heft
