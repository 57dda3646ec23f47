// Changes of a session's log: replay finds each of them quickly.
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "SourceFolder.h"
#include "base/Random.h"
#include "record/reader/LogReader.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"
#include "replay/Replay.h"
#include "session/Recorded.h"
#include "session/Session.h"

namespace heft {
namespace {

using ::testing::HasSubstr;

RecordedSession simulated_session() {
  SessionOptions model;
  model.responder = Plug{"simulated"};
  const Protocol protocol = load_protocol(source_folder() + "/protocols/quick.toml");
  RecordedSession session = compute_session({resolve(model, protocol, 5), "1"}, {});
  session.add_info("age", "30");
  return session;
}

// The session with changed or omitted entries, logged again so that its digests are valid.
using Forge = std::function<bool(RecordedEntry&)>;
RecordedSession forged(const RecordedSession& session, const Forge& keeps) {
  RecordedSession copy(session.header());
  for (RecordedEntry entry : session.entries()) {
    if (!keeps(entry)) continue;
    if (const auto* recorded = std::get_if<RecordedEvent>(&entry))
      copy.append(recorded->event, recorded->changes, Durability::buffered);
    else
      copy.add_frame(std::get<FrameRow>(entry));
  }
  return copy;
}

class TamperedReplay : public ::testing::Test {
 protected:
  static const RecordedSession& session() {
    static const RecordedSession made = simulated_session();
    return made;
  }
  void store(const RecordedSession& made) {
    std::filesystem::remove(file);
    SessionArchive(file).store(made);
  }
  Verification verified() const {
    return verify_session(LogReader(file), 1, [](double) {});
  }
  std::string divergence() const {
    const Verification found = verified();
    return found.first ? found.first->what : "";
  }
  // Executes SQL with all constraints of the schema disabled.
  int change(const std::string& sql) const {
    SQLite::Database database(file, SQLite::OPEN_READWRITE);
    database.exec("PRAGMA ignore_check_constraints = ON; PRAGMA foreign_keys = OFF");
    return database.exec(sql);
  }

  const test::TemporaryFolder folder;
  const std::string file = folder.file("log.db"), whole = folder.file("whole.db");
};

TEST_F(TamperedReplay, FramesThatTheSimulatorDoesNotGiveAreNamedByTheirColumn) {
  const auto forge = [&](const std::string& column, const std::function<bool(FrameRow&)>& keeps) {
    bool done = false;
    store(forged(session(), [&](RecordedEntry& entry) {
      auto* frame = std::get_if<FrameRow>(&entry);
      if (done || !frame || !frame->contact_slot) return true;
      done = true;
      return keeps(*frame);
    }));
    ASSERT_TRUE(done);
    EXPECT_THAT(divergence(), HasSubstr(column));
  };
  forge("state_hash", [](FrameRow& frame) {
    frame.effector.position_m.y() += 1e-9;
    return true;
  });
  forge("clone", [](FrameRow& frame) {
    frame.clone->position_m.x() += 1e-9;
    return true;
  });
  forge("cube1", [](FrameRow& frame) {
    frame.cubes[0].position_m.z() += 1e-9;
    return true;
  });
  forge("contact_slot", [](FrameRow& frame) {
    frame.contact_slot = 3 - *frame.contact_slot;
    return true;
  });
  forge("trial_t_s", [](FrameRow&) { return false; });
}

TEST_F(TamperedReplay, ALogWithoutItsEndIsVerifiedUpToThereAndUnfinished) {
  const auto n = session().entries().size();
  for (std::size_t kept : {n - 1, n / 2, n / 3}) {
    std::size_t count = 0;
    int n_events = 0;
    store(forged(session(), [&](RecordedEntry& entry) {
      if (count++ >= kept) return false;
      n_events += std::holds_alternative<RecordedEvent>(entry);
      return true;
    }));
    const Verification found = verified();
    EXPECT_FALSE(found.first) << found.first->what;
    EXPECT_FALSE(found.ended);
    EXPECT_EQ(found.n_events, n_events);
  }
  store(session());
  EXPECT_TRUE(verified().ended);
}

TEST_F(TamperedReplay, AnEndThatIsCutOffIsMissed) {
  store(session());
  ASSERT_EQ(change("DELETE FROM event WHERE kind = 'ended'"), 1);
  change("UPDATE session SET state = 'running'");
  EXPECT_NE(divergence(), "");
  store(session());
  change("DELETE FROM frame WHERE frame_id = (SELECT max(frame_id) FROM frame)");
  EXPECT_NE(divergence(), "");
}

// A replay must not simulate a thousand million seconds first.
TEST_F(TamperedReplay, TimesThatAreFarOffAreFoundBeforeTheyAreSimulated) {
  store(session());
  ASSERT_GT(change("UPDATE frame SET trial_t_s = trial_t_s + 1e9"), 100);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT(divergence(), HasSubstr("frame"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST_F(TamperedReplay, WhatNoLogHoldsIsNamed) {
  for (const char* foreign :
       {"CREATE TABLE loot (text TEXT)", "CREATE VIEW loot AS SELECT 1 AS one",
        "CREATE INDEX loot ON trial (block)",
        "CREATE TRIGGER loot AFTER INSERT ON event BEGIN DELETE FROM answer; END"}) {
    store(session());
    change(foreign);
    EXPECT_THAT(fault_of_structure(LogReader(file)).value_or(""), HasSubstr("loot")) << foreign;
  }
}

TEST_F(TamperedReplay, RunOptionsChangeNothingButTheDigest) {
  store(session());
  const SessionConfig before = load_session(LogReader(file), file, 1).setup;
  ASSERT_EQ(change("UPDATE session SET run_options = '{}'"), 1);
  EXPECT_EQ(load_session(LogReader(file), file, 1).setup, before);
  EXPECT_THAT(divergence(), HasSubstr("header"));
}

TEST_F(TamperedReplay, OfManySessionsTheFirstIsNamed) {
  constexpr int n_sessions = 24;  // several threads verify so many
  SessionArchive archive(file);
  for (int i = 0; i < n_sessions; ++i) archive.store(session());
  double done = 0;
  const auto fault = [&] {
    return fault_of_log(LogReader(file), file, {}, [&](double part) { done = part; });
  };
  EXPECT_EQ(fault(), std::nullopt);
  EXPECT_EQ(done, 1);
  ASSERT_EQ(change("UPDATE event SET t_s = t_s + 1e-9 WHERE session_id IN (7, 11, 23) AND "
                   "event_id IN (SELECT max(event_id) FROM event GROUP BY session_id)"),
            3);
  EXPECT_THAT(fault().value_or(""), HasSubstr("session 7, at"));
}

class EveryColumn : public TamperedReplay {
 protected:
  std::vector<std::string> list(const std::string& sql) const {
    SQLite::Database database(whole, SQLite::OPEN_READONLY);
    SQLite::Statement query(database, sql);
    std::vector<std::string> found;
    while (query.executeStep()) found.push_back(query.getColumn(0).getString());
    return found;
  }

  // Makes the smallest possible change of the value. @return whether the table accepted it
  bool step(const std::string& table, const std::string& column, std::int64_t rowid) const try {
    std::filesystem::copy_file(whole, file, std::filesystem::copy_options::overwrite_existing);
    SQLite::Database database(file, SQLite::OPEN_READWRITE);
    database.exec("PRAGMA ignore_check_constraints = ON; PRAGMA foreign_keys = OFF");
    SQLite::Statement read(database,
                           fmt::format("SELECT {} FROM {} WHERE rowid = ?", column, table));
    read.bind(1, rowid);
    read.executeStep();
    const SQLite::Column value = read.getColumn(0);
    SQLite::Statement write(database,
                            fmt::format("UPDATE {} SET {} = ? WHERE rowid = ?", table, column));
    write.bind(2, rowid);
    if (value.isInteger())
      write.bind(1, value.getInt64() + 1);
    else if (value.isFloat())
      write.bind(1, std::nextafter(value.getDouble(), std::numeric_limits<double>::infinity()));
    else if (value.isText())
      write.bind(1, fmt::format("{}x", value.getString()));
    else
      write.bind(1, "1");  // as a number where the column is one
    read.reset();
    return write.exec() == 1;
  } catch (const SQLite::Exception&) {  // another row has that value, or it is of another type
    return false;
  }

  // As `heft replay` does.
  bool is_found() const {
    if (!faults_of_file(LogReader(file), file).empty()) return true;
    return verified().first.has_value();
  }
};

TEST_F(EveryColumn, ChangedByOneStepIsFound) {
  store(session());
  std::filesystem::copy_file(file, whole);
  const std::uint64_t seed = 20261122;
  RandomStream random(seed, "rows");
  int n_columns = 0;
  // The closed lists hold no data, and the row id only determines the order.
  for (const std::string& table : list("SELECT name FROM sqlite_master WHERE type = 'table' AND "
                                       "name NOT LIKE 'list_%' AND name NOT LIKE 'sqlite_%'"))
    for (const std::string& column :
         list(fmt::format("SELECT name FROM pragma_table_info('{}')", table))) {
      if (column == fmt::format("{}_id", table)) continue;
      std::vector<std::string> rows = list(fmt::format("SELECT rowid FROM {}", table));
      random.shuffle(std::span(rows));
      bool taken = false;
      for (std::size_t i = 0; i < rows.size() && !taken; ++i) {
        taken = step(table, column, std::stoll(rows[i]));
        if (taken) {
          EXPECT_TRUE(is_found()) << table << "." << column << ", row " << rows[i] << ", seed "
                                  << seed;
        }
      }
      EXPECT_TRUE(taken) << table << "." << column << ", seed " << seed;
      ++n_columns;
    }
  EXPECT_GT(n_columns, 200);
}

}  // namespace
}  // namespace heft
