// Logs of earlier programs (tests/golden/logs): brought up to date when somebody opens them, with
// the older file kept beside; their sessions keep their digests and what they were run with.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/TextFile.h"
#include "experiment/EachCell.h"
#include "record/Schema.h"
#include "record/SetupJson.h"
#include "record/tampered_log.h"

namespace heft::test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class older_version : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    fs::copy_file(fs::path(HEFT_SOURCE_DIR) / "tests/golden/logs/version_2.db", log_);
    fs::permissions(log_, fs::perms::owner_write, fs::perm_options::add);
    if (GetParam() == 2) return;
    // What version 1 wrote: the same rows without the columns that came later.
    for (const char* column : {"detected_s", "simulated_s", "n_dropped"})
      sql(fmt::format("ALTER TABLE frame DROP COLUMN {}", column));
    sql("PRAGMA user_version = 1");
  }

  void sql(const std::string& text) { SQLite::Database(log_, SQLite::OPEN_READWRITE).exec(text); }
  int number(const std::string& file, const char* query) {
    return SQLite::Database(file, SQLite::OPEN_READONLY).execAndGet(query).getInt();
  }
  std::string older_file() const { return fmt::format("{}.v{}", log_, GetParam()); }

  TemporaryFolder folder_;
  std::string log_ = folder_.file("log.db");
};

TEST_P(older_version, is_brought_up_to_date_with_the_older_file_beside_it) {
  const int n_events = number(log_, "SELECT count(*) FROM event");
  const LogReader reader(log_);
  EXPECT_EQ(number(log_, "PRAGMA user_version"), schema::current_version);
  EXPECT_EQ(number(log_, "SELECT count(*) FROM event"), n_events);
  EXPECT_THAT(reader.foreign_objects(), testing::IsEmpty());
  EXPECT_EQ(number(older_file(), "PRAGMA user_version"), GetParam());
  EXPECT_EQ(number(older_file(), "SELECT count(*) FROM event"), n_events);
  EXPECT_EQ(fs::status(older_file()).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_P(older_version, keeps_its_digests_and_finds_what_was_changed) {
  {
    const LogReader reader(log_);
    for (std::int64_t session_id : {1, 2, 3, 4})
      EXPECT_FALSE(reader.first_broken_digest(session_id)) << session_id;
  }
  sql("UPDATE frame SET clone_x_m = clone_x_m + 1e-9 WHERE frame_id = 7");
  EXPECT_TRUE(LogReader(log_).first_broken_digest(1));
}

TEST_P(older_version, tells_what_each_trial_was_run_with) {
  const LogReader reader(log_);
  EXPECT_EQ(reader.setups(1).size(), 1u);
  EXPECT_EQ(reader.setups(1).front().setup.responder, WhoAnswers(Plug{"simulated"}));
  EXPECT_EQ(reader.setups(3).front().setup.simulator, "boxes");  // that was what `auto` was
  const auto resumed = reader.setups(2);
  EXPECT_EQ(resumed.front().setup.responder, WhoAnswers(Plug{"simulated"}));
  EXPECT_EQ(resumed.front().setup.tracker.name, "synthetic");
  EXPECT_FALSE(resumed.front().setup.board.text.empty());
  EXPECT_EQ(resumed.back().setup.responder, WhoAnswers(Plug{"coin"}));
  EXPECT_EQ(resumed.back().setup.tracker.name, "hand");
  const auto trials = reader.trials(2);
  EXPECT_EQ(trials.front().setup_index, 1);
  EXPECT_EQ(trials.back().setup_index, static_cast<int>(resumed.size()));
  int n_told = 0;
  for (const LoggedEvent& logged : reader.events(2))
    n_told += logged.event.as<SessionConfig>() ? 1 : 0;
  EXPECT_EQ(n_told, static_cast<int>(resumed.size()) - 1);
}

TEST_P(older_version, goes_on_in_todays_version) {
  {
    SessionLog log = SessionLog::reopen(log_, 4);
    FrameRow timed = frame(1, 99);
    timed.detected_s = 99.01;
    timed.n_dropped = 1;
    log.add_frame(timed);
  }
  {
    const LogReader reader(log_);
    EXPECT_EQ(reader.frames(4, 1).back().n_dropped, 1);
    EXPECT_EQ(reader.frames(4, 1).front().n_dropped, std::nullopt);
    EXPECT_FALSE(reader.first_broken_digest(4));
  }
  sql("UPDATE frame SET detected_s = NULL WHERE detected_s IS NOT NULL");
  EXPECT_TRUE(LogReader(log_).first_broken_digest(4));
}

TEST_P(older_version, with_something_foreign_in_it_is_refused_and_left_as_it_is) {
  sql("CREATE TRIGGER bad AFTER INSERT ON event BEGIN DELETE FROM answer; END");
  try {
    LogReader reader(log_);
    FAIL() << "it was opened";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("trigger"));
    EXPECT_THAT(error.what(), HasSubstr("bad"));
    EXPECT_EQ(error.exit_code(), ExitCode::diverged);
  }
  EXPECT_EQ(number(log_, "PRAGMA user_version"), GetParam());
}

TEST_P(older_version, with_a_cell_that_heft_never_wrote_is_refused_and_left_as_it_is) {
  for (const char* change : {"UPDATE trial SET choice_correct = 2 WHERE trial_id = 2",
                             "UPDATE session SET run_options = run_options || 'x'"}) {
    const std::string copy = log_ + "-whole";
    fs::copy_file(log_, copy, fs::copy_options::overwrite_existing);
    sql(std::string("PRAGMA ignore_check_constraints = ON; ") + change);
    try {
      LogReader reader(log_);
      ADD_FAILURE() << "it was opened after " << change;
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), ExitCode::diverged) << error.what();
    }
    EXPECT_EQ(number(log_, "PRAGMA user_version"), GetParam());
    fs::copy_file(copy, log_, fs::copy_options::overwrite_existing);
  }
}

TEST_P(older_version, keeps_one_older_file_however_often_it_is_tried) {
  std::ofstream(older_file() + ".part") << "cut short";
  sql("CREATE TRIGGER bad AFTER INSERT ON event BEGIN DELETE FROM answer; END");
  for (int i = 0; i < 2; ++i) EXPECT_THROW(LogReader{log_}, Error);
  EXPECT_EQ(number(older_file(), "PRAGMA user_version"), GetParam());
  EXPECT_FALSE(fs::exists(older_file() + ".part"));
  EXPECT_FALSE(fs::exists(older_file() + "-2"));
}

TEST_P(older_version, is_read_from_memory_while_somebody_else_holds_it) {
  const int other = ::open(log_.c_str(), O_RDONLY);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  EXPECT_EQ(LogReader(log_).sessions().size(), 4u);
  EXPECT_EQ(number(log_, "PRAGMA user_version"), GetParam());
  EXPECT_FALSE(fs::exists(older_file()));
  ::close(other);
}

class version_3 : public testing::Test {
 protected:
  void SetUp() override {
    fs::copy_file(fs::path(HEFT_SOURCE_DIR) / "tests/golden/logs/version_3.db", log_);
    fs::permissions(log_, fs::perms::owner_write, fs::perm_options::add);
  }

  TemporaryFolder folder_;
  std::string log_ = folder_.file("log.db");
};

TEST_F(version_3, is_brought_up_to_date_with_nothing_told_of_what_came_later) {
  const LogReader reader(log_);
  EXPECT_TRUE(fs::exists(log_ + ".v3"));
  EXPECT_THAT(reader.foreign_objects(), testing::IsEmpty());
  for (const std::int64_t session_id : {1, 2}) {
    EXPECT_FALSE(reader.first_broken_digest(session_id)) << session_id;
    EXPECT_EQ(reader.setups(session_id).size(), 1u);
    EXPECT_TRUE(reader.participant_parameters(session_id).empty());
    for (const TrialRow& trial : reader.trials(session_id)) {
      EXPECT_EQ(trial.setup_index, 1);
      EXPECT_FALSE(trial.plan.is_practice);
    }
    for (const CubeRow& cube : reader.cubes(session_id)) EXPECT_FALSE(cube.peak_lag_m);
  }
}

TEST_F(version_3, goes_on_with_its_own_digests) {
  {
    SessionLog log = SessionLog::reopen(log_, 1);
    log.append({9999, CubeTouch{1, 0.5, 0.02, 0.01}}, of_attempt(1), Durability::acknowledged);
  }
  const LogReader reader(log_);
  EXPECT_FALSE(reader.first_broken_digest(1));
  EXPECT_EQ(reader.events(1).back().event.as<CubeTouch>()->peak_lag_m, 0.01);
}

TEST_F(version_3, with_something_foreign_in_it_is_refused) {
  SQLite::Database(log_, SQLite::OPEN_READWRITE).exec("CREATE TABLE loot (text TEXT)");
  EXPECT_THROW(LogReader{log_}, Error);
}

class version_4 : public version_3 {
 protected:
  void SetUp() override {
    fs::copy_file(fs::path(HEFT_SOURCE_DIR) / "tests/golden/logs/version_4.db", log_);
    fs::permissions(log_, fs::perms::owner_write, fs::perm_options::add);
  }
};

TEST_F(version_4, gets_the_views_of_today) {
  const LogReader reader(log_);
  EXPECT_TRUE(fs::exists(log_ + ".v4"));
  EXPECT_THAT(reader.foreign_objects(), testing::IsEmpty());
  for (const std::int64_t session_id : {1, 2})
    EXPECT_FALSE(reader.first_broken_digest(session_id)) << session_id;
  SQLite::Database log(log_, SQLite::OPEN_READONLY);
  EXPECT_GT(log.execAndGet("SELECT count(peak_clone_offset_deg) >= 0 FROM v_trial").getInt(), 0);
}

TEST_F(version_4, with_something_foreign_in_it_is_refused_and_left_as_it_is) {
  SQLite::Database(log_, SQLite::OPEN_READWRITE)
      .exec("CREATE TRIGGER bad AFTER INSERT ON event BEGIN DELETE FROM answer; END");
  EXPECT_THROW(LogReader{log_}, Error);
  SQLite::Database log(log_, SQLite::OPEN_READONLY);
  EXPECT_EQ(log.execAndGet("PRAGMA user_version").getInt(), 4);
}

// Its lists had the words of every task there was.
TEST_F(version_4, of_the_program_before_gets_the_words_of_its_tasks_and_a_value_for_answers) {
  const std::string log = folder_.file("version_5.db");
  fs::copy_file(fs::path(HEFT_SOURCE_DIR) / "tests/golden/logs/version_5.db", log);
  fs::permissions(log, fs::perms::owner_write, fs::perm_options::add);
  const auto number = [&](const char* query) {
    return SQLite::Database(log, SQLite::OPEN_READONLY).execAndGet(query).getInt();
  };
  const int n_answers = number("SELECT count(*) FROM answer");
  const LogReader reader(log);
  EXPECT_THAT(reader.foreign_objects(), testing::IsEmpty());
  EXPECT_EQ(number("SELECT count(*) FROM answer WHERE value IS NULL"), n_answers);
  EXPECT_EQ(number("SELECT count(DISTINCT task) FROM trial"),
            number("SELECT count(*) FROM list_task WHERE edition = 1"));
}

INSTANTIATE_TEST_SUITE_P(versions, older_version, testing::Values(1, 2));

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

TEST(setups_of_golden_logs, have_the_same_bytes_when_they_are_written_again) {
  const TemporaryFolder folder;
  for (const char* name : {"version_2", "version_3", "version_4"}) {
    const std::string log = folder.file(name);
    fs::copy_file(fs::path(HEFT_SOURCE_DIR) / "tests/golden/logs" / (std::string(name) + ".db"),
                  log);
    fs::permissions(log, fs::perms::owner_write, fs::perm_options::add);
    const LogReader reader(log);
    SQLite::Database database(log, SQLite::OPEN_READONLY);
    SQLite::Statement events(database, "SELECT detail FROM event WHERE kind = 'setup'");
    while (events.executeStep()) {
      const std::string logged = events.getColumn(0);
      EXPECT_EQ(to_json(setup_from_json(logged)), logged) << name;
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
          EXPECT_EQ(text_cell(value).value_or(cell), cell) << name << ' ' << column.name;
        });
      }
  }
}

}  // namespace
}  // namespace heft::test
