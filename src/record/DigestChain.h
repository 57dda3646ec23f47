// Where the next row's digest goes on from. A session's header has a digest of its own; the chain
// of its events and one chain of frames for each attempt (and for those outside of attempts)
// start from who took part in what with which seed, and each row's digest takes in the one before.
// Ids and the date are left out: a session keeps its digests in whatever file it is, and equal
// simulations have equal ones.
//
// This makes an edit visible to anybody who looks. It is no seal: who computes all later digests
// anew hides it, and rows cut off at the end of a chain leave no trace in it. Private to this room.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace SQLite {
class Database;
}

namespace heft {

/// The last digests, from memory or, where another row was written last, from the file.
class DigestChain {
 public:
  explicit DigestChain(SQLite::Database& database) : database_(database) {}

  const std::string& before_event(std::int64_t session_id);
  /// @param trial_id none: outside of attempts
  const std::string& before_frame(std::int64_t session_id, std::optional<std::int64_t> trial_id);

  /// The row after the one that was asked for last is written.
  void event_written(std::string digest) { event_->digest = std::move(digest); }
  void frame_written(std::string digest) { frame_->digest = std::move(digest); }

  /// After a rollback: rows may be gone.
  void forget();

 private:
  struct Link {
    std::int64_t session_id = 0;
    std::optional<std::int64_t> trial_id;
    std::string digest;
  };

  std::string start(std::int64_t session_id);
  std::string last_event(std::int64_t session_id);
  std::string last_frame(std::int64_t session_id, std::optional<std::int64_t> trial_id);

  SQLite::Database& database_;
  std::optional<Link> event_, frame_;
};

}  // namespace heft
