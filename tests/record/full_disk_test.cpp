// A failed write is reported with a clear message and leaves the file unchanged.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "base/Error.h"
#include "record/reader/LogReader.h"
#include "record/rows.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"

namespace heft::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Limits the size of files of this process, until the end of the scope.
class SizeLimit {
 public:
  explicit SizeLimit(std::uintmax_t bytes) : handler_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  SizeLimit(const SizeLimit&) = delete;
  ~SizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  sighandler_t handler_;
};

/// A small disk.
class SmallDisk {
 public:
  explicit SmallDisk(const char* options)
      : mounted_(::mount("tmpfs", folder_.path().c_str(), "tmpfs", 0, options) == 0) {}
  SmallDisk(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (mounted_) ::umount2(folder_.path().c_str(), MNT_DETACH);
  }
  bool mounted() const { return mounted_; }
  std::string file(const std::string& name) const { return folder_.file(name); }

 private:
  TemporaryFolder folder_;
  bool mounted_;
};

Event seventh_answer() {
  return action(8, "label", 2, "heaviest");
}

void start_trial_seven(SessionLog& log) {
  TrialRow trial = sorting_trial(1, 1);
  trial.plan.trial_number = 7;
  log.append(event(1, event_kind<TrialStarted>), starting(trial), Durability::acknowledged);
}

Changes with_answer(const Event& answer) {
  Changes changes = of_attempt(1);
  changes.answers = {answer_of(1, answer)};
  return changes;
}

/// Writes answers until one cannot be saved. @return the message; `n_saved` counts the others
std::string answer_until_it_fails(SessionLog& log, std::size_t& n_saved) {
  for (n_saved = 0; n_saved < 100'000; ++n_saved) try {
      for (int i = 0; i < 5; ++i) log.add_frame(frame(1, 8));
      log.append(seventh_answer(), with_answer(seventh_answer()), Durability::acknowledged);
    } catch (const Error& error) {
      return error.what();
    }
  return "";
}

void expect_saved(const std::string& file, std::size_t n_answers) {
  EXPECT_TRUE(check_integrity(file).empty());
  const LogReader reader(file);
  EXPECT_EQ(reader.answers(1).size(), n_answers);
  EXPECT_EQ(reader.events(1).size(), n_answers + 1);
  EXPECT_FALSE(reader.first_broken_digest(1));
}

TEST(FullDisk, IsReportedAndAcknowledgedAnswersAreKept) {
  const SmallDisk disk("size=1m");
  if (!disk.mounted()) GTEST_SKIP() << "a small disk can be mounted by root only";
  const std::string file = disk.file("log.db");
  std::size_t n_saved = 0;
  {
    SessionLog log = SessionLog::start(file, header_of("P01"));
    start_trial_seven(log);
    const std::string message = answer_until_it_fails(log, n_saved);
    EXPECT_THAT(message,
                AllOf(HasSubstr("could not save the answer \"label cube 2 heaviest\" of "
                                "trial 7"),
                      HasSubstr(file), HasSubstr("the disk is full"), HasSubstr("Free some space"),
                      HasSubstr("heft resume --db " + file)));
    // Later calls throw the same error; no answer may follow a lost one.
    EXPECT_EQ(failure([&] { log.append(event(9, event_kind<Note>), {}, Durability::buffered); }),
              message);
    EXPECT_EQ(failure([&] { log.add_frame(frame(1, 9)); }), message);
    EXPECT_EQ(failure([&] { log.flush(); }), message);
    expect_saved(file, n_saved);
  }
  EXPECT_GT(n_saved, 0u);
  expect_saved(file, n_saved);
}

TEST(FullDisk, SessionContinuesWithFreeSpace) {
  const SmallDisk disk("size=1m");
  if (!disk.mounted()) GTEST_SKIP() << "a small disk can be mounted by root only";
  const std::string file = disk.file("log.db"), ballast = disk.file("ballast");
  std::ofstream(ballast) << std::string(400'000, '.');
  std::size_t n_saved = 0;
  {
    SessionLog log = SessionLog::start(file, header_of("P01"));
    start_trial_seven(log);
    ASSERT_NE(answer_until_it_fails(log, n_saved), "");
  }
  std::filesystem::remove(ballast);
  SessionLog log = SessionLog::reopen(file, 1);
  log.append(seventh_answer(), with_answer(seventh_answer()), Durability::acknowledged);
  expect_saved(file, n_saved + 1);
}

TEST(FullDisk, SessionDoesNotStart) {
  const SmallDisk disk("size=64k");
  if (!disk.mounted()) GTEST_SKIP() << "a small disk can be mounted by root only";
  const std::string file = disk.file("log.db");
  EXPECT_THAT(failure([&] { SessionLog::start(file, header_of("P01")); }),
              AllOf(HasSubstr(file), HasSubstr("full")));
}

int version_of(const std::string& file) {
  return SQLite::Database(file, SQLite::OPEN_READONLY).execAndGet("PRAGMA user_version").getInt();
}

// Until then it is read in memory: there is no space for the copy, or for the upgrade.
TEST(FullDisk, OlderLogIsUpgradedWithFreeSpace) {
  for (const bool fits_copy : {false, true}) {
    const SmallDisk disk(fits_copy ? "size=560k" : "size=400k");
    if (!disk.mounted()) GTEST_SKIP() << "a small disk can be mounted by root only";
    const std::string file = disk.file("log.db");
    copy_older_log(file);
    EXPECT_EQ(LogReader(file).sessions().size(), 3u);
    EXPECT_EQ(version_of(file), 5);
    EXPECT_EQ(std::filesystem::exists(file + ".v5"), fits_copy);
    EXPECT_THAT(failure([&] { SessionLog::reopen(file, 1); }),
                AllOf(HasSubstr(file), HasSubstr("the disk is full")));
    const std::string folder = std::filesystem::path(file).parent_path();
    ASSERT_EQ(::mount("tmpfs", folder.c_str(), "tmpfs", MS_REMOUNT, "size=2m"), 0);
    EXPECT_EQ(LogReader(file).sessions().size(), 3u);
    EXPECT_EQ(version_of(file), current_log_version);
    EXPECT_EQ(version_of(file + ".v5"), 5);
    EXPECT_FALSE(std::filesystem::exists(file + ".v5.part"));
    EXPECT_TRUE(check_integrity(file).empty());
  }
}

TEST(FullDisk, ReadOnlyDiskIsReported) {
  const SmallDisk disk("size=1m");
  if (!disk.mounted()) GTEST_SKIP() << "a small disk can be mounted by root only";
  const std::string file = disk.file("log.db");
  {
    SessionLog log = SessionLog::start(file, header_of("P01"));
    log.append(event(1, event_kind<Note>), {}, Durability::acknowledged);
  }
  const std::string folder = std::filesystem::path(file).parent_path();
  ASSERT_EQ(::mount("tmpfs", folder.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, "size=1m"), 0);
  EXPECT_THAT(failure([&] { SessionLog::reopen(file, 1); }),
              AllOf(HasSubstr(file), HasSubstr("Read-only file system")));
  EXPECT_EQ(LogReader(file).events(1).size(), 1u);
  EXPECT_TRUE(check_integrity(file).empty());
}

// The same without mounting a disk: a limit on the file size.
TEST(FullDisk, FileSizeLimitIsReportedAndAcknowledgedAnswersAreKept) {
  const TemporaryFolder folder;
  const std::string file = folder.file("log.db");
  std::size_t n_saved = 0;
  {
    SessionLog log = SessionLog::start(file, header_of("P01"));
    start_trial_seven(log);
    {
      const SizeLimit limit(1'000'000);
      const std::string message = answer_until_it_fails(log, n_saved);
      EXPECT_THAT(message, AllOf(HasSubstr("the answer \"label cube 2 heaviest\" of trial 7"),
                                 HasSubstr("the file has reached the largest size allowed"),
                                 HasSubstr("heft resume --db " + file)));
      expect_saved(file, n_saved);
    }
    // The cause is gone, but an event was lost: only a resumed session may continue.
    EXPECT_NE(failure([&] { log.flush(); }), "");
  }
  EXPECT_GT(n_saved, 0u);
  expect_saved(file, n_saved);
}

TEST(FullDisk, UnsavedFramesAreReported) {
  const TemporaryFolder folder;
  SessionLog log = SessionLog::start(folder.file("log.db"), header_of("P01"));
  start_trial_seven(log);
  for (int i = 0; i < 3000; ++i) log.add_frame(frame(1, i));
  const SizeLimit limit(1'000'000);
  EXPECT_THAT(failure([&] { log.flush(); }), HasSubstr("0 events and 3000 pictures"));
}

TEST(FullDisk, UnreportedFailureIsPrintedAtEnd) {
  const TemporaryFolder folder;
  std::optional<SessionLog> log(SessionLog::start(folder.file("log.db"), header_of("P01")));
  start_trial_seven(*log);
  for (int i = 0; i < 3000; ++i) log->add_frame(frame(1, i));
  const SizeLimit limit(1'000'000);
  testing::internal::CaptureStderr();
  log.reset();
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("0 events and 3000 pictures"));
}

TEST(FullDisk, StoredSessionIsCompleteOrMissing) {
  const TemporaryFolder folder;
  const std::string file = folder.file("log.db");
  RecordedSession small(header_of("P01")), large(header_of("P02"));
  small.append(event(1, event_kind<Note>), {}, Durability::acknowledged);
  for (int i = 0; i < 5000; ++i) large.add_frame(frame(0, i));
  SessionArchive archive(file);
  archive.store(small);
  {
    const SizeLimit limit(1'000'000);
    EXPECT_THAT(failure([&] { archive.store(large); }),
                AllOf(HasSubstr("the session of P02"), HasSubstr("start again")));
  }
  archive.store(small);
  const auto sessions = LogReader(file).sessions();
  ASSERT_EQ(sessions.size(), 2u);
  EXPECT_EQ(sessions[1].header.participant, "P01");
}

}  // namespace
}  // namespace heft::test
