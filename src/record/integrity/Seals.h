// The check of a session's digests, and seals: the contents of the log's sessions, chained. Private
// to record.
//
// A session is sealed when it ends or is left; one that was cut off, when the log is next written.
// A seal covers the session's id, header (with its start time), state, events, frames and answers
// about the participant, and the previous seal. A session that is resumed gets another seal. The
// digest of a seal is the log's head. With a head that was noted elsewhere one can check that the
// sessions up to it are complete and unchanged, even if all digests in the file were recomputed.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "record/integrity/Integrity.h"

namespace SQLite {
class Database;
}  // namespace SQLite

namespace heft {

/// Seals a session as it is, unless its last seal has the same contents. @return the head
std::string seal(SQLite::Database& database, std::int64_t session_id);

/// Seals all sessions with contents that no seal covers. Call it before another session is written.
void seal_sessions(SQLite::Database& database);

/// Seals a session that has ended. Call it in the transaction that ends it, so that an ended
/// session never lacks its seal.
void seal_if_ended(SQLite::Database& database, std::int64_t session_id);

/// In the order of sealing.
std::vector<Seal> seals_in(SQLite::Database& database);

/// The first seal that does not follow from the previous one, or whose session is missing. Also
/// sessions without a seal: only the one written last may have rows that no seal covers, and only
/// until it has ended. And rows whose ids leave a gap that is not a withdrawn session's.
std::optional<BrokenDigest> first_broken_seal(SQLite::Database& database);

/// By table: how many ids below its last one have no row. None, unless a session was withdrawn;
/// then as many from then on, because later rows are numbered without gaps.
std::map<std::string, std::int64_t> missing_ids(SQLite::Database& database);

/// Checks the header, the answers about the participant, events and frames (the earlier row by
/// time), and the counts of rows. Cells are read as stored, so that invalid values are found as
/// well.
/// @param file for messages
/// @throws Error if there is no such session, SQLite::Exception if pages are damaged
std::optional<BrokenDigest> first_broken_digest(SQLite::Database& database, const std::string& file,
                                                std::int64_t session_id);

/// Compares a session with its seals. The seals before a resumption cover its first rows, so it
/// needs the digests of all rows, in order.
/// Of a withdrawn session only the last seal is compared.
class SealCheck {
 public:
  SealCheck(SQLite::Database& database, std::int64_t session_id);

  void event(const std::string& digest);
  /// @param chain the frame's chain: its attempt
  void frame(const std::string& chain, const std::string& digest);

  /// Call it after all rows.
  std::optional<BrokenDigest> first_broken() const;

 private:
  void collect_frames();

  SQLite::Database& database_;
  std::int64_t session_id_;
  std::vector<Seal> seals_;
  std::int64_t n_events_ = 0, n_frames_ = 0;
  /// Digests of the first n rows, by n.
  std::map<std::int64_t, std::string> events_, frames_;
  /// Number and digest of the last frame of each chain.
  std::map<std::string, std::pair<std::int64_t, std::string>> chains_;
};

}  // namespace heft
