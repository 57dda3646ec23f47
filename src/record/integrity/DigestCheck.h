// Whether a session's rows still have the digests that DigestChain gave them. The rows' cells are
// taken as they are in the file, so that a damaged row is found like a changed one. Private to this
// room.
#pragma once

#include "record/reader/LogReader.h"

namespace SQLite {
class Database;
}  // namespace SQLite

namespace heft {

/// The header before everything else, then what the participant reported, then the earliest by
/// time; last whether rows are missing at the end.
/// @param file for messages
/// @throws Error when there is no such session, SQLite::Exception where pages are damaged
std::optional<BrokenDigest> first_broken_digest(SQLite::Database& database, const std::string& file,
                                                std::int64_t session_id);

}  // namespace heft
