// A log that is moved, replaced, deleted or linked during writing: reported before anything else is
// acknowledged, and no saved data are lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "record/reader/LogReader.h"
#include "record/rows.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"

namespace heft::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class DisplacedFile : public testing::Test {
 protected:
  DisplacedFile() { note(1); }

  void note(double t_s) {
    log_->append(event(t_s, event_kind<Note>, "kept"), {}, Durability::acknowledged);
  }
  std::string failure_of_note() {
    return failure([&] { note(2); });
  }
  std::string failure_of_flush() {
    return failure([&] { log_->flush(); });
  }
  void expect_whole(const std::string& file) {
    log_.reset();
    ASSERT_TRUE(fs::exists(file)) << file;
    EXPECT_TRUE(!fs::exists(file + "-wal") || fs::is_empty(file + "-wal"))
        << "rows lie beside the file";
    EXPECT_TRUE(check_integrity(file).empty());
    const auto events = LogReader(file).events(1);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(row_of(events[0].event).detail, "kept");
  }

  TemporaryFolder folder_;
  std::string file_ = folder_.file("my lab.db"), other_ = folder_.file("other.db");
  std::optional<SessionLog> log_{SessionLog::start(file_, header_of("P01"))};
};

TEST_F(DisplacedFile, MoveIsReportedAtNextEvent) {
  fs::rename(file_, other_);
  EXPECT_THAT(failure_of_note(),
              AllOf(HasSubstr("the event \"note\""), HasSubstr("was moved to " + other_),
                    HasSubstr("All saved data are in that file"), HasSubstr("Move it back"),
                    HasSubstr("heft resume --db '" + file_ + "' --session 1")));
  EXPECT_NE(failure_of_flush(), "");
  expect_whole(other_);
}

TEST_F(DisplacedFile, MoveIsReportedBeforeAcknowledgement) {
  fs::rename(file_, other_);
  EXPECT_THAT(failure_of_flush(), AllOf(HasSubstr("the session"), HasSubstr("was moved to")));
}

TEST_F(DisplacedFile, MovedFolderIsReported) {
  const std::string away = folder_.path() + "-away";
  fs::rename(folder_.path(), away);
  EXPECT_THAT(failure_of_note(), HasSubstr("was moved to " + away));
  expect_whole(away + "/my lab.db");
  fs::rename(away, folder_.path());
}

TEST_F(DisplacedFile, DeletedLogIsRescued) {
  fs::remove(file_);
  EXPECT_THAT(failure_of_note(), AllOf(HasSubstr("was deleted"), HasSubstr(file_ + ".rescued"),
                                       HasSubstr("Put that copy in its place")));
  expect_whole(file_ + ".rescued");
  EXPECT_EQ(fs::status(file_ + ".rescued").permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(DisplacedFile, LogDeletedWithWalIsRescued) {
  for (const char* end : {"", "-wal", "-shm"}) fs::remove(file_ + end);
  EXPECT_THAT(failure_of_flush(), HasSubstr(file_ + ".rescued"));
  expect_whole(file_ + ".rescued");
}

TEST_F(DisplacedFile, ReplacedLogIsRescued) {
  std::ofstream(other_) << "something else";
  fs::rename(other_, file_);
  EXPECT_THAT(failure_of_note(), AllOf(HasSubstr("was replaced"), HasSubstr(".rescued")));
  expect_whole(file_ + ".rescued");
  EXPECT_EQ(fs::file_size(file_), 14u);
}

TEST_F(DisplacedFile, SecondNameIsReported) {
  fs::create_hard_link(file_, other_);
  EXPECT_THAT(failure_of_note(), AllOf(HasSubstr("a hard link"), HasSubstr("Remove the other")));
  expect_whole(file_);
}

TEST_F(DisplacedFile, DeletedWalIsReported) {
  fs::remove(file_ + "-wal");
  EXPECT_THAT(failure_of_note(), HasSubstr("-wal"));
  expect_whole(file_);
}

TEST_F(DisplacedFile, RedirectedLinkIsReported) {
  const std::string link = folder_.file("link.db");
  log_.reset();
  fs::create_symlink(file_, link);
  log_.emplace(SessionLog::reopen(link, 1));
  std::ofstream(other_) << "";
  fs::remove(link);
  fs::create_symlink(other_, link);
  EXPECT_THAT(failure_of_note(), AllOf(HasSubstr("moved to " + file_)));
}

TEST_F(DisplacedFile, LinkInItsPlaceIsReported) {
  const LogReader analyst(file_);  // a reader keeps the -wal file
  fs::rename(file_, other_);
  fs::create_symlink(other_, file_);
  EXPECT_THAT(failure_of_flush(), HasSubstr("moved to " + other_));
}

TEST_F(DisplacedFile, RestoredFileCanBeResumed) {
  fs::rename(file_, other_);
  ASSERT_NE(failure_of_note(), "");
  fs::rename(other_, file_);
  EXPECT_NE(failure_of_note(), "") << "nothing may follow a lost event";
  log_.reset();
  log_.emplace(SessionLog::reopen(file_, 1));
  note(3);
  EXPECT_EQ(LogReader(file_).events(1).size(), 2u);
}

TEST_F(DisplacedFile, SimulationReportsLostFile) {
  log_.reset();
  SessionArchive archive(file_);
  fs::rename(file_, other_);
  RecordedSession session(header_of("P02"));
  EXPECT_THAT(failure([&] { archive.store(session); }), HasSubstr("was moved to " + other_));
}

TEST_F(DisplacedFile, UnreportedFailureIsPrintedAtEnd) {
  fs::rename(file_, other_);
  testing::internal::CaptureStderr();
  log_.reset();
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("was moved to"));
}

}  // namespace
}  // namespace heft::test
