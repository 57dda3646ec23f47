#include "record/InfoDigest.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "record/RowDigest.h"

namespace heft {

std::string info_digest(SQLite::Database& database, std::int64_t session_id) {
  RowDigest digest;
  digest.begin("participant_info", "");
  SQLite::Statement query(
      database, "SELECT key, value FROM participant_info WHERE session_id = ? ORDER BY key");
  query.bind(1, session_id);
  while (query.executeStep()) {
    digest.cell(query.getColumn(0));
    digest.cell(query.getColumn(1));
  }
  return digest.value();
}

}  // namespace heft
