// The chain of seals: sessions that are removed, swapped, renumbered or cut are noticed.
#include <gmock/gmock.h>

#include <algorithm>

#include "record/tampered_log.h"

namespace heft::test {
namespace {

using testing::SizeIs;

// Three sessions, all sealed; the second was left, resumed after the third, and sealed again.
class SealedLog : public TamperedLog {
 protected:
  void SetUp() override {
    write_session("P01");
    write_session("P02");
    write_session("P03");
    for (const std::int64_t id : {1, 2, 3}) SessionLog::reopen(original_, id).seal();
    SessionLog log = SessionLog::reopen(original_, 2);
    log.append(event(9, event_kind<Note>, "resumed"), {}, Durability::acknowledged);
    log.add_frame(picture(0, 9.5));
    log.seal();
  }

  void change(const std::string& sql) {
    std::filesystem::copy_file(original_, copy_, std::filesystem::copy_options::overwrite_existing);
    SQLite::Database database(copy_, SQLite::OPEN_READWRITE);
    database.exec("PRAGMA ignore_check_constraints = ON; PRAGMA foreign_keys = OFF");
    database.exec(sql);
  }

  bool is_sound() const {
    const LogReader reader(copy_);
    return !reader.first_broken_seal() &&
           std::ranges::none_of(reader.session_ids(), [&](std::int64_t id) {
             return reader.first_broken_digest(id).has_value();
           });
  }

  bool has_head(const std::string& head) const {
    const auto seals = LogReader(copy_).seals();
    return std::ranges::find(seals, head, &Seal::head) != seals.end();
  }

  static std::string removed(int session_id, const std::string& tables) {
    std::string sql;
    for (const char* table : {"event", "frame", "session", "participant_info", "trial", "setup"})
      sql += fmt::format("DELETE FROM {} WHERE session_id = {};", table, session_id);
    return sql + tables;
  }

  static std::string renumbered(int from, int to) {
    std::string sql;
    for (const char* table : {"event", "frame", "session", "participant_info", "trial", "setup"})
      sql += fmt::format("UPDATE {} SET session_id = {} WHERE session_id = {};", table, to, from);
    return sql;
  }

  static std::string renumbered_seals(int from, int to) {
    return fmt::format("UPDATE seal SET session_id = {} WHERE session_id = {};", to, from);
  }

  // The last events of a session and its counts.
  static std::string cut(int session_id, int n_events, int n_frames) {
    return fmt::format(
        "DELETE FROM event WHERE event_id IN (SELECT event_id FROM event WHERE session_id = {0} "
        "ORDER BY event_id DESC LIMIT {1});"
        "DELETE FROM frame WHERE frame_id IN (SELECT frame_id FROM frame WHERE session_id = {0} "
        "ORDER BY frame_id DESC LIMIT {2});"
        "UPDATE session SET n_events = n_events - {1}, n_frames = n_frames - {2} WHERE session_id "
        "= {0};",
        session_id, n_events, n_frames);
  }
};

TEST_F(SealedLog, UnchangedIsSoundWithEveryHead) {
  change("VACUUM");
  EXPECT_TRUE(is_sound());
  EXPECT_THAT(LogReader(original_).seals(), SizeIs(4));
  for (const Seal& seal : LogReader(original_).seals()) EXPECT_TRUE(has_head(seal.head));
}

TEST_F(SealedLog, ChangesAreNoticed) {
  const std::string seals_of_3 = "DELETE FROM seal WHERE session_id = 3;";
  const std::vector<std::string> changes{
      removed(1, ""),
      removed(1, "DELETE FROM seal WHERE session_id = 1;"),
      removed(2, ""),
      removed(2, "DELETE FROM seal WHERE session_id = 2;"),
      removed(3, ""),
      removed(3, seals_of_3),
      removed(2, "") + renumbered(3, 2),
      removed(2, "DELETE FROM seal WHERE session_id = 2;") + renumbered(3, 2) +
          renumbered_seals(3, 2),
      removed(1, "DELETE FROM seal WHERE session_id = 1;") + renumbered(2, 1) + renumbered(3, 2) +
          renumbered_seals(2, 1) + renumbered_seals(3, 2),
      renumbered(3, 4),
      renumbered(3, 4) + renumbered_seals(3, 4),
      renumbered(1, 9) + renumbered(3, 1) + renumbered(9, 3),
      renumbered(1, 9) + renumbered(3, 1) + renumbered(9, 3) + renumbered_seals(1, 9) +
          renumbered_seals(3, 1) + renumbered_seals(9, 3),
      cut(1, 1, 0),
      cut(1, 0, 2),
      cut(1, 2, 3),
      cut(1, 2, 3) + "DELETE FROM seal WHERE session_id = 1;",
      cut(2, 1, 1),
      cut(2, 1, 1) + cut(3, 2, 3),
      cut(3, 1, 0),
      cut(3, 0, 1),
      cut(3, 2, 3) + seals_of_3,
      "UPDATE session SET state = 'finished' WHERE session_id = 2",
      "UPDATE session SET state = 'aborted' WHERE session_id = 1",
      "DELETE FROM seal",
      "DELETE FROM seal WHERE seal_id = 1",
      "UPDATE seal SET seal_id = seal_id + 1 WHERE seal_id = 4",
      "UPDATE seal SET n_frames = n_frames - 1 WHERE seal_id = 2",
      "UPDATE seal SET state = 'finished' WHERE seal_id = 3",
      "UPDATE seal SET head = (SELECT head FROM seal WHERE seal_id = 2) WHERE seal_id = 3",
      "UPDATE seal SET info_digest = digest WHERE seal_id = 1",
      "UPDATE event SET event_id = event_id + 1 WHERE event_id = (SELECT max(event_id) FROM event)",
      "UPDATE frame SET frame_id = frame_id + 1 WHERE frame_id = (SELECT max(frame_id) FROM frame)",
  };
  for (const std::string& sql : changes) {
    change(sql);
    EXPECT_FALSE(is_sound()) << sql;
  }
}

// Whichever session was withdrawn, and whether or not another one follows.
TEST_F(SealedLog, ChangedLastIdIsNoticedAfterWithdrawals) {
  const std::string first = "2026-02-01T10:00:00Z";
  const auto expect_last_ids_checked = [&](const std::string& after) {
    change("UPDATE session SET state = state");
    EXPECT_TRUE(is_sound()) << after;
    for (const char* table : {"event", "frame"}) {
      change(fmt::format(
          "UPDATE {0} SET {0}_id = {0}_id + 1 WHERE {0}_id = (SELECT max({0}_id) FROM {0})",
          table));
      EXPECT_FALSE(is_sound()) << after << ": " << table;
    }
  };
  for (const std::int64_t session : {3, 1}) {
    withdraw_session(original_, session, first);
    expect_last_ids_checked(fmt::format("withdrawal of {}", session));
    write_session(fmt::format("P1{}", session));
    SessionLog::reopen(original_, session == 3 ? 4 : 5).seal();
    expect_last_ids_checked(fmt::format("a session after the withdrawal of {}", session));
  }
}

// Without a witness it looks like a log that was copied before.
TEST_F(SealedLog, LastPartThatIsCutIsNoticedByItsHeadOnly) {
  const std::string head = LogReader(original_).head();
  for (const std::string& sql :
       {cut(2, 1, 1) + "DELETE FROM seal WHERE seal_id = 4;",
        cut(2, 1, 1) + cut(3, 0, 0) +
            "DELETE FROM seal WHERE seal_id = 4; UPDATE session SET state = state"}) {
    change(sql);
    EXPECT_TRUE(is_sound()) << sql;
    EXPECT_FALSE(has_head(head)) << sql;
  }
}

// As someone would who knows how heft computes seals.
TEST_F(SealedLog, RemadeSealsHaveAnotherHead) {
  const std::string head = LogReader(original_).head();
  change(cut(2, 1, 0) + "DELETE FROM seal;");
  SessionLog::reopen(copy_, 2).seal();
  EXPECT_TRUE(is_sound());
  EXPECT_FALSE(has_head(head));
}

TEST_F(SealedLog, IsNotSealedTwiceWithTheSameContents) {
  SessionLog log = SessionLog::reopen(original_, 2);
  const std::string head = LogReader(original_).head();
  EXPECT_EQ(log.seal(), head);
  EXPECT_EQ(log.seal(), head);
  log.add_info("age", "30");
  EXPECT_NE(log.seal(), head);
  EXPECT_FALSE(LogReader(original_).first_broken_digest(2));
}

// In the transaction that ends it, so that no interruption comes between.
TEST_F(SealedLog, EndedSessionNeverLacksItsSeal) {
  for (const auto& [how, state] : {std::pair{Ending::finished, SessionState::finished},
                                   {Ending::aborted, SessionState::aborted}}) {
    std::int64_t id = 0;
    {
      SessionLog log = SessionLog::start(original_, header_of("P09"));
      id = log.session_id();
      EXPECT_NE(LogReader(original_).seals().back().session_id, id);
      Changes changes;
      changes.state = state;
      log.append({5, SessionEnded{how}}, changes, Durability::acknowledged);
      EXPECT_EQ(LogReader(original_).seals().back().session_id, id);
      EXPECT_EQ(log.seal(), LogReader(original_).head());
    }
    change("VACUUM");
    EXPECT_TRUE(is_sound());
    change("DELETE FROM seal WHERE seal_id = (SELECT max(seal_id) FROM seal)");
    EXPECT_FALSE(is_sound());
    const std::string head = LogReader(original_).head();
    SessionLog::reopen(original_, id).add_info("age", "30");
    EXPECT_NE(LogReader(original_).head(), head);  // sealed again with it
    change("VACUUM");
    EXPECT_TRUE(is_sound());
  }
}

TEST_F(SealedLog, SessionThatWasCutOffIsSealedBeforeTheNext) {
  SessionLog::start(original_, header_of("P04"));  // as after a crash: not sealed
  EXPECT_FALSE(LogReader(original_).first_broken_seal());
  SessionLog::start(original_, header_of("P05"));
  EXPECT_EQ(LogReader(original_).seals().back().session_id, 4);
  EXPECT_FALSE(LogReader(original_).first_broken_seal());
}

// An answer about the participant is one of a few; its digest must not give it away.
TEST_F(SealedLog, DigestOfAnswersAboutTheParticipantDependsOnTheSession) {
  for (const std::int64_t id : {1, 2}) SessionLog::reopen(original_, id).add_info("age", "30");
  for (const std::int64_t id : {1, 2}) SessionLog::reopen(original_, id).seal();
  const auto seals = LogReader(original_).seals();
  EXPECT_NE(seals[seals.size() - 1].info_digest, seals[seals.size() - 2].info_digest);
}

}  // namespace
}  // namespace heft::test
