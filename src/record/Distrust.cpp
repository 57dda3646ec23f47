#include "record/Distrust.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <array>
#include <utility>

#include "base/Error.h"

namespace heft {

void distrust(SQLite::Database& database) {
  constexpr std::array<std::pair<int, int>, 6> settings{{{SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                                         {SQLITE_DBCONFIG_DEFENSIVE, 1},
                                                         {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                                         {SQLITE_DBCONFIG_ENABLE_VIEW, 0},
                                                         {SQLITE_DBCONFIG_DQS_DDL, 0},
                                                         {SQLITE_DBCONFIG_DQS_DML, 0}}};
  for (const auto& [setting, wanted] : settings) {
    int now = -1;
    if (sqlite3_db_config(database.getHandle(), setting, wanted, &now) != SQLITE_OK ||
        now != wanted)
      throw Error("this SQLite can't open files from elsewhere safely; heft needs 3.31 or newer");
  }
}

}  // namespace heft
