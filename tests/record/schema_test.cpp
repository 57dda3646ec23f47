// The database enforces types, references, names and ranges.
#include "record/schema/Schema.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "record/reader/LogReader.h"
#include "record/rows.h"
#include "record/schema/RowSql.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"
#include "tasks/Task.h"

namespace heft::test {
namespace {

class SchemaRules : public testing::Test {
 protected:
  void SetUp() override {
    {
      SessionLog log = SessionLog::start(file_, header_of("P01"));
      log.append(event(1, event_kind<TrialStarted>), starting(sorting_trial(1, 1)),
                 Durability::acknowledged);
      Changes changes = of_attempt(1);
      const Event answer = action(2, "label", 2, "heaviest");
      changes.answers = {answer_of(1, answer)};
      changes.reversals = {{1, "15g", 1, 100, 50, 50}};
      changes.estimates = {{"15g",
                            "mean_of_reversals",
                            70.0,
                            {},
                            {},
                            30,
                            10,
                            0,
                            0,
                            StopReason::reversals,
                            Censored::none}};
      log.append(answer, changes, Durability::acknowledged);
      log.add_frame(frame(1, 2));
    }
    database_ = std::make_unique<SQLite::Database>(file_, SQLite::OPEN_READWRITE);
    database_->exec("PRAGMA foreign_keys = ON");
  }

  bool accepts(const std::string& sql) {
    try {
      database_->exec(sql);
      return true;
    } catch (const SQLite::Exception& error) {
      EXPECT_EQ(error.getErrorCode(), SQLITE_CONSTRAINT) << sql << ": " << error.what();
      return false;
    }
  }

  // Words of the only task with a trial.
  template <typename Listed>
  void expect_exactly_the_names(const std::string& table, const std::string& column) {
    std::vector<std::string_view> names;
    if constexpr (is_word<Listed>)
      names = words_for(closed_list<Listed>, task_named("sorting"));
    else
      names = listed_names<Listed>();
    for (const std::string_view name : names)
      EXPECT_TRUE(accepts(fmt::format("UPDATE {} SET {} = '{}'", table, column, name))) << name;
    EXPECT_FALSE(accepts(fmt::format("UPDATE {} SET {} = 'foo'", table, column))) << column;
    EXPECT_FALSE(accepts(fmt::format("UPDATE {} SET {} = ''", table, column))) << column;
  }

  static constexpr int SQLITE_CONSTRAINT = 19;
  TemporaryFolder folder_;
  std::string file_ = folder_.file("log.db");
  std::unique_ptr<SQLite::Database> database_;
};

TEST_F(SchemaRules, FileHasApplicationId) {
  EXPECT_EQ(database_->execAndGet("PRAGMA application_id").getInt(), 0x48656674);
  EXPECT_EQ(database_->execAndGet("PRAGMA user_version").getInt(), current_log_version);
  EXPECT_EQ(database_->execAndGet("PRAGMA journal_mode").getString(), "wal");
}

TEST_F(SchemaRules, EveryTableIsStrict) {
  EXPECT_EQ(database_
                ->execAndGet("SELECT count(*) FROM pragma_table_list WHERE schema = 'main' AND "
                             "type = 'table' AND name NOT LIKE 'sqlite_%' AND NOT strict")
                .getInt(),
            0);
  EXPECT_EQ(database_
                ->execAndGet("SELECT count(*) FROM pragma_table_list WHERE schema = 'main' AND "
                             "type = 'table' AND strict")
                .getInt(),
            12 + static_cast<int>(closed_lists().size() + word_lists.size()));
  EXPECT_FALSE(accepts("UPDATE event SET t_s = 'soon'"));
  EXPECT_FALSE(accepts("UPDATE trial SET attempt = 1.5"));
  EXPECT_FALSE(accepts("UPDATE frame SET effector_x_m = 'left'"));
  EXPECT_FALSE(accepts("UPDATE frame SET effector_x_m = NULL"));
}

TEST_F(SchemaRules, EnumerationsAcceptExactlyTheirNames) {
  expect_exactly_the_names<SessionState>("session", "state");
  expect_exactly_the_names<EventKind>("event", "kind");
  expect_exactly_the_names<Label>("event", "label");
  expect_exactly_the_names<Task>("trial", "task");
  expect_exactly_the_names<TrialStatus>("trial", "status");
  expect_exactly_the_names<Outcome>("trial", "outcome");
  expect_exactly_the_names<ActionKind>("answer", "action");
  expect_exactly_the_names<Label>("answer", "label");
  expect_exactly_the_names<Purpose>("session", "purpose");
  expect_exactly_the_names<StopReason>("estimate", "reason");
  expect_exactly_the_names<Censored>("estimate", "censored");
}

// A new task needs no new version: its words come with its first trial. Unknown and missing words
// are reported.
TEST_F(SchemaRules, WordsComeWithFirstTrialAndForeignOnesAreReported) {
  const auto entries = [&](const std::string& condition) {
    return database_->execAndGet("SELECT count(*) FROM list_action WHERE " + condition).getInt();
  };
  EXPECT_EQ(entries("task = 'sorting' AND edition = 1"), 4);
  EXPECT_EQ(entries("true"), 4);
  EXPECT_TRUE(schema::foreign_objects(*database_).empty());
  schema::add_words(*database_, "comparison");
  EXPECT_EQ(entries("task = 'comparison'"), 5);
  EXPECT_TRUE(schema::foreign_objects(*database_).empty());
  // A log of the edition without "different" gets the word with its next trial.
  database_->exec("DELETE FROM list_action WHERE name = 'different'");
  EXPECT_FALSE(schema::foreign_objects(*database_).empty());
  for (const char* list : {"list_action", "list_outcome", "list_task"})
    database_->exec(fmt::format("UPDATE {} SET edition = 1 WHERE task = 'comparison'", list));
  EXPECT_TRUE(schema::foreign_objects(*database_).empty());
  schema::add_words(*database_, "comparison");
  EXPECT_EQ(entries("name = 'different' AND edition = 3"), 1);
  EXPECT_TRUE(schema::foreign_objects(*database_).empty());
  for (const char* change : {"INSERT INTO list_action VALUES ('shout', 'sorting', 1)",
                             "UPDATE list_label SET edition = 2 WHERE name = '1'",
                             "DELETE FROM list_label WHERE name = '6'",
                             "INSERT INTO list_task VALUES ('dance', 'dance', 1)"}) {
    database_->exec("SAVEPOINT before");
    database_->exec(change);
    EXPECT_FALSE(schema::foreign_objects(*database_).empty()) << change;
    database_->exec("ROLLBACK TO before; RELEASE before");
  }
}

TEST_F(SchemaRules, InvalidNumbersAreRefused) {
  for (const char* assignment :
       {"event SET t_s = -1",           "event SET slot = 0",          "event SET slot = 7",
        "cube SET mass_g = 0",          "cube SET n_pushes = -1",      "cube SET contact_s = -0.5",
        "trial SET attempt = 0",        "trial SET trial_number = 0",  "trial SET is_catch = 2",
        "trial SET choice_correct = 2", "trial SET reference_g = -15", "trial SET chosen_slot = 7",
        "trial SET paused_s = -1",      "trial SET lost_s = -1",       "reversal SET number = 0",
        "estimate SET n_trials = -1",   "frame SET tracked = 2",       "frame SET jump = -1",
        "frame SET contact_slot = 0",   "session SET seed = -1"})
    EXPECT_FALSE(accepts(fmt::format("UPDATE {}", assignment))) << assignment;
}

TEST_F(SchemaRules, ReferencesMustExist) {
  for (const char* statement :
       {"UPDATE event SET trial_id = 99", "UPDATE event SET session_id = 99",
        "UPDATE answer SET trial_id = 99", "UPDATE cube SET trial_id = 99 WHERE slot = 1",
        "UPDATE reversal SET trial_id = 99", "UPDATE estimate SET session_id = 99",
        "UPDATE frame SET trial_id = 99", "DELETE FROM trial", "DELETE FROM session",
        "INSERT INTO participant_info VALUES (99, 'age', '30')"})
    EXPECT_FALSE(accepts(statement)) << statement;
}

TEST_F(SchemaRules, KeysAreUnique) {
  EXPECT_FALSE(accepts("INSERT INTO reversal SELECT * FROM reversal"));
  EXPECT_FALSE(accepts("INSERT INTO estimate SELECT * FROM estimate"));
  EXPECT_FALSE(accepts("INSERT INTO cube SELECT * FROM cube"));
}

TEST_F(SchemaRules, BrokenReferenceIsTheOnlyFault) {
  EXPECT_TRUE(check_integrity(file_).empty());
  database_->exec("PRAGMA foreign_keys = OFF");
  database_->exec("UPDATE answer SET trial_id = 99");
  const auto faults = check_integrity(file_);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults.front(), "table answer, row 1: refers to a missing row of trial");
}

TEST_F(SchemaRules, ValueThatViolatesConstraintIsFault) {
  database_->exec("PRAGMA ignore_check_constraints = ON; PRAGMA foreign_keys = OFF");
  database_->exec("UPDATE event SET slot = 9 WHERE event_id = 2");
  const auto faults = check_integrity(file_);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults.front().find("event"), std::string::npos) << faults.front();
}

TEST_F(SchemaRules, DamagedPageIsFault) {
  const int page =
      database_->execAndGet("SELECT rootpage FROM sqlite_master WHERE name = 'frame'").getInt();
  constexpr int page_size = 4096;
  database_.reset();  // checkpoints the -wal file
  std::fstream(file_, std::ios::in | std::ios::out | std::ios::binary)
          .seekp(static_cast<std::streamoff>(page - 1) * page_size)
      << std::string(page_size, 'x');
  EXPECT_FALSE(check_integrity(file_).empty());
}

TEST_F(SchemaRules, QueriesUseIndexes) {
  for (const char* query :
       {"SELECT * FROM event WHERE session_id = 1", "SELECT * FROM answer WHERE trial_id = 1",
        "SELECT * FROM frame WHERE trial_id = 1", "SELECT * FROM cube WHERE trial_id = 1",
        "SELECT * FROM trial WHERE session_id = 1", "SELECT * FROM reversal WHERE session_id = 1",
        "SELECT * FROM estimate WHERE session_id = 1"}) {
    SQLite::Statement plan(*database_, fmt::format("EXPLAIN QUERY PLAN {}", query));
    ASSERT_TRUE(plan.executeStep());
    EXPECT_EQ(plan.getColumn(3).getString().rfind("SEARCH", 0), 0u) << query;
  }
}

}  // namespace
}  // namespace heft::test
