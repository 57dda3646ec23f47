#include "record/integrity/Integrity.h"

#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include "record/reader/ReadOnlyDatabase.h"
#include "record/schema/Schema.h"
#include "record/writer/LogFile.h"

namespace heft {

namespace {
void add_page_and_rule_faults(SQLite::Database& database, std::vector<std::string>& faults) {
  SQLite::Statement query(database, "PRAGMA integrity_check");
  while (query.executeStep()) {
    const std::string fault = query.getColumn(0).getString();
    if (fault != "ok") faults.push_back(fault);
  }
}

void add_reference_faults(SQLite::Database& database, std::vector<std::string>& faults) {
  SQLite::Statement query(database, "PRAGMA foreign_key_check");
  while (query.executeStep())
    faults.push_back(fmt::format("table {}, row {}: refers to a row of {} that is not there",
                                 query.getColumn(0).getString(), query.getColumn(1).getString(),
                                 query.getColumn(2).getString()));
}
}  // namespace

std::vector<std::string> check_integrity(const std::string& path) {
  const auto database = open_for_reading(path);
  std::vector<std::string> faults;
  try {
    holds_log(*database, path);
    // A connection that only reads leaves out the rules (CHECK), so a temporary copy is checked.
    SQLite::Database copy("", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    distrust(copy);
    SQLite::Backup(copy, *database).executeStep();
    add_page_and_rule_faults(copy, faults);
    add_reference_faults(copy, faults);
  } catch (const SQLite::Exception& error) {
    faults.push_back(error.what());
  }
  return faults;
}

}  // namespace heft
