// Another program locks the log: no data are lost, and they are written in order after the lock.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "record/reader/LogReader.h"
#include "record/rows.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"

namespace heft::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class LockedLog : public testing::Test {
 protected:
  LockedLog() { other_.exec("BEGIN IMMEDIATE"); }

  void note(const std::string& text, Durability durability = Durability::acknowledged) {
    log_.append(event(++t_s_, event_kind<Note>, text), {}, durability);
  }
  std::vector<std::string> notes() {
    std::vector<std::string> found;
    for (const LoggedEvent& logged : LogReader(file_).events(1))
      found.push_back(row_of(logged.event).detail);
    return found;
  }

  TemporaryFolder folder_;
  std::string file_ = folder_.file("log.db");
  SessionLog log_ = SessionLog::start(file_, header_of("P01"));
  SQLite::Database other_{file_, SQLite::OPEN_READWRITE};
  double t_s_ = 0;
};

TEST_F(LockedLog, KeepsEventUntilItCanBeWritten) {
  try {
    note("first");
    FAIL();
  } catch (const LogBusy& busy) {
    EXPECT_THAT(busy.what(), AllOf(HasSubstr("the event \"note\""), HasSubstr("the file is "
                                                                              "locked")));
  }
  EXPECT_THROW(note("second"), LogBusy);
  EXPECT_THROW(note("third", Durability::buffered), LogBusy) << "it has been due for a second";
  EXPECT_THROW(log_.add_frame(frame(0, 1)), LogBusy);
  EXPECT_THROW(log_.flush(), LogBusy);
  EXPECT_TRUE(notes().empty());
  other_.exec("ROLLBACK");
  log_.flush();
  EXPECT_THAT(notes(), testing::ElementsAre("first", "second", "third"));
  EXPECT_EQ(LogReader(file_).frames(1, 0).size(), 1u);
  EXPECT_FALSE(LogReader(file_).first_broken_digest(1));
  note("fourth");
  EXPECT_EQ(notes().size(), 4u);
}

TEST_F(LockedLog, WaitsOnFirstCallOnly) {
  const auto seconds_of_flush = [&] {
    const auto before = std::chrono::steady_clock::now();
    EXPECT_THROW(log_.flush(), LogBusy);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  };
  note("waiting", Durability::buffered);
  EXPECT_GT(seconds_of_flush(), 0.5);
  EXPECT_LT(seconds_of_flush(), 0.3);
  other_.exec("ROLLBACK");
  log_.flush();
  other_.exec("BEGIN IMMEDIATE");
  note("waiting again", Durability::buffered);
  EXPECT_GT(seconds_of_flush(), 0.5) << "a short lock is waited for as before";
}

TEST_F(LockedLog, KeepsAnswersAboutParticipant) {
  EXPECT_THROW(log_.add_info("age", "30"), LogBusy);
  EXPECT_THROW(log_.add_info("age", "31"), LogBusy);
  EXPECT_TRUE(LogReader(file_).session(1).header.participant_info.empty());
  other_.exec("ROLLBACK");
  log_.flush();
  EXPECT_EQ(LogReader(file_).session(1).header.participant_info.at("age"), "31");
  EXPECT_FALSE(LogReader(file_).first_broken_digest(1));
}

}  // namespace
}  // namespace heft::test
