// A log of the version before (tests/golden/logs): upgraded when it is opened, with the older file
// kept beside it; its sessions keep their digests. Logs of versions before that are refused.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/files/TextFile.h"
#include "experiment/Rows.h"
#include "record/failure.h"
#include "record/older_log.h"
#include "record/reader/LogReader.h"
#include "record/schema/EventRow.h"
#include "record/schema/Schema.h"
#include "record/tampered_log.h"

namespace heft::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr int older = 5;
constexpr auto all_sessions = {1, 2, 3};

class older_version : public testing::Test {
 protected:
  void SetUp() override { copy_older_log(log_); }

  void sql(const std::string& text) { SQLite::Database(log_, SQLite::OPEN_READWRITE).exec(text); }
  int number(const std::string& file, const char* query) {
    return SQLite::Database(file, SQLite::OPEN_READONLY).execAndGet(query).getInt();
  }
  int version(const std::string& file) { return number(file, "PRAGMA user_version"); }

  TemporaryFolder folder_;
  std::string log_ = folder_.file("log.db");
  std::string older_file_ = log_ + ".v5";
};

TEST_F(older_version, is_upgraded_with_the_older_file_beside_it) {
  const int n_events = number(log_, "SELECT count(*) FROM event");
  const int n_answers = number(log_, "SELECT count(*) FROM answer");
  const LogReader reader(log_);
  EXPECT_EQ(version(log_), schema::current_version);
  EXPECT_EQ(number(log_, "SELECT count(*) FROM event"), n_events);
  EXPECT_EQ(number(log_, "SELECT count(*) FROM answer WHERE value IS NULL"), n_answers);
  EXPECT_THAT(reader.foreign_objects(), testing::IsEmpty());
  EXPECT_THAT(check_integrity(log_), testing::IsEmpty());
  EXPECT_EQ(version(older_file_), older);
  EXPECT_EQ(number(older_file_, "SELECT count(*) FROM event"), n_events);
  EXPECT_EQ(fs::status(older_file_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(older_version, keeps_every_answer) {
  const auto answers = [&](const std::string& file) {
    SQLite::Database database(file, SQLite::OPEN_READONLY);
    SQLite::Statement query(database,
                            "SELECT answer_id || ' ' || trial_id || ' ' || t_s || ' ' || action || "
                            "' ' || ifnull(slot, '-') || ' ' || ifnull(label, '-') FROM answer "
                            "ORDER BY rowid");
    std::vector<std::string> rows;
    while (query.executeStep()) rows.push_back(query.getColumn(0));
    return rows;
  };
  const auto before = answers(log_);
  ASSERT_GT(before.size(), 20u);
  LogReader{log_};
  EXPECT_EQ(answers(log_), before);
}

TEST_F(older_version, gets_the_words_of_its_tasks) {
  EXPECT_EQ(number(log_, "SELECT count(*) FROM pragma_table_info('list_task')"), 1);
  LogReader{log_};
  EXPECT_GT(number(log_, "SELECT count(*) FROM list_task WHERE edition = 1"), 0);
  EXPECT_EQ(number(log_, "SELECT count(DISTINCT task) FROM trial"),
            number(log_, "SELECT count(*) FROM list_task WHERE edition = 1"));
}

TEST_F(older_version, keeps_its_digests_and_finds_what_was_changed) {
  for (const std::int64_t session_id : all_sessions)
    EXPECT_FALSE(LogReader(log_).first_broken_digest(session_id)) << session_id;
  sql("UPDATE event SET t_s = t_s + 1e-9 WHERE event_id = 7");
  EXPECT_TRUE(LogReader(log_).first_broken_digest(1));
}

TEST_F(older_version, is_continued_in_the_current_version) {
  {
    SessionLog log = SessionLog::reopen(log_, 1);
    log.append({9999, CubeTouch{1, 0.5, 0.02, 0.01}}, of_attempt(1), Durability::acknowledged);
  }
  const LogReader reader(log_);
  EXPECT_FALSE(reader.first_broken_digest(1));
  EXPECT_EQ(reader.events(1).back().event.as<CubeTouch>()->peak_lag_m, 0.01);
}

TEST_F(older_version, with_something_foreign_in_it_is_refused_and_left_as_it_is) {
  for (const char* change : {"CREATE TRIGGER bad AFTER INSERT ON event BEGIN SELECT 1; END",
                             "CREATE TABLE bad (text TEXT)", "CREATE INDEX bad ON cube (mass_g)"}) {
    copy_older_log(log_);
    sql(change);
    try {
      LogReader reader(log_);
      ADD_FAILURE() << "it was opened after " << change;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("bad"));
      EXPECT_EQ(error.exit_code(), ExitCode::diverged);
    }
    EXPECT_EQ(version(log_), older);
  }
}

TEST_F(older_version, with_a_cell_that_heft_never_wrote_is_refused_and_left_as_it_is) {
  for (const char* change : {"UPDATE answer SET slot = 9 WHERE answer_id = 2",
                             "UPDATE trial SET task = 'dance' WHERE trial_id = 2"}) {
    copy_older_log(log_);
    sql(std::string("PRAGMA ignore_check_constraints = ON; ") + change);
    try {
      LogReader reader(log_);
      ADD_FAILURE() << "it was opened after " << change;
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), ExitCode::diverged) << error.what();
    }
    EXPECT_EQ(version(log_), older);
  }
}

TEST_F(older_version, keeps_one_older_file_however_often_it_is_tried) {
  std::ofstream(older_file_ + ".part") << "cut short";
  sql("CREATE TRIGGER bad AFTER INSERT ON event BEGIN DELETE FROM answer; END");
  for (int i = 0; i < 2; ++i) EXPECT_THROW(LogReader{log_}, Error);
  EXPECT_EQ(version(older_file_), older);
  EXPECT_FALSE(fs::exists(older_file_ + ".part"));
  EXPECT_FALSE(fs::exists(older_file_ + "-2"));
}

TEST_F(older_version, is_read_from_memory_while_another_program_holds_it) {
  const int other = ::open(log_.c_str(), O_RDONLY);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  EXPECT_EQ(LogReader(log_).sessions().size(), all_sessions.size());
  EXPECT_EQ(version(log_), older);
  EXPECT_FALSE(fs::exists(older_file_));
  ::close(other);
}

TEST_F(older_version, before_the_oldest_that_is_read_is_refused_and_left_as_it_is) {
  for (const int outdated : {1, 4}) {
    sql(fmt::format("PRAGMA user_version = {}", outdated));
    const std::string bytes = read_text_file(log_);
    const auto is_explained =
        AllOf(HasSubstr(log_), HasSubstr(fmt::format("a log of version {}", outdated)),
              HasSubstr("reads versions 5 to 6"), HasSubstr("the heft that wrote it"));
    EXPECT_THAT(failure([&] { LogReader{log_}; }), is_explained);
    EXPECT_THAT(failure([&] { SessionLog::reopen(log_, 1); }), is_explained);
    EXPECT_THAT(failure([&] { SessionLog::start(log_, header_of("P01")); }), is_explained);
    EXPECT_THAT(failure([&] { check_integrity(log_); }), is_explained);
    EXPECT_TRUE(read_text_file(log_) == bytes);
    EXPECT_FALSE(fs::exists(fmt::format("{}.v{}", log_, outdated)));
  }
}

// As an earlier program left it that upgraded a file and kept its sessions' versions.
TEST_F(older_version, session_of_a_version_that_is_not_read_is_refused) {
  sql("UPDATE session SET log_version = 4 WHERE session_id = 2");
  const LogReader reader(log_);
  const auto is_explained = AllOf(HasSubstr(log_), HasSubstr("session 2"), HasSubstr("version 4"),
                                  HasSubstr("reads versions 5 to 6"));
  EXPECT_THAT(failure([&] { reader.session(2); }), is_explained);
  EXPECT_THAT(failure([&] { reader.events(2); }), is_explained);
  EXPECT_THAT(failure([&] { reader.sessions(); }), is_explained);
  EXPECT_EQ(reader.session(3).session_id, 3);
}

// Text cells alone: numbers have more than one text.
std::optional<std::string> text_cell(const std::string& text) {
  return text;
}
template <typename Value>
std::optional<std::string> text_cell(const Value& value) {
  if constexpr (std::is_enum_v<Value>) return std::string(name_of(value));
  return std::nullopt;
}
template <typename Value>
std::optional<std::string> text_cell(const std::optional<Value>& value) {
  if (value) return text_cell(*value);
  return std::is_arithmetic_v<Value> ? std::nullopt : std::optional<std::string>("");
}

TEST_F(older_version, setups_have_the_same_bytes_when_they_are_written_again) {
  const LogReader reader(log_);
  SQLite::Database database(log_, SQLite::OPEN_READONLY);
  SQLite::Statement events(database, "SELECT detail FROM event WHERE kind = 'setup'");
  while (events.executeStep()) {
    const std::string logged = events.getColumn(0);
    EXPECT_EQ(to_json(setup_from_json(logged)), logged);
  }
  for (const std::int64_t id : reader.session_ids())
    for (const LoggedSetup& setup : reader.setups(id)) {
      SQLite::Statement row(database,
                            "SELECT * FROM setup WHERE session_id = ? AND setup_index = ?");
      row.bind(1, id);
      row.bind(2, setup.setup_index);
      ASSERT_TRUE(row.executeStep());
      visit_cells(setup.setup, [&](const CellColumn& column, const auto& value) {
        const std::string cell = row.getColumn(column.full_name().c_str()).getString();
        EXPECT_EQ(text_cell(value).value_or(cell), cell) << column.name;
      });
    }
}

}  // namespace
}  // namespace heft::test
