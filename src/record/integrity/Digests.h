// Digests of rows: what each is taken over, and the chains that they make. Private to this room.
//
// A session's header has a digest of its own; the chain of its events and one chain of frames for
// each attempt (and for those outside of attempts) start from who took part in what with which
// seed, and each row's digest takes in the one before. Ids and the date are left out: a session
// keeps its digests in whatever file it is, and equal simulations have equal ones.
//
// This makes an edit visible to anybody who looks. It is no seal: who computes all later digests
// anew hides it, and rows cut off at the end of a chain leave no trace in it.
// Whether a session's rows still have the digests that DigestChain gave them. The rows' cells are
// taken as they are in the file, so that a damaged row is found like a changed one. Private to this
// room.
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

namespace SQLite {
class Database;
}  // namespace SQLite

namespace heft {

struct BrokenDigest;

/// Each cell is a letter for its type, then an integer's or a number's 8 bytes (little-endian), or
/// a text's length and its bytes. The digest is SHA-256 over the cells `table`, `previous digest`
/// and the row's own. One value serves all rows of a table: its buffer is used again.
class RowDigest {
 public:
  /// Begins a row. @param previous the digest of the row before it, or what its chain starts from
  void begin(std::string_view table, std::string_view previous);

  void null();
  void integer(std::int64_t value);
  void real(double value);  ///< bit for bit, as the column keeps it: see Binding
  void text(std::string_view value);
  /// A cell as it is in the file, whatever its type.
  void cell(const SQLite::Column& cell);

  /// 64 hexadecimal digits.
  std::string value() const;

 private:
  void sized(char type, std::string_view bytes);
  void eight_bytes(std::uint64_t bits);

  std::string bytes_;
};

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

/// Over what a participant told, the session's rows of participant_info, by key: it may be told
/// again, so that its rows have no order.
std::string info_digest(SQLite::Database& database, std::int64_t session_id);

/// The header before everything else, then what the participant reported, then the earliest by
/// time; last whether rows are missing at the end.
/// @param file for messages
/// @throws Error when there is no such session, SQLite::Exception where pages are damaged
std::optional<BrokenDigest> first_broken_digest(SQLite::Database& database, const std::string& file,
                                                std::int64_t session_id);

}  // namespace heft
