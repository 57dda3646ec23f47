// Digests of rows. Private to record.
//
// The header of a session has a digest. Its events form a chain of digests, and so do the frames of
// each attempt and those outside attempts. A chain starts from participant, protocol and seed, and
// each row's digest includes the previous one. Ids and dates are excluded: a session keeps its
// digests in another file, and equal simulations have equal digests.
//
// Digests make an edit visible. They do not protect against someone who recomputes all later
// digests. Rows removed from the end of a chain are found by the session's counts of rows.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace SQLite {
class Column;
class Database;
}  // namespace SQLite

namespace heft {

/// SHA-256 over the cells `table`, `previous digest` and the row's own. A cell is a letter for its
/// type, then the 8 bytes of a number (little-endian), or the length and bytes of a text. Can be
/// reused for many rows.
class RowDigest {
 public:
  /// Starts a row. @param previous the digest of the previous row, or the start of the chain
  void begin(std::string_view table, std::string_view previous);

  void null();
  void integer(std::int64_t value);
  void real(double value);  ///< bit for bit, as stored: see Binding
  void text(std::string_view value);
  /// A cell of the file, of any type.
  void cell(const SQLite::Column& cell);

  /// 64 hexadecimal digits.
  std::string value() const;

 private:
  void sized(char type, std::string_view bytes);
  void eight_bytes(std::uint64_t bits);

  std::string bytes_;
};

/// The last digest of each chain, from memory or from the file.
class DigestChain {
 public:
  explicit DigestChain(SQLite::Database& database) : database_(database) {}

  const std::string& before_event(std::int64_t session_id);
  /// @param trial_id none: outside attempts
  const std::string& before_frame(std::int64_t session_id, std::optional<std::int64_t> trial_id);

  /// The digest of the new row, after before_event() or before_frame().
  void event_written(std::string digest) { event_->digest = std::move(digest); }
  void frame_written(std::string digest) { frame_->digest = std::move(digest); }

  /// Call it after a rollback.
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

/// Digest of a session's rows of participant_info, ordered by key, because they may be replaced.
std::string info_digest(SQLite::Database& database, std::int64_t session_id);

}  // namespace heft
