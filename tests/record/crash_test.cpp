// kill -9 at any time: acknowledged events are in the file, the file is sound, and a session can be
// started in it again.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <thread>

#include "base/Random.h"
#include "record/child.h"
#include "record/reader/LogReader.h"
#include "record/rows.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"

namespace heft::test {
namespace {

// Event n has t_s = n. Every third one starts an attempt; frames are written between events.
void append_numbered(SessionLog& log, int number) {
  const int attempt_index = (number + 2) / 3;
  const bool starts = number % 3 == 1;
  Changes changes =
      starts ? starting(sorting_trial(attempt_index, number)) : of_attempt(attempt_index);
  log.append(event(number, starts ? event_kind<TrialStarted> : event_kind<Note>), changes,
             Durability::acknowledged);
  log.add_frame(frame(attempt_index, number));
}

// Writes "s" when the session has started, and "e" for each acknowledged event.
void write_session(const std::string& file, int out, int n_events) {
  SessionLog log = SessionLog::start(file, header_of("P01"));
  say(out, "s");
  for (int n = 1; n <= n_events; ++n) {
    append_numbered(log, n);
    say(out, "e");
  }
}

// After a crash: the acknowledged events and at most one more, each complete.
void expect_whole(const std::string& file, const std::string& acknowledged) {
  if (!std::filesystem::exists(file)) {
    EXPECT_EQ(acknowledged, "");
    return;
  }
  EXPECT_TRUE(check_integrity(file).empty());
  const LogReader reader(file);
  const std::size_t n_sessions = reader.sessions().size();
  if (acknowledged.empty() && n_sessions == 0) return;
  ASSERT_EQ(n_sessions, 1u);
  EXPECT_EQ(reader.session(1).header.participant, "P01");
  const std::size_t n_acknowledged = acknowledged.empty() ? 0 : acknowledged.size() - 1;
  const auto events = reader.events(1);
  EXPECT_GE(events.size(), n_acknowledged);
  EXPECT_LE(events.size(), n_acknowledged + 1);
  for (std::size_t i = 0; i < events.size(); ++i)
    EXPECT_EQ(events[i].event.t_s, static_cast<double>(i + 1));
  EXPECT_EQ(reader.trials(1).size(), (events.size() + 2) / 3);
  EXPECT_EQ(reader.cubes(1).size(), 3 * reader.trials(1).size());
  EXPECT_FALSE(reader.first_broken_digest(1));
}

void expect_can_go_on(const std::string& file) {
  const bool has_session = std::filesystem::exists(file) && !LogReader(file).sessions().empty();
  SessionLog log =
      has_session ? SessionLog::reopen(file, 1) : SessionLog::start(file, header_of("P01"));
  log.append(event(1000, event_kind<SessionEnded>, "finished"), {}, Durability::acknowledged);
  const LogReader reader(file);
  EXPECT_EQ(reader.events(log.session_id()).back().event.t_s, 1000);
  EXPECT_FALSE(reader.first_broken_digest(log.session_id()));
}

TEST(Crash, KillsAtRandomTimesLoseNothingAcknowledged) {
  constexpr int n_kills = 60;
  RandomStream random(20261121, "kill");
  int n_while_creating = 0, n_while_running = 0;
  for (int i = 0; i < n_kills; ++i) {
    const TemporaryFolder folder;
    const std::string file = folder.file("log.db");
    Child writer([&](int out) { write_session(file, out, 1'000'000); });
    std::string acknowledged;
    // Every third one early, during the creation of the file.
    if (i % 3 != 0 && writer.read_byte()) acknowledged.push_back('s');
    std::this_thread::sleep_for(std::chrono::microseconds(random.below(40'000)));
    writer.kill();
    acknowledged += writer.read_all();
    ++(acknowledged.empty() ? n_while_creating : n_while_running);
    expect_whole(file, acknowledged);
    expect_can_go_on(file);
    if (HasFailure()) FAIL() << "at kill " << i << ", with " << acknowledged.size() << " signs";
  }
  fmt::print("{} kills while the file was created, {} while events were written\n",
             n_while_creating, n_while_running);
}

// Lets a child run for n stops at system calls (entries and exits), then kills it.
// @return whether it was still running; none if tracing is not allowed
std::optional<bool> kill_at_system_call(Child& child, int n) {
  int status = 0;
  ::waitpid(child.process(), &status, 0);
  if (!WIFSTOPPED(status)) return std::nullopt;
  for (int i = 0; i < n; ++i) {
    ::ptrace(PTRACE_SYSCALL, child.process(), nullptr, nullptr);
    ::waitpid(child.process(), &status, 0);
    if (!WIFSTOPPED(status)) return false;
  }
  child.kill();
  return true;
}

/// @return whether the child was still running; none: see above
std::optional<bool> kill_traced(int n, const std::function<void(int out)>& work,
                                std::string* said = nullptr) {
  Child child([&](int out) {
    if (::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) return;
    ::raise(SIGSTOP);
    work(out);
  });
  const auto still_running = kill_at_system_call(child, n);
  if (said) *said = child.read_all();
  return still_running;
}

// Covers times that a clock rarely hits. An odd stride includes entries and exits; a stride of 1
// takes a minute.
TEST(Crash, KillsAtSystemCallsLoseNothingAcknowledged) {
  constexpr int stride = 7;
  int n = 0;
  for (bool reached = true; reached; n += stride) {
    const TemporaryFolder folder;
    const std::string file = folder.file("log.db");
    std::string acknowledged;
    const auto still_running = kill_traced(
        n, [&](int out) { write_session(file, out, 2); }, &acknowledged);
    if (!still_running) GTEST_SKIP() << "tracing a child process is not allowed here";
    reached = *still_running;
    expect_whole(file, acknowledged);
    expect_can_go_on(file);
    if (HasFailure()) FAIL() << "at system call stop " << n;
  }
  EXPECT_GT(n, 200) << "the session was over sooner than it can be";
}

TEST(Crash, KilledUpgradeIsCompletedAtNextOpening) {
  constexpr int stride = 7;
  int n = 0;
  for (bool reached = true; reached; n += stride) {
    const TemporaryFolder folder;
    const std::string file = folder.file("log.db");
    copy_older_log(file);
    const auto still_running = kill_traced(n, [&](int) { LogReader{file}; });
    if (!still_running) GTEST_SKIP() << "tracing a child process is not allowed here";
    reached = *still_running;
    const LogReader reader(file);
    EXPECT_TRUE(reader.foreign_objects().empty());
    EXPECT_TRUE(check_integrity(file).empty());
    EXPECT_EQ(reader.session_ids().size(), 3u);
    for (const std::int64_t id : reader.session_ids()) EXPECT_FALSE(reader.first_broken_digest(id));
    EXPECT_TRUE(std::filesystem::exists(file + ".v5"));
    EXPECT_FALSE(std::filesystem::exists(file + ".v5.part"));
    EXPECT_FALSE(std::filesystem::exists(file + ".v5-2"));
    if (HasFailure()) FAIL() << "at system call stop " << n;
  }
  EXPECT_GT(n, 200) << "the upgrade was completed sooner than it can be";
}

}  // namespace
}  // namespace heft::test
