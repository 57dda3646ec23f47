// Writing the log: one SQLite file, one writer at a time. append() is the only way in for events
// and what they change; frames are buffered and written with the next event or at least each
// second.
// Storing sessions that are already over: for simulations of many participants, which are computed
// in worker threads and written by one. The rows are those a SessionLog would have written.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "record/schema/SessionHeader.h"
#include "record/stream/EventSink.h"

namespace heft {

class SessionLog final : public EventSink {
 public:
  /// Opens or creates the database at `path` and starts a new session in it: the schema, the
  /// session's row and its first event, the setup, are committed together, so that no session is
  /// in a log that does not say what it is run with. A missing or empty file becomes a log.
  /// @throws Error when another writer has the file, or it is no heft log, newer than this program,
  ///   read-only, or the disk is full
  static SessionLog start(const std::string& path, const SessionHeader& header,
                          const std::optional<RecordedEvent>& first = {});

  /// Opens the database to go on with a session.
  /// @throws Error as start(), and when there is no such session
  static SessionLog reopen(const std::string& path, std::int64_t session_id);

  SessionLog(SessionLog&&) noexcept;
  SessionLog& operator=(SessionLog&&) noexcept;
  /// Writes what is buffered, where it still can; what can't be saved and was not reported by a
  /// call before is reported on stderr.
  ~SessionLog() override;

  std::int64_t session_id() const;

  /// Writes an event and all it changes in one transaction, with everything buffered before it. A
  /// trial's first row brings its cubes along: they are written from the plan's masses.
  /// @throws Error when it could not be saved: what, why (disk full, ...), what to do. The log is
  ///   then closed: nothing of the event is in it, and every later call throws the same error, so
  ///   that no later event can follow a lost one. LogBusy when another process has locked the
  ///   database for a second: the event is kept, and the next call tries again without waiting.
  void append(const Event& event, const Changes& changes, Durability durability) override;

  /// @throws Error as append() when the buffer was due and could not be saved
  void add_frame(const FrameRow& frame) override;

  void add_info(const std::string& key, const std::string& value) override;

  /// Writes everything buffered. While nothing happens nothing is written: call it when the session
  /// stands still.
  /// @throws Error as append()
  void flush() override;

 private:
  class Impl;
  explicit SessionLog(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

class SessionArchive {
 public:
  /// Opens or creates the database and holds the writer's lock until it is destroyed.
  /// @throws Error as SessionLog::start
  explicit SessionArchive(const std::string& path);
  SessionArchive(SessionArchive&&) noexcept;
  SessionArchive& operator=(SessionArchive&&) noexcept;
  ~SessionArchive();

  /// Writes the whole session in one transaction; it is on disk when this returns.
  /// @return its session_id
  /// @throws Error when it could not be saved; nothing of it is then in the file
  std::int64_t store(const RecordedSession& session);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heft
