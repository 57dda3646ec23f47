// What a participant told, in one digest: it may be told again, so that its rows have no order.
// Private to this room.
#pragma once

#include <cstdint>
#include <string>

namespace SQLite {
class Database;
}

namespace heft {

/// Over the session's rows of participant_info, by key.
std::string info_digest(SQLite::Database& database, std::int64_t session_id);

}  // namespace heft
