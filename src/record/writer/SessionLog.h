// Writing a log: SessionLog writes a session while it runs, SessionArchive stores complete
// sessions, and withdraw_session removes one. A log is an SQLite file with one writer at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "record/schema/SessionHeader.h"
#include "record/stream/EventSink.h"

namespace heft {

/// Frames are buffered and written with the next event, or at least once per second.
class SessionLog final : public EventSink {
 public:
  /// Opens or creates the log at `path` and starts a session: schema, session row and first event,
  /// the setup, are committed together. A missing or empty file becomes a log.
  /// @throws Error if another writer has the file, it is no heft log, of a newer version or
  ///   read-only, or the disk is full
  static SessionLog start(const std::string& path, const SessionHeader& header,
                          const std::optional<RecordedEvent>& first = {});

  /// Opens the log to continue a session.
  /// @throws Error as start(), and if there is no such session
  static SessionLog reopen(const std::string& path, std::int64_t session_id);

  SessionLog(SessionLog&&) noexcept;
  SessionLog& operator=(SessionLog&&) noexcept;
  /// Writes what is buffered; a failure that no call has reported is printed to stderr.
  ~SessionLog() override;

  std::int64_t session_id() const;

  /// Writes an event, its changes and everything buffered in one transaction. A trial's first row
  /// also creates its cubes, with the plan's masses.
  /// @throws Error if it could not be saved: what, why (disk full, ...), what to do. Nothing of the
  ///   event is in the log then, and every later call throws the same error, so that no event can
  ///   follow a lost one. LogBusy if another process has locked the database for a second: the
  ///   event is kept, and the next call tries again without waiting.
  void append(const Event& event, const Changes& changes, Durability durability) override;

  /// @throws Error as append() if the buffer was due and could not be saved
  void add_frame(const FrameRow& frame) override;

  void add_info(const std::string& key, const std::string& value) override;

  /// Writes everything buffered; nothing is written between calls, so call it when the session
  /// idles.
  /// @throws Error as append()
  void flush() override;

  /// Writes everything buffered and seals the session, when it has ended or is left.
  /// @return the log's head (record/integrity/Seals.h)
  /// @throws Error as append()
  std::string seal();

 private:
  class Impl;
  explicit SessionLog(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Stores complete sessions, as a SessionLog would have written them: for simulations in worker
/// threads with one writer.
class SessionArchive {
 public:
  /// Opens or creates the log and holds the writer's lock.
  /// @throws Error as SessionLog::start
  explicit SessionArchive(const std::string& path);
  SessionArchive(SessionArchive&&) noexcept;
  SessionArchive& operator=(SessionArchive&&) noexcept;
  ~SessionArchive();

  /// Writes a session in one transaction; it is on disk on return.
  /// @return its session_id
  /// @throws Error if it could not be saved; nothing of it is in the file then
  std::int64_t store(const RecordedSession& session);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

struct Withdrawal {
  std::string head;                 ///< the log's new head
  std::string why_not_overwritten;  ///< as finish_withdrawals() returns it
};

/// Removes all rows of a session and overwrites them in the file. The session's number, protocol
/// name, purpose and versions remain, with the state "withdrawn", so that replay still verifies the
/// log, and analyses can count it.
/// @param when_utc of the withdrawal; kept with it
/// @throws Error if the log is in use or cannot be written, there is no such session, or its data
///   were withdrawn before; nothing is changed then
Withdrawal withdraw_session(const std::string& db, std::int64_t session_id,
                            const std::string& when_utc);

/// Overwrites the removed rows that an interrupted withdrawal left in the file.
/// @return why they may still be in it, and what to do: "another program has the log open. Close
///   it"; empty if they are overwritten
/// @throws Error if the log is in use or cannot be opened
std::string finish_withdrawals(const std::string& db);

/// Files that still hold a session, or may.
struct CopiesOfSession {
  std::set<std::string> logs;   ///< backups and earlier versions, by participant and start time
  std::set<std::string> texts;  ///< exports and reports, by the participant's id
};

/// Searches folders and the folders in them.
/// @param db the log itself, which is not listed  @param header of the session
CopiesOfSession copies_of_session(const std::set<std::string>& folders, const std::string& db,
                                  const SessionHeader& header);

}  // namespace heft
