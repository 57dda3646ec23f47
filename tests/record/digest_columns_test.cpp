// Every column of an event, a frame and a session's header, with every type of value.
#include <gmock/gmock.h>

#include <vector>

#include "record/tampered_log.h"

namespace heft::test {
namespace {

class DigestColumns : public TamperedLog {
 protected:
  /// Values of other types and sizes, as SQL.
  std::vector<std::string> changes_of(const std::string& table, const std::string& column,
                                      const std::string& key, int row_id) {
    SQLite::Database database(original_, SQLite::OPEN_READONLY);
    std::vector<std::string> changes;
    for (const std::string& value :
         {column + " + 1", column + " || ' '", std::string("NULL"), std::string("0"), "-" + column,
          std::string("'note'"), std::string("x'00'")}) {
      const std::string where = fmt::format("FROM {} WHERE {} = {}", table, key, row_id);
      const std::string same = fmt::format("SELECT {} IS {} {}", value, column, where);
      if (database.execAndGet(same).getInt() == 0)
        changes.push_back(
            fmt::format("UPDATE {} SET {} = {} WHERE {} = {}", table, column, value, key, row_id));
    }
    return changes;
  }

  std::vector<std::string> columns_of(const std::string& table) {
    SQLite::Database database(original_, SQLite::OPEN_READONLY);
    SQLite::Statement query(database, "SELECT name FROM pragma_table_info(?)");
    query.bind(1, table);
    std::vector<std::string> columns;
    while (query.executeStep()) columns.push_back(query.getColumn(0).getString());
    return columns;
  }

  /// @param elsewhere columns that move the row; the next row's digest differs
  void expect_every_column_found(const std::string& table, int row_id,
                                 const std::vector<std::string>& elsewhere,
                                 const std::vector<std::string>& left_out = {}) {
    const std::string key = table + "_id";
    int n_changes = 0;
    for (const std::string& column : columns_of(table)) {
      if (testing::Value(left_out, testing::Contains(column))) continue;
      const bool moves = testing::Value(elsewhere, testing::Contains(column));
      int n_taken = 0;
      for (const std::string& change : changes_of(table, column, key, row_id)) try {
          expect_found(change, table, moves ? row_id + 1 : row_id);
          ++n_taken;
        } catch (const SQLite::Exception&) {  // refused by a STRICT table
        }
      EXPECT_GT(n_taken, 0) << column;
      n_changes += n_taken;
    }
    EXPECT_GT(n_changes, 10);
  }
};

TEST_F(DigestColumns, ChangedEventIsFound) {
  expect_every_column_found("event", 2, {"session_id"}, {"event_id"});
  expect_every_column_found("event", 3, {"session_id"}, {"event_id"});
}

TEST_F(DigestColumns, ChangedFrameIsFound) {
  expect_every_column_found("frame", 1, {"session_id"}, {"frame_id"});
  expect_every_column_found("frame", 4, {"session_id"}, {"frame_id"});
}

TEST_F(DigestColumns, ChangedHeaderIsFound) {
  // Another id is another session.
  // A changed digest of the answers about the participant is found there.
  expect_every_column_found("session", 2, {}, {"session_id", "state", "info_digest"});
  expect_found("UPDATE session SET info_digest = 'x' WHERE session_id = 2", "participant_info", 2);
  expect_found("UPDATE session SET state = 'aborted' WHERE session_id = 2", "seal", 2);
  EXPECT_TRUE(found_after("UPDATE session SET seed = 1 WHERE session_id = 1", 1));
}

}  // namespace
}  // namespace heft::test
