// Rows are read as they were written, bit for bit, for any values.
#include <SQLiteCpp/Database.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "base/Error.h"
#include "record/random_rows.h"
#include "record/reader/LogReader.h"
#include "record/rows.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"

namespace heft::test {
namespace {

RC_GTEST_PROP(RoundTrip, EveryRowIsReadAsWritten, ()) {
  const TemporaryFolder folder;
  const SessionHeader header = any_header();
  const auto state = any_of<SessionState>();
  Written written;
  std::vector<FrameRow> frames, frames_outside;
  std::int64_t session_id = 0;
  {
    SessionLog log = SessionLog::start(folder.file("log.db"), header);
    session_id = log.session_id();
    for (int n = 1; n <= 3; ++n) {
      const Event event = any_event();
      const Changes changes = any_changes(any_trial(n), n, written);
      written.events.push_back({event, n});
      log.append(event, changes, flag() ? Durability::acknowledged : Durability::buffered);
      frames.push_back(any_frame(n));
      log.add_frame(frames.back());
    }
    frames_outside.push_back(any_frame(0));
    log.add_frame(frames_outside.back());
    Changes changes;
    changes.state = state;
    written.events.push_back({any_event(), 0});
    log.append(written.events.back().event, changes, Durability::acknowledged);
  }
  const LogReader reader(folder.file("log.db"));
  RC_ASSERT(text(reader.session(session_id).header) == text(header));
  RC_ASSERT(reader.session(session_id).state == state);
  RC_ASSERT(text(reader.events(session_id)) == text(written.events));
  RC_ASSERT(text(reader.trials(session_id)) == text(written.trials));
  RC_ASSERT(text(reader.cubes(session_id)) == text(written.cubes));
  RC_ASSERT(text(reader.answers(session_id)) == text(written.answers));
  RC_ASSERT(text(reader.reversals(session_id)) == text(written.reversals));
  RC_ASSERT(text(reader.estimates(session_id)) == text(written.estimates));
  for (int n = 1; n <= 3; ++n)
    RC_ASSERT(text(reader.frames(session_id, n)) ==
              text(std::vector{frames[static_cast<std::size_t>(n - 1)]}));
  RC_ASSERT(text(reader.frames(session_id, 0)) == text(frames_outside));
}

TEST(RoundTrip, DrawnParticipantIsReadWithItsSetup) {
  const TemporaryFolder folder;
  SessionLog log = SessionLog::start(folder.file("log.db"), header_of("P01"));
  SessionConfig setup;
  setup.participant_parameters = {{"hold_s", 0.1 + 0.2}};
  Changes changes;
  changes.setup = setup;
  changes.parameters = {{1, "hold_s", 0.1 + 0.2}};
  log.append({1, setup}, changes, Durability::acknowledged);
  const LogReader reader(folder.file("log.db"));
  EXPECT_EQ(reader.setups(1).at(0).setup, setup);
  const auto parameters = reader.participant_parameters(1);
  ASSERT_EQ(parameters.size(), 1u);
  EXPECT_EQ(parameters[0].setup_index, 1);
  EXPECT_EQ(parameters[0].name, "hold_s");
  EXPECT_EQ(parameters[0].value, 0.1 + 0.2);
}

TEST(RoundTrip, ChangedTrialAndCubesReplaceRows) {
  const TemporaryFolder folder;
  SessionLog log = SessionLog::start(folder.file("log.db"), header_of("P01"));
  TrialRow trial = sorting_trial(1, 2.5);
  log.append(event(2.5, event_kind<TrialStarted>), starting(trial), Durability::acknowledged);
  trial.status = TrialStatus::completed;
  trial.plan.masses_g = {15, 200, 800};
  Changes changes = starting(trial);
  changes.cubes = {{1, 2, 200, 4, 1.25, 3.0, 4.0}};
  log.append(event(5, event_kind<Action>, "validate"), changes, Durability::acknowledged);

  const LogReader reader(folder.file("log.db"));
  ASSERT_EQ(reader.trials(1).size(), 1u);
  EXPECT_EQ(text(reader.trials(1).front()), text(trial));
  const std::vector<CubeRow> expected{
      {1, 1, 15, 0, 0, {}, {}}, {1, 2, 200, 4, 1.25, 3.0, 4.0}, {1, 3, 800, 0, 0, {}, {}}};
  EXPECT_EQ(text(reader.cubes(1)), text(expected));
}

TEST(RoundTrip, LaterSessionHasItsOwnAttempts) {
  const TemporaryFolder folder;
  for (const char* participant : {"P01", "P02"}) {
    SessionLog log = SessionLog::start(folder.file("log.db"), header_of(participant));
    TrialRow trial = sorting_trial(1, 1);
    trial.plan.block = participant;
    log.append(event(1, event_kind<TrialStarted>), starting(trial), Durability::acknowledged);
  }
  const LogReader reader(folder.file("log.db"));
  EXPECT_EQ(reader.sessions().size(), 2u);
  EXPECT_EQ(reader.trials(1).at(0).plan.block, "P01");
  EXPECT_EQ(reader.trials(2).at(0).plan.block, "P02");
  EXPECT_EQ(reader.events(2).at(0).attempt_index, 1);
}

TEST(RoundTrip, NanIsRefused) {
  const TemporaryFolder folder;
  SessionLog log = SessionLog::start(folder.file("log.db"), header_of("P01"));
  const Event broken{1, BreakTaken{"break", std::nan("")}};
  EXPECT_THROW(log.append(broken, {}, Durability::acknowledged), Error);
  EXPECT_TRUE(LogReader(folder.file("log.db")).events(1).empty());
}

RC_GTEST_PROP(SessionArchive, StoredSessionEqualsLiveOne, ()) {
  const TemporaryFolder folder;
  const SessionHeader header = any_header();
  RecordedSession recorded(header);
  {
    SessionLog live = SessionLog::start(folder.file("live.db"), header);
    Written written;
    for (int n = 1; n <= 3; ++n) {
      const Event event = any_event();
      const Changes changes = any_changes(any_trial(n), n, written);
      const FrameRow frame = any_frame(n);
      for (EventSink* sink : std::initializer_list<EventSink*>{&live, &recorded}) {
        sink->append(event, changes, Durability::acknowledged);
        sink->add_frame(frame);
        sink->flush();
      }
    }
  }
  SessionArchive archive(folder.file("stored.db"));
  const std::int64_t first = archive.store(recorded);
  const std::int64_t second = archive.store(recorded);
  RC_ASSERT(second == first + 1);
  const LogReader live(folder.file("live.db")), stored(folder.file("stored.db"));
  RC_ASSERT(whole_session(stored, first) == whole_session(live, 1));
  RC_ASSERT(whole_session(stored, second) == whole_session(live, 1));
}

// A crash between the two would make the log invalid, and the session could not be resumed.
TEST(ParticipantInfo, IsWrittenTogetherWithItsDigest) {
  const TemporaryFolder folder;
  const std::string path = folder.file("log.db");
  SessionLog log = SessionLog::start(path, header_of("P01"));
  log.add_info("age", "31");
  SQLite::Database other(path, SQLite::OPEN_READWRITE);
  other.exec("ALTER TABLE session RENAME COLUMN info_digest TO out_of_reach");
  EXPECT_THROW(log.add_info("hand", "left"), Error);
  EXPECT_EQ(other.execAndGet("SELECT group_concat(key) FROM participant_info").getString(), "age");
}

}  // namespace
}  // namespace heft::test
