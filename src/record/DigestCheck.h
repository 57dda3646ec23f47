// Whether a session's rows still have the digests that DigestChain gave them. The rows' cells are
// taken as they are in the file, so that a damaged row is found like a changed one. Private to this
// room.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "record/Digests.h"
#include "record/LogReader.h"

namespace SQLite {
class Database;
class Statement;
}  // namespace SQLite

namespace heft {

class DigestCheck {
 public:
  DigestCheck(SQLite::Database& database, std::string file, std::int64_t session_id);

  /// The header before everything else, then what the participant told, then the earliest by time;
  /// last whether rows are missing at the end.
  /// @throws Error when there is no such session, SQLite::Exception where pages are damaged
  std::optional<BrokenDigest> first_broken();

 private:
  std::optional<BrokenDigest> broken_header();
  std::optional<BrokenDigest> broken_info();
  std::optional<BrokenDigest> broken_counts();
  std::optional<BrokenDigest> broken_event();
  std::optional<BrokenDigest> broken_frame();

  /// Into the digest: the query's cells that it was taken over.
  void add_cells(SQLite::Statement& query, int first, int n);
  /// Where the row's digest is not the next of the chain; else puts the chain forward to it.
  std::optional<BrokenDigest> broken_link(SQLite::Statement& query, const std::string& table,
                                          int n_cells, std::string& chain);

  SQLite::Database& database_;
  std::string file_;
  std::int64_t session_id_;
  std::string start_;  ///< the header's digest, from which all chains start
  RowDigest digest_;
};

}  // namespace heft
