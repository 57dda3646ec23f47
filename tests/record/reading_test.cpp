// Reading next to a writer, visibility of rows, and invalid values.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "base/Error.h"
#include "record/child.h"
#include "record/reader/LogReader.h"
#include "record/rows.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"

namespace heft::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Reading : public testing::Test {
 protected:
  std::size_t n_events() const { return LogReader(file_).events(1).size(); }
  std::size_t n_frames() const { return LogReader(file_).frames(1, 1).size(); }

  TemporaryFolder folder_;
  std::string file_ = folder_.file("log.db");
};

TEST_F(Reading, AcknowledgedEventsAreVisibleWithAllBufferedBefore) {
  SessionLog log = SessionLog::start(file_, header_of("P01"));
  log.append(event(1, event_kind<TrialStarted>), starting(sorting_trial(1, 1)),
             Durability::acknowledged);
  EXPECT_EQ(n_events(), 1u);
  log.add_frame(frame(1, 2));
  log.append(event(2, event_kind<CubesShown>), of_attempt(1), Durability::buffered);
  EXPECT_EQ(n_events(), 1u);
  EXPECT_EQ(n_frames(), 0u);
  log.append(event(3, event_kind<Note>), of_attempt(1), Durability::acknowledged);
  EXPECT_EQ(n_events(), 3u);
  EXPECT_EQ(n_frames(), 1u);
  EXPECT_EQ(LogReader(file_).events(1)[1].event.kind(), event_kind<CubesShown>);
}

TEST_F(Reading, BufferedRowsAreVisibleAfterFlushAndAtEnd) {
  {
    SessionLog log = SessionLog::start(file_, header_of("P01"));
    log.append(event(1, event_kind<Note>), {}, Durability::buffered);
    log.flush();
    EXPECT_EQ(n_events(), 1u);
    log.append(event(2, event_kind<Note>), {}, Durability::buffered);
    EXPECT_EQ(n_events(), 1u);
  }
  EXPECT_EQ(n_events(), 2u);
}

TEST_F(Reading, BufferedRowsAreWrittenWithinSecond) {
  SessionLog log = SessionLog::start(file_, header_of("P01"));
  log.append(event(1, event_kind<Note>), {}, Durability::buffered);
  std::this_thread::sleep_for(std::chrono::milliseconds(1010));
  log.append(event(2, event_kind<Note>), {}, Durability::buffered);
  EXPECT_EQ(n_events(), 2u);
}

TEST_F(Reading, ReaderSeesSnapshot) {
  SessionLog log = SessionLog::start(file_, header_of("P01"));
  log.append(event(1, event_kind<Note>), {}, Durability::acknowledged);
  const LogReader before(file_);
  log.append(event(2, event_kind<Note>), {}, Durability::acknowledged);
  EXPECT_EQ(before.events(1).size(), 1u);
  EXPECT_EQ(n_events(), 2u);
}

TEST_F(Reading, OtherProcessNeverSeesPartialEvent) {
  Child writer([&](int out) {
    SessionLog log = SessionLog::start(file_, header_of("P01"));
    for (int n = 1; n <= 300; ++n) {
      log.append(event(n, event_kind<TrialStarted>), starting(sorting_trial(n, n)),
                 Durability::acknowledged);
      if (n == 1) say(out, "!");
    }
  });
  ASSERT_TRUE(writer.read_byte());
  std::size_t n = 0;
  for (int looks = 0; n < 300 && looks < 10'000; ++looks) {
    const LogReader reader(file_);
    const std::size_t now = reader.events(1).size();
    EXPECT_GE(now, n);
    EXPECT_EQ(reader.trials(1).size(), now);
    EXPECT_EQ(reader.cubes(1).size(), 3 * now);
    n = now;
  }
  EXPECT_EQ(n, 300u);
}

class Damage : public Reading {
 protected:
  void SetUp() override {
    SessionLog log = SessionLog::start(file_, header_of("P01"));
    Changes changes = starting(sorting_trial(1, 1));
    changes.answers = {{1, 2, "label", 2, "heaviest"}};
    changes.reversals = {{1, "15g", 1, 100, 50, 50}};
    log.append(event(1, event_kind<TrialStarted>), changes, Durability::acknowledged);
    log.add_frame(frame(1, 2));
  }

  /// The message of reading everything after a change with all constraints disabled.
  std::string failure_after(const std::string& change) {
    {
      SQLite::Database database(file_, SQLite::OPEN_READWRITE);
      database.exec("PRAGMA ignore_check_constraints = ON; PRAGMA foreign_keys = OFF");
      database.exec(change);
    }
    try {
      whole_session(LogReader(file_), 1);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(Damage, UnchangedLogIsRead) {
  EXPECT_EQ(failure_after("SELECT 1"), "");
}

TEST_F(Damage, UnknownNameIsRefusedWithPlace) {
  EXPECT_THAT(failure_after("UPDATE event SET kind = 'foo'"),
              AllOf(HasSubstr(file_), HasSubstr("table event, row 1, column kind"),
                    HasSubstr("found \"foo\""), HasSubstr("\"trial_started\"")));
}

TEST_F(Damage, InvalidValuesAreRefusedWithPlace) {
  EXPECT_THAT(failure_after("UPDATE answer SET label = 'heavy'"),
              HasSubstr("table answer, row 1, column label"));
  EXPECT_THAT(failure_after("UPDATE answer SET label = NULL; UPDATE trial SET is_catch = 7"),
              HasSubstr("table trial, row 1, column is_catch"));
}

TEST_F(Damage, TooLargeNumberIsRefused) {
  EXPECT_THAT(failure_after("UPDATE trial SET attempt = 5000000000"),
              AllOf(HasSubstr("column attempt"), HasSubstr("5000000000")));
}

TEST_F(Damage, PartialPoseIsRefused) {
  EXPECT_THAT(failure_after("UPDATE frame SET clone_qx = NULL"),
              AllOf(HasSubstr("table frame, row 1, column clone_qx"), HasSubstr("nothing")));
}

TEST_F(Damage, PoseWithoutFirstColumnIsRefused) {
  EXPECT_THAT(failure_after("UPDATE frame SET clone_x_m = NULL"),
              HasSubstr("table frame, row 1, column clone_y_m"));
}

TEST_F(Damage, RowOfMissingTrialIsRefused) {
  EXPECT_THAT(failure_after("UPDATE event SET trial_id = 99"),
              AllOf(HasSubstr("table event, row 1, column trial_id"), HasSubstr("trial 99")));
}

}  // namespace
}  // namespace heft::test
