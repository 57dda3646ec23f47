// A log with foreign objects: nothing in it runs, for writers and readers.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "record/file/LogFile.h"
#include "record/reader/LogReader.h"
#include "record/rows.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"

namespace heft::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class HostileFile : public testing::Test {
 protected:
  HostileFile() {
    SessionLog log = SessionLog::start(file_, header_of("P01"));
    log.append(event(1, event_kind<Note>, "here"), {}, Durability::acknowledged);
  }
  void put_in(const std::string& sql) { SQLite::Database(file_, SQLite::OPEN_READWRITE).exec(sql); }

  static std::string failure(SQLite::Database& database, const std::string& sql) {
    try {
      SQLite::Statement(database, sql).executeStep();
    } catch (const SQLite::Exception& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
  std::string file_ = folder_.file("log.db");
};

TEST_F(HostileFile, TriggersDoNotRun) {
  put_in(
      "CREATE TABLE loot (text TEXT);"
      "CREATE TRIGGER spy AFTER INSERT ON event BEGIN INSERT INTO loot VALUES (new.detail); END");
  try {
    SessionLog log = SessionLog::reopen(file_, 1);
    log.append(event(2, event_kind<Note>, "secret"), {}, Durability::acknowledged);
  } catch (const std::exception&) {  // refusing the file is fine as well
  }
  SQLite::Database plain(file_, SQLite::OPEN_READONLY);
  EXPECT_EQ(plain.execAndGet("SELECT count(*) FROM loot").getInt(), 0);
}

TEST_F(HostileFile, ViewInPlaceOfATableIsRefused) {
  put_in(
      "PRAGMA foreign_keys = OFF; DROP VIEW v_trial; DROP VIEW v_sorting; DROP VIEW v_frame; DROP "
      "VIEW v_jnd; DROP TABLE session; CREATE VIEW session AS WITH RECURSIVE c AS (SELECT 1 UNION "
      "ALL SELECT * FROM main.c) SELECT * FROM c");
  EXPECT_THAT(test::failure([&] { LogReader{file_}.sessions(); }),
              AllOf(HasSubstr(file_), HasSubstr("cannot read the sessions")));
}

TEST_F(HostileFile, ViewsAreNotRead) {
  put_in("DROP VIEW v_trial; CREATE VIEW v_trial AS SELECT 'made up' AS outcome");
  EXPECT_THAT(failure(*open_for_reading(file_), "SELECT * FROM v_trial"), HasSubstr("prohibited"));
  EXPECT_THAT(failure(LogFile(file_).database(), "SELECT * FROM v_trial"), HasSubstr("prohibited"));
}

TEST_F(HostileFile, SchemaIsProtected) {
  LogFile log(file_);
  SQLite::Database& writer = log.database();
  EXPECT_EQ(writer.execAndGet("PRAGMA trusted_schema").getInt(), 0);
  EXPECT_EQ(open_for_reading(file_)->execAndGet("PRAGMA trusted_schema").getInt(), 0);
  writer.exec("PRAGMA writable_schema = ON");
  EXPECT_THAT(failure(writer, "DELETE FROM sqlite_master"), HasSubstr("may not be modified"));
  EXPECT_THAT(failure(writer, "SELECT \"no such word\""), HasSubstr("no such column"));
}

}  // namespace
}  // namespace heft::test
