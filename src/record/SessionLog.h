// Writing the log: one SQLite file, one writer at a time. append() is the only way in for events
// and what they change; frames are buffered and written with the next event or at least each
// second.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "experiment/Event.h"
#include "experiment/Rows.h"

namespace heft {

/// The `session` table's row as a session starts.
struct SessionHeader {
  std::string participant;
  std::string protocol_name, protocol_text, protocol_sha256;
  std::uint64_t seed = 0;  ///< 0...2^63-1
  std::string heft_version, build;
  std::string run_options;  ///< JSON: the options it was started with
  std::string purpose;      ///< main, pilot, test or simulated
  std::string responder;
  std::string started_utc;  ///< ISO 8601, the session's one anchor in UTC
};

/// acknowledged: committed to disk when append() returns, before the screen changes. buffered: in
/// order, with the next acknowledged event or within a second.
enum class Durability { acknowledged, buffered };

class SessionLog {
 public:
  /// Opens or creates the database at `path` and starts a new session in it: the schema and the
  /// session's row are committed together.
  /// @throws Error when another writer has the file, or it is no heft log, newer than this program,
  ///   read-only, or the disk is full
  static SessionLog start(const std::string& path, const SessionHeader& header);

  /// Opens the database to go on with a session.
  static SessionLog reopen(const std::string& path, std::int64_t session_id);

  SessionLog(SessionLog&&) noexcept;
  SessionLog& operator=(SessionLog&&) noexcept;
  ~SessionLog();  ///< writes what is buffered, where it still can

  std::int64_t session_id() const;

  /// Writes an event and all it changes in one transaction.
  /// @throws Error when it could not be saved: what, why (disk full, ...), what to do
  void append(const Event& event, const Changes& changes, Durability durability);

  void add_frame(const FrameRow& frame);

  /// Writes everything buffered.
  void flush();

 private:
  class Impl;
  explicit SessionLog(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace heft
