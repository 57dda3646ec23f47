// Backups: a complete, verified log readable by its owner only, or none.
#include "record/writer/Backup.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "base/Error.h"
#include "record/child.h"
#include "record/reader/LogReader.h"
#include "record/rows.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"

namespace heft::test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

class Backup : public testing::Test {
 protected:
  Backup() { write_session("P/01 ä"); }

  void write_session(const std::string& participant, int n_events = 12) {
    SessionLog log = SessionLog::start(db, header_of(participant));
    for (int n = 1; n <= n_events; ++n)
      log.append(event(n, event_kind<Note>, std::string(200, 'x')), {}, Durability::acknowledged);
    log.add_info("age", "30");
  }

  TemporaryFolder home;
  const std::string db = home.file("a.db"), folder = home.file("backups");
};

TEST_F(Backup, HasEverySessionOfTheLog) {
  write_session("P02");
  const std::string copy = back_up(db, folder, 2);
  const LogReader reader(copy), original(db);
  ASSERT_EQ(reader.sessions().size(), 2u);
  for (const std::int64_t id : {1, 2}) {
    EXPECT_FALSE(reader.first_broken_digest(id));
    EXPECT_EQ(reader.events(id).size(), original.events(id).size());
    EXPECT_EQ(reader.session(id).header.participant, original.session(id).header.participant);
  }
  EXPECT_TRUE(check_integrity(copy).empty());
}

TEST_F(Backup, CanBeWrittenAsALog) {
  const std::string copy = back_up(db, folder, 1);
  SessionLog log = SessionLog::reopen(copy, 1);
  log.append(event(99, event_kind<Note>, "more"), {}, Durability::acknowledged);
  EXPECT_EQ(LogReader(copy).events(1).size(), LogReader(db).events(1).size() + 1);
}

TEST_F(Backup, IsNamedAfterParticipantSessionAndTime) {
  EXPECT_EQ(backup_name("P/01 ä", 7, "2026-11-22T09:30:00.123Z", "1a2b3c4d5e6f7890"),
            "P_01____session7_20261122T093000Z_1a2b3c4d5e6f");
  EXPECT_EQ(backup_name("../../etc", 1, "2026-11-22T09:30:00Z", ""),
            "______etc_session1_20261122T093000Z");
  EXPECT_THAT(back_up(db, folder, 1), HasSubstr("/P_01____session1_20"));
  EXPECT_EQ(files_in(folder).size(), 1u);
}

TEST_F(Backup, IsReadableByOwnerOnly) {
  struct stat there {};
  ASSERT_EQ(stat(back_up(db, folder, 1).c_str(), &there), 0);
  EXPECT_EQ(there.st_mode & 0777, 0600u);
  ASSERT_EQ(stat(folder.c_str(), &there), 0);
  EXPECT_EQ(there.st_mode & 0777, 0700u);
}

TEST_F(Backup, NeverReplacesAFile) {
  std::set<std::string> copies;
  for (int i = 0; i < 5; ++i) copies.insert(back_up(db, folder, 1));
  EXPECT_EQ(copies.size(), 5u);
  EXPECT_EQ(files_in(folder).size(), 5u);
}

TEST_F(Backup, RemovesItsCopiesThatWereCutOff) {
  write_session("P02");
  fs::create_directory(folder);
  const std::string mine = backup_name("P/01 ä", 1, "2026-11-22T09:30:00Z", "");
  const std::string another = backup_name("P02", 2, "2026-11-22T09:30:00Z", "");
  const std::string tenth = backup_name("P/01 ä", 10, "2026-11-22T09:30:00Z", "");
  for (const std::string& name : {mine, another, tenth})
    std::ofstream(folder + "/" + name + ".db.part");
  std::ofstream(folder + "/" + mine + ".db") << "whole";
  back_up(db, folder, 1);
  EXPECT_FALSE(fs::exists(folder + "/" + mine + ".db.part"));
  EXPECT_TRUE(fs::exists(folder + "/" + mine + ".db"));
  EXPECT_TRUE(fs::exists(folder + "/" + another + ".db.part"));
  EXPECT_TRUE(fs::exists(folder + "/" + tenth + ".db.part"));
}

TEST_F(Backup, OfChangedLogIsRefused) {
  { SQLite::Database(db, SQLite::OPEN_READWRITE).exec("UPDATE event SET detail = 'forged'"); }
  try {
    back_up(db, folder, 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("differs from what was written"));
  }
  EXPECT_TRUE(files_in(folder).empty());
}

TEST_F(Backup, InReadOnlyFolderIsRefusedAndLogIsUnchanged) {
  fs::create_directory(folder);
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  fs::permissions(home.path(), fs::perms::others_all | fs::perms::owner_all);
  fs::permissions(db, fs::perms::others_read | fs::perms::owner_all);
  EXPECT_THAT(failure_as_ordinary_user([&] { back_up(db, folder, 1); }), HasSubstr(folder));
  EXPECT_TRUE(files_in(folder).empty());
  EXPECT_TRUE(check_integrity(db).empty());
}

TEST_F(Backup, InFileInsteadOfFolderIsRefused) {
  std::ofstream(folder) << "mine";
  EXPECT_THROW(back_up(db, folder, 1), Error);
}

TEST_F(Backup, OnFullDiskIsRefusedAndLeavesNothing) {
  write_session("long", 2000);
  Child child([&](int out) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100000, 100000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      back_up(db, folder, 2);
      say(out, "made");
    } catch (const std::exception& error) {
      say(out, error.what());
    }
  });
  EXPECT_THAT(child.read_all(), HasSubstr("cannot make the backup"));
  EXPECT_TRUE(files_in(folder).empty());
}

TEST_F(Backup, KilledHalfwayLeavesOnlyPartFile) {
  write_session("long", 3000);
  for (int i = 0; i < 30; ++i) {
    {
      Child child([&](int out) {
        say(out, "s");
        back_up(db, folder, 2);
      });
      child.read_byte();
      std::this_thread::sleep_for(std::chrono::microseconds(700 * i));
    }
    if (!fs::exists(folder)) continue;
    for (const std::string& name : files_in(folder))
      if (name.ends_with(".db")) {
        EXPECT_TRUE(check_integrity(folder + "/" + name).empty());
        EXPECT_FALSE(LogReader(folder + "/" + name).first_broken_digest(2));
      }
  }
  EXPECT_TRUE(check_integrity(db).empty());
}

}  // namespace
}  // namespace heft::test
