// Which files are opened, which are refused, and with which messages.
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "base/files/TextFile.h"
#include "record/child.h"
#include "record/reader/LogReader.h"
#include "record/rows.h"
#include "record/schema/Schema.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"

namespace heft::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string failure_to_start(const std::string& file) {
  return failure([&] { SessionLog::start(file, header_of("P01")); });
}

class Opening : public testing::Test {
 protected:
  void write_log() {
    SessionLog log = SessionLog::start(file_, header_of("P01"));
    log.append(event(1, event_kind<Note>, "here"), {}, Durability::acknowledged);
  }

  TemporaryFolder folder_;
  std::string file_ = folder_.file("log.db");
};

TEST_F(Opening, EmptyFileBecomesLog) {
  std::ofstream(file_).close();
  EXPECT_TRUE(LogReader(file_).sessions().empty());
  EXPECT_TRUE(check_integrity(file_).empty());
  write_log();
  EXPECT_EQ(LogReader(file_).sessions().size(), 1u);
}

TEST_F(Opening, FileNameIsNoSqliteUri) {
  for (const char* name : {":memory:", "file:x?mode=memory", "50%?#.db"}) {
    const std::string file = folder_.file(name);
    SessionLog::start(file, header_of("P01"));
    EXPECT_TRUE(std::filesystem::exists(file)) << name;
    EXPECT_EQ(LogReader(file).sessions().size(), 1u) << name;
  }
  EXPECT_THAT(failure_to_start(""), HasSubstr("--db FILE"));
}

TEST_F(Opening, OtherFilesAreRefusedUnchanged) {
  const std::string text = "participant,answer\nP01,heavier\n" + std::string(5000, '.');
  std::ofstream(file_) << text;
  EXPECT_THAT(failure_to_start(file_), AllOf(HasSubstr(file_), HasSubstr("no heft log")));
  EXPECT_THAT(failure([&] { LogReader reader(file_); }), HasSubstr("no heft log"));
  EXPECT_THAT(failure([&] { check_integrity(file_); }), HasSubstr("no heft log"));
  EXPECT_EQ(read_text_file(file_), text);
}

TEST_F(Opening, OtherDatabaseIsRefused) {
  SQLite::Database(file_, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
      .exec("CREATE TABLE address (name TEXT)");
  EXPECT_THAT(failure_to_start(file_), HasSubstr("belongs to another program"));
  EXPECT_THAT(failure([&] { LogReader reader(file_); }), HasSubstr("belongs to another program"));
}

TEST_F(Opening, NewerLogIsRefused) {
  write_log();
  SQLite::Database(file_, SQLite::OPEN_READWRITE)
      .exec(fmt::format("PRAGMA user_version = {}", schema::current_version + 1));
  EXPECT_THAT(failure_to_start(file_), AllOf(HasSubstr("newer heft"), HasSubstr("Update heft")));
  EXPECT_THAT(failure([&] { SessionLog::reopen(file_, 1); }), HasSubstr("newer heft"));
  EXPECT_THAT(failure([&] { LogReader reader(file_); }), HasSubstr("newer heft"));
}

TEST_F(Opening, FolderAndMissingFileAreReported) {
  EXPECT_THAT(failure_to_start(folder_.path()), HasSubstr("is a folder"));
  EXPECT_THAT(failure_to_start(folder_.file("no/such/log.db")),
              HasSubstr("No such file or directory"));
  EXPECT_THAT(failure([&] { LogReader reader(file_); }), HasSubstr("there is no file"));
  EXPECT_FALSE(std::filesystem::exists(file_)) << "reading made a file";
}

TEST_F(Opening, MissingSessionIsReported) {
  write_log();
  EXPECT_THAT(failure([&] { SessionLog::reopen(file_, 7); }), HasSubstr("no session 7"));
  EXPECT_THAT(failure([&] { LogReader(file_).session(7); }), HasSubstr("no session 7"));
}

TEST_F(Opening, ReopenedSessionContinues) {
  write_log();
  {
    SessionLog log = SessionLog::reopen(file_, 1);
    log.append(event(2, event_kind<SessionResumed>), starting(sorting_trial(1, 2)),
               Durability::acknowledged);
  }
  {
    SessionLog log = SessionLog::reopen(file_, 1);
    log.append(event(3, event_kind<Note>), of_attempt(1), Durability::acknowledged);
  }
  const auto events = LogReader(file_).events(1);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[2].attempt_index, 1);
}

TEST_F(Opening, UnfinishedSessionsAreFound) {
  const auto add = [&](const char* participant, std::optional<SessionState> state) {
    SessionLog log = SessionLog::start(file_, header_of(participant));
    Changes changes;
    changes.state = state;
    log.append(event(1, event_kind<Note>), changes, Durability::acknowledged);
  };
  add("P01", SessionState::finished);
  add("P01", SessionState::paused);
  add("P02", std::nullopt);
  add("P03", SessionState::aborted);
  const LogReader reader(file_);
  const auto sessions = reader.sessions_of("P01", "paper");
  ASSERT_EQ(sessions.size(), 2u);
  EXPECT_FALSE(is_unfinished(sessions[0].state));
  EXPECT_TRUE(is_unfinished(sessions[1].state));
  EXPECT_TRUE(reader.sessions_of("P01", "jnd").empty());
  ASSERT_TRUE(reader.newest_unfinished_session());
  EXPECT_EQ(reader.newest_unfinished_session()->header.participant, "P02");
}

TEST_F(Opening, SecondWriterIsRefused) {
  {
    SessionLog log = SessionLog::start(file_, header_of("P01"));
    EXPECT_THAT(failure_to_start(file_),
                AllOf(HasSubstr(file_), HasSubstr("in use"), HasSubstr("--db FILE")));
    EXPECT_THAT(failure([&] { SessionLog::reopen(file_, 1); }), HasSubstr("in use"));
    EXPECT_THAT(failure([&] { SessionArchive archive(file_); }), HasSubstr("in use"));
    std::filesystem::create_symlink(file_, folder_.file("same.db"));
    EXPECT_THAT(failure_to_start(folder_.file("same.db")), HasSubstr("in use"));
    std::filesystem::create_hard_link(file_, folder_.file("twin.db"));
    EXPECT_THAT(failure_to_start(folder_.file("twin.db")), HasSubstr("in use"));
    std::filesystem::remove(folder_.file("twin.db"));
    SessionLog moved = std::move(log);
    EXPECT_THAT(failure_to_start(file_), HasSubstr("in use"));
  }
  EXPECT_EQ(failure_to_start(file_), "");
}

TEST_F(Opening, LockEndsWithItsProcess) {
  Child owner([&](int out) {
    SessionLog log = SessionLog::start(file_, header_of("P01"));
    say(out, "!");
    ::pause();
  });
  ASSERT_TRUE(owner.read_byte());
  EXPECT_THAT(failure_to_start(file_), HasSubstr("in use"));
  std::filesystem::create_hard_link(file_, folder_.file("twin.db"));
  EXPECT_THAT(failure_to_start(folder_.file("twin.db")), HasSubstr("in use"));
  std::filesystem::remove(folder_.file("twin.db"));
  std::filesystem::rename(file_, folder_.file("moved.db"));
  EXPECT_THAT(failure_to_start(folder_.file("moved.db")), HasSubstr("in use"));
  std::filesystem::rename(folder_.file("moved.db"), file_);
  owner.kill();
  EXPECT_EQ(failure_to_start(file_), "");
}

TEST_F(Opening, RefusedWriterKeepsLockOfFirst) {
  Child owner([&](int out) {
    SessionLog log = SessionLog::start(file_, header_of("P01"));
    for (int i = 0; i < 3; ++i) failure_to_start(file_);
    say(out, "!");
    ::pause();
  });
  ASSERT_TRUE(owner.read_byte());
  // If they had closed the file, another program would see no lock and checkpoint on closing.
  SQLite::Database(file_, SQLite::OPEN_READWRITE).execAndGet("SELECT count(*) FROM session");
  EXPECT_TRUE(std::filesystem::exists(file_ + "-wal"));
}

TEST_F(Opening, LogIsReadableByOwnerOnly) {
  const mode_t before = ::umask(0);
  SessionLog log = SessionLog::start(file_, header_of("P01"));
  ::umask(before);
  for (const char* end : {"", "-wal", "-shm"}) {
    struct stat file {};
    ASSERT_EQ(::stat((file_ + end).c_str(), &file), 0) << end;
    EXPECT_EQ(file.st_mode & 0777, 0600u) << end;
  }
  EXPECT_FALSE(std::filesystem::exists(file_ + "-lock"));
}

TEST_F(Opening, LogWithTwoNamesIsRefused) {
  write_log();
  std::filesystem::create_hard_link(file_, folder_.file("twin.db"));
  EXPECT_THAT(failure_to_start(file_), AllOf(HasSubstr(file_), HasSubstr("a hard link")));
  EXPECT_EQ(LogReader(file_).sessions().size(), 1u);
  std::filesystem::remove(folder_.file("twin.db"));
  EXPECT_EQ(failure_to_start(file_), "");
}

TEST_F(Opening, ReadOnlyFileIsRefusedBeforeStart) {
  write_log();
  ::chmod(folder_.path().c_str(), 0777);
  ::chmod(file_.c_str(), 0444);
  EXPECT_THAT(failure_as_ordinary_user([&] { SessionLog::start(file_, header_of("P02")); }),
              AllOf(HasSubstr(file_), HasSubstr("read-only"), HasSubstr("--db FILE")));
  EXPECT_EQ(LogReader(file_).sessions().size(), 1u);
}

TEST_F(Opening, ReadOnlyFolderIsRefusedBeforeStart) {
  ::chmod(folder_.path().c_str(), 0555);
  EXPECT_THAT(failure_as_ordinary_user([&] { SessionLog::start(file_, header_of("P02")); }),
              AllOf(HasSubstr(file_), HasSubstr("Permission denied"), HasSubstr("--db FILE")));
}

TEST_F(Opening, LogIsReadFromReadOnlyFolder) {
  write_log();
  ::chmod(file_.c_str(), 0444);
  ::chmod(folder_.path().c_str(), 0555);
  EXPECT_EQ(failure_as_ordinary_user([&] {
              const auto events = LogReader(file_).events(1);
              if (events.size() != 1 || row_of(events[0].event).detail != "here")
                throw std::runtime_error("not the events that were written");
            }),
            "");
}

TEST_F(Opening, LogWithUnreadableWalIsRefused) {
  Child owner([&](int out) {
    SessionLog log = SessionLog::start(file_, header_of("P01"));
    log.append(event(1, event_kind<Note>), {}, Durability::acknowledged);
    say(out, "!");
    ::pause();
  });
  ASSERT_TRUE(owner.read_byte());
  owner.kill();
  std::filesystem::remove(file_ + "-shm");
  ASSERT_GT(std::filesystem::file_size(file_ + "-wal"), 0u);
  ::chmod(folder_.path().c_str(), 0555);
  EXPECT_THAT(failure_as_ordinary_user([&] { LogReader reader(file_); }),
              AllOf(HasSubstr("-wal"), HasSubstr("Copy the files together")));
  ::chmod(folder_.path().c_str(), 0755);
  EXPECT_EQ(LogReader(file_).events(1).size(), 1u);
}

}  // namespace
}  // namespace heft::test
