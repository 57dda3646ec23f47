// Storing sessions that are already over: for simulations of many participants, which are computed
// in worker threads and written by one. The rows are those a SessionLog would have written.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "record/stream/RecordedSession.h"

namespace heft {

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
