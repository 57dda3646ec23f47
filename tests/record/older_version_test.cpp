// Logs of earlier versions (tests/golden/logs) are upgraded when they are opened. The older file is
// kept, and sessions keep their digests. Logs before the oldest supported version are refused.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/files/TextFile.h"
#include "experiment/Rows.h"
#include "record/reader/LogReader.h"
#include "record/schema/EventRow.h"
#include "record/schema/Schema.h"
#include "record/tampered_log.h"

namespace heft::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

class OlderVersion : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { copy(); }

  void copy() { copy_older_log(log_, GetParam()); }
  void sql(const std::string& text) { SQLite::Database(log_, SQLite::OPEN_READWRITE).exec(text); }
  static int number(const std::string& file, const char* query) {
    return SQLite::Database(file, SQLite::OPEN_READONLY).execAndGet(query).getInt();
  }
  static int version(const std::string& file) { return number(file, "PRAGMA user_version"); }
  /// First cells of a query's rows.
  static std::vector<std::string> cells(const std::string& file, const char* query) {
    SQLite::Database database(file, SQLite::OPEN_READONLY);
    SQLite::Statement rows(database, query);
    std::vector<std::string> cells;
    while (rows.executeStep()) cells.push_back(rows.getColumn(0));
    return cells;
  }

  TemporaryFolder folder_;
  std::string log_ = folder_.file("log.db");
  std::string older_file_ = fmt::format("{}.v{}", log_, GetParam());
};
INSTANTIATE_TEST_SUITE_P(Versions, OlderVersion, testing::Values(5, 6, 7, 8),
                         [](const auto& version) { return fmt::format("v{}", version.param); });

TEST_P(OlderVersion, IsUpgradedAndOlderFileIsKept) {
  const int n_events = number(log_, "SELECT count(*) FROM event");
  const LogReader reader(log_);
  EXPECT_EQ(version(log_), schema::current_version);
  EXPECT_EQ(number(log_, "SELECT count(*) FROM event"), n_events);
  EXPECT_THAT(reader.foreign_objects(), testing::IsEmpty());
  EXPECT_THAT(check_integrity(log_), testing::IsEmpty());
  EXPECT_EQ(version(older_file_), GetParam());
  EXPECT_EQ(number(older_file_, "SELECT count(*) FROM event"), n_events);
  EXPECT_EQ(fs::status(older_file_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_P(OlderVersion, KeepsAllAnswers) {
  constexpr auto answers =
      "SELECT answer_id || ' ' || trial_id || ' ' || t_s || ' ' || action || ' ' || ifnull(slot, "
      "'-') || ' ' || ifnull(label, '-') FROM answer ORDER BY rowid";
  const auto before = cells(log_, answers);
  ASSERT_GT(before.size(), 10u);
  const LogReader upgraded(log_);
  EXPECT_EQ(cells(log_, answers), before);
  EXPECT_EQ(number(log_, "SELECT count(*) FROM answer WHERE value IS NULL"),
            static_cast<int>(before.size()));
}

TEST_P(OlderVersion, KeepsValuesOfRenamedColumns) {
  if (GetParam() >= 7) GTEST_SKIP() << "version 7 has today's names";
  constexpr auto pushes_before = "SELECT ifnull(deepest_push_m, '-') FROM cube ORDER BY rowid",
                 pushes = "SELECT ifnull(max_push_displacement_m, '-') FROM cube ORDER BY rowid",
                 setups_before = "SELECT handed || simulator_why FROM setup ORDER BY rowid",
                 setups = "SELECT controls || simulator_reason FROM setup ORDER BY rowid",
                 estimates_before =
                     "SELECT replace(ifnull(censored, '-'), 'unsettled', "
                     "'indeterminate') FROM estimate ORDER BY rowid",
                 estimates = "SELECT ifnull(censored, '-') FROM estimate ORDER BY rowid";
  const auto pushed = cells(log_, pushes_before), set_up = cells(log_, setups_before),
             estimated = cells(log_, estimates_before);
  const LogReader reader(log_);
  EXPECT_EQ(cells(log_, pushes), pushed);
  EXPECT_EQ(cells(log_, setups), set_up);
  EXPECT_EQ(cells(log_, estimates), estimated);
}

TEST_P(OlderVersion, GetsWordsOfItsTasks) {
  const LogReader upgraded(log_);
  EXPECT_GT(number(log_, "SELECT count(*) FROM list_task WHERE edition >= 1"), 0);
  EXPECT_EQ(number(log_, "SELECT count(DISTINCT task) FROM trial"),
            number(log_, "SELECT count(*) FROM list_task WHERE edition >= 1"));
}

TEST_P(OlderVersion, KeepsDigestsThatFindChanges) {
  for (const std::int64_t session_id : LogReader(log_).session_ids())
    EXPECT_FALSE(LogReader(log_).first_broken_digest(session_id)) << session_id;
  sql("UPDATE event SET t_s = t_s + 1e-9 WHERE event_id = 7");
  EXPECT_TRUE(LogReader(log_).first_broken_digest(1));
}

TEST_P(OlderVersion, IsContinuedInCurrentVersion) {
  {
    SessionLog log = SessionLog::reopen(log_, 1);
    log.append({9999, CubeTouch{1, 0.5, 0.02, 0.01}}, of_attempt(1), Durability::acknowledged);
  }
  const LogReader reader(log_);
  EXPECT_FALSE(reader.first_broken_digest(1));
  EXPECT_EQ(reader.events(1).back().event.as<CubeTouch>()->peak_lag_m, 0.01);
}

TEST_P(OlderVersion, WithForeignObjectIsRefusedUnchanged) {
  for (const char* change : {"CREATE TRIGGER bad AFTER INSERT ON event BEGIN SELECT 1; END",
                             "CREATE TRIGGER bad AFTER INSERT ON estimate BEGIN SELECT 1; END",
                             "CREATE TABLE bad (text TEXT)", "CREATE INDEX bad ON cube (mass_g)"}) {
    copy();
    sql(change);
    try {
      LogReader reader(log_);
      ADD_FAILURE() << "it was opened after " << change;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("bad"));
      EXPECT_EQ(error.exit_code(), ExitCode::diverged);
    }
    EXPECT_EQ(version(log_), GetParam());
  }
}

// Version 6 has the current answers and words, which are not written again.
class OlderAnswers : public OlderVersion {};
INSTANTIATE_TEST_SUITE_P(Version5, OlderAnswers, testing::Values(5));

TEST_P(OlderAnswers, WithInvalidCellAreRefusedUnchanged) {
  for (const char* change : {"UPDATE answer SET slot = 9 WHERE answer_id = 2",
                             "UPDATE trial SET task = 'dance' WHERE trial_id = 2"}) {
    copy();
    sql(std::string("PRAGMA ignore_check_constraints = ON; ") + change);
    try {
      LogReader reader(log_);
      ADD_FAILURE() << "it was opened after " << change;
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), ExitCode::diverged) << error.what();
    }
    EXPECT_EQ(version(log_), GetParam());
  }
}

TEST_P(OlderVersion, KeepsOneOlderFileAfterRepeatedUpgrades) {
  std::ofstream(older_file_ + ".part") << "cut short";
  sql("CREATE TRIGGER bad AFTER INSERT ON event BEGIN DELETE FROM answer; END");
  for (int i = 0; i < 2; ++i) EXPECT_THROW(LogReader{log_}, Error);
  EXPECT_EQ(version(older_file_), GetParam());
  EXPECT_FALSE(fs::exists(older_file_ + ".part"));
  EXPECT_FALSE(fs::exists(older_file_ + "-2"));
}

TEST_P(OlderVersion, IsUpgradedInMemoryWhileInUse) {
  const int other = ::open(log_.c_str(), O_RDONLY);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  EXPECT_EQ(static_cast<int>(LogReader(log_).sessions().size()),
            number(log_, "SELECT count(*) FROM session"));
  EXPECT_EQ(version(log_), GetParam());
  EXPECT_FALSE(fs::exists(older_file_));
  ::close(other);
}

TEST_P(OlderVersion, BeforeOldestIsRefusedUnchanged) {
  for (const int outdated : {1, 4}) {
    sql(fmt::format("PRAGMA user_version = {}", outdated));
    const std::string bytes = read_text_file(log_);
    const auto is_explained =
        AllOf(HasSubstr(log_), HasSubstr(fmt::format("a log of version {}", outdated)),
              HasSubstr("reads versions 5 to 9"), HasSubstr("the version of heft that wrote it"));
    EXPECT_THAT(failure([&] { LogReader{log_}; }), is_explained);
    EXPECT_THAT(failure([&] { SessionLog::reopen(log_, 1); }), is_explained);
    EXPECT_THAT(failure([&] { SessionLog::start(log_, header_of("P01")); }), is_explained);
    EXPECT_THAT(failure([&] { check_integrity(log_); }), is_explained);
    EXPECT_TRUE(read_text_file(log_) == bytes);
    EXPECT_FALSE(fs::exists(fmt::format("{}.v{}", log_, outdated)));
  }
}

// As left by an earlier program that upgraded a file and kept its sessions' versions.
TEST_P(OlderVersion, SessionOfUnsupportedVersionIsRefused) {
  sql("UPDATE session SET log_version = 4 WHERE session_id = 2");
  const LogReader reader(log_);
  const auto is_explained = AllOf(HasSubstr(log_), HasSubstr("session 2"), HasSubstr("version 4"),
                                  HasSubstr("reads versions 5 to 9"));
  EXPECT_THAT(failure([&] { reader.session(2); }), is_explained);
  EXPECT_THAT(failure([&] { reader.events(2); }), is_explained);
  EXPECT_THAT(failure([&] { reader.sessions(); }), is_explained);
  EXPECT_EQ(reader.session(1).session_id, 1);
}

// Text cells only: numbers have more than one text.
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

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  if (const auto at = text.find(from); at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

TEST_P(OlderVersion, SetupsAreWrittenWithSameBytes) {
  const LogReader reader(log_);
  for (const std::string& logged : cells(log_, "SELECT detail FROM event WHERE kind = 'setup'"))
    EXPECT_EQ(to_json(setup_from_json(logged)),
              replaced(replaced(logged, "\"simulator_why\"", "\"simulator_reason\""), "\"handed\"",
                       "\"controls\""));
  SQLite::Database database(log_, SQLite::OPEN_READONLY);
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
