// A session has the same digests whether it was written live, resumed or stored, for any values.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/Error.h"
#include "record/random_rows.h"
#include "record/reader/LogReader.h"
#include "record/rows.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"

namespace heft::test {
namespace {

std::vector<std::string> digests_in(const std::string& file, std::int64_t session_id) {
  const SQLite::Database database(file, SQLite::OPEN_READONLY);
  std::vector<std::string> digests;
  for (const char* table : {"session", "event", "frame"}) {
    SQLite::Statement query(
        database, fmt::format("SELECT digest FROM {} WHERE session_id = ? ORDER BY rowid", table));
    query.bind(1, session_id);
    while (query.executeStep()) digests.push_back(query.getColumn(0).getString());
  }
  return digests;
}

RecordedSession any_session() {
  RecordedSession session(any_header());
  Written written;
  for (int n = 1; n <= 3; ++n) {
    const Event event = any_event();
    session.append(event, any_changes(any_trial(n), n, written), Durability::acknowledged);
    for (int attempt_index : {n, 0, n, n}) session.add_frame(any_frame(attempt_index));
    session.append(any_event(), flag() ? of_attempt(n) : Changes{}, Durability::acknowledged);
  }
  return session;
}

void write(const RecordedEntry& entry, EventSink& sink) {
  if (const auto* recorded = std::get_if<RecordedEvent>(&entry))
    sink.append(recorded->event, recorded->changes, Durability::buffered);
  else
    sink.add_frame(std::get<FrameRow>(entry));
}

void write_live(const RecordedSession& session, const std::string& file) {
  SessionLog log = SessionLog::start(file, session.header());
  for (const RecordedEntry& entry : session.entries()) write(entry, log);
}

void write_with_resumes(const RecordedSession& session, const std::string& file) {
  const std::int64_t session_id = SessionLog::start(file, session.header()).session_id();
  for (const RecordedEntry& entry : session.entries()) {
    SessionLog log = SessionLog::reopen(file, session_id);
    write(entry, log);
  }
}

RC_GTEST_PROP(DigestChain, IsSameLiveResumedAndStored, ()) {
  const TemporaryFolder folder;
  const RecordedSession session = any_session();
  write_live(session, folder.file("live.db"));
  write_with_resumes(session, folder.file("resumed.db"));
  SessionArchive archive(folder.file("stored.db"));
  archive.store(RecordedSession(any_header()));
  const std::int64_t stored = archive.store(session);

  const auto digests = digests_in(folder.file("live.db"), 1);
  RC_ASSERT(digests.size() == 1u + 6u + 12u);
  RC_ASSERT(digests_in(folder.file("resumed.db"), 1) == digests);
  RC_ASSERT(digests_in(folder.file("stored.db"), stored) == digests);
  RC_ASSERT(!LogReader(folder.file("live.db")).first_broken_digest(1));
  RC_ASSERT(!LogReader(folder.file("resumed.db")).first_broken_digest(1));
  RC_ASSERT(!LogReader(folder.file("stored.db")).first_broken_digest(stored));
}

RC_GTEST_PROP(DigestChain, DistinguishesAnyTwoRows, ()) {
  const TemporaryFolder folder;
  const Event one = any_event();
  Event other = *rc::gen::arbitrary<bool>() ? one : any_event();
  if (flag()) other.t_s = time_s();
  RecordedSession first(header_of("P01")), second(header_of("P01"));
  for (RecordedSession* each : {&first, &second})  // adds the words of its task
    each->append(event(0, event_kind<TrialStarted>), starting(sorting_trial(1, 1)),
                 Durability::buffered);
  first.append(one, {}, Durability::buffered);
  second.append(other, {}, Durability::buffered);
  SessionArchive archive(folder.file("log.db"));
  const auto of_first = digests_in(folder.file("log.db"), archive.store(first));
  const auto of_second = digests_in(folder.file("log.db"), archive.store(second));
  RC_ASSERT((of_first == of_second) == (one == other));
}

// An event that could not be saved must not remain in the chain.
TEST(DigestChain, ContinuesAfterRollback) {
  const TemporaryFolder folder;
  RecordedSession session(header_of("P01")), broken(header_of("P02"));
  for (RecordedSession* each : {&session, &broken}) {
    each->append(event(1, event_kind<TrialStarted>), starting(sorting_trial(1, 1)),
                 Durability::acknowledged);
    each->add_frame(frame(1, 2));
  }
  broken.append(event(3, event_kind<Note>), of_attempt(7), Durability::acknowledged);
  SessionArchive archive(folder.file("log.db"));
  EXPECT_THROW(archive.store(broken), Error);
  const std::int64_t stored = archive.store(session);
  EXPECT_FALSE(LogReader(folder.file("log.db")).first_broken_digest(stored));
}

// Also with a late frame of the previous attempt.
TEST(DigestChain, ContinuesAfterInterruptedAttempt) {
  const TemporaryFolder folder;
  const std::string file = folder.file("log.db");
  {
    SessionLog log = SessionLog::start(file, header_of("P01"));
    log.append(event(1, event_kind<TrialStarted>), starting(sorting_trial(1, 1)),
               Durability::acknowledged);
    for (double t_s : {1.1, 1.2}) log.add_frame(frame(1, t_s));
  }
  SessionLog log = SessionLog::reopen(file, 1);
  log.append(event(2, event_kind<TrialVoided>, "interrupted"), of_attempt(1),
             Durability::acknowledged);
  log.append(event(3, event_kind<TrialStarted>), starting(sorting_trial(2, 3)),
             Durability::acknowledged);
  log.add_frame(frame(2, 3.1));
  log.add_frame(frame(1, 3.2));
  log.flush();
  EXPECT_FALSE(LogReader(file).first_broken_digest(1));
  SQLite::Database(file, SQLite::OPEN_READWRITE)
      .exec("UPDATE frame SET capture_s = 9 WHERE frame_id = 4");
  const auto found = LogReader(file).first_broken_digest(1);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->row_id, 4);
}

}  // namespace
}  // namespace heft::test
