// Any change in a session's log is found, with its row.
#include <gmock/gmock.h>

#include "base/Error.h"
#include "record/tampered_log.h"

namespace heft::test {
namespace {

using testing::HasSubstr;

class Digest : public TamperedLog {};

TEST_F(Digest, UnchangedLogIsValid) {
  for (std::int64_t session_id : {1, 2, 3}) EXPECT_FALSE(found_after("VACUUM", session_id));
  EXPECT_THROW(found_after("VACUUM", 4), Error);
}

TEST_F(Digest, HeaderWithRecomputedDigestMatchesNoEvent) {
  expect_found(
      "UPDATE session SET (participant, digest) = (SELECT participant, digest FROM session "
      "WHERE session_id = 3) WHERE session_id = 2",
      "event", 1);
}

TEST_F(Digest, ChangedAnswerAboutTheParticipantIsFound) {
  SessionLog::reopen(original_, 2).add_info("age", "30");
  for (const char* column : {"key", "value"})
    expect_found(fmt::format("UPDATE participant_info SET {} = 'x' WHERE session_id = 2", column),
                 "participant_info", 2);
}

TEST_F(Digest, RemovedRowIsFoundAtNext) {
  expect_found("DELETE FROM event WHERE event_id = 2", "event", 3);
  expect_found("DELETE FROM frame WHERE frame_id = 1", "frame", 2);
  expect_found("DELETE FROM frame WHERE frame_id = 3", "frame", 6);  // outside trials
}

TEST_F(Digest, SwappedRowsAreFound) {
  for (const std::string table : {"event", "frame"})
    expect_found(fmt::format("UPDATE {0} SET {0}_id = 1000 WHERE {0}_id = 1;"
                             "UPDATE {0} SET {0}_id = 1 WHERE {0}_id = 2;"
                             "UPDATE {0} SET {0}_id = 2 WHERE {0}_id = 1000",
                             table),
                 table, 1);
}

// Merging files changes ids but not their order.
TEST_F(Digest, OrderOfIdsMatters) {
  expect_found("UPDATE event SET event_id = 1000 WHERE event_id = 2", "event", 3);
  expect_found("UPDATE frame SET frame_id = 1000 WHERE frame_id = 1", "frame", 2);
  EXPECT_FALSE(
      found_after("UPDATE event SET event_id = event_id - 100;"
                  "UPDATE frame SET frame_id = frame_id - 100"));
}

TEST_F(Digest, RowMovedToAnotherSessionIsFoundInBoth) {
  const std::string move = "UPDATE event SET session_id = 3 WHERE event_id = 2";
  expect_found(move, "event", 3);
  EXPECT_TRUE(found_after(move, 3));
}

TEST_F(Digest, InsertedRowIsFound) {
  expect_found(
      "INSERT INTO event SELECT 1000, session_id, trial_id, t_s, kind, slot, label, "
      "detail, value, max_push_displacement_m, peak_lag_m, digest FROM event WHERE event_id = 4",
      "event", 1000);
}

TEST_F(Digest, SignOfZeroInPhysicsInputIsFound) {
  std::string zeros = folder_.file("zeros.db");
  std::swap(original_, zeros);
  SessionLog::start(original_, header_of("P01"));
  {
    SessionLog log = SessionLog::start(original_, header_of("P02"));
    FrameRow picture = frame(0, 1);
    picture.effector_velocity.linear_m_s.x() = picture.capture_s = -0.0;
    log.add_frame(picture);
  }
  EXPECT_FALSE(found_after("SELECT 1"));
  EXPECT_TRUE(found_after("UPDATE frame SET effector_vx_m_s = 0.0"));
}

TEST_F(Digest, EarliestRowIsDescribed) {
  const auto broken = found_after(
      "UPDATE event SET detail = 'x' WHERE event_id = 3; UPDATE frame SET quality = 1 WHERE "
      "frame_id IN (2, 5); UPDATE event SET slot = 1 WHERE event_id = 4");
  ASSERT_TRUE(broken);
  EXPECT_EQ(broken->row, "the frame of attempt 1 at 1.750 s");
  EXPECT_EQ(broken->attempt_index, 1);
  EXPECT_EQ(broken->t_s, 1.75);
  EXPECT_EQ(broken->damage, "");
  EXPECT_EQ(broken->logged.size(), 64u);
  EXPECT_EQ(broken->recomputed.size(), 64u);
  EXPECT_NE(broken->logged, broken->recomputed);
  const auto answer = found_after("UPDATE event SET slot = 1 WHERE event_id = 2");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->row, "the answer \"label cube 1 heaviest\" of attempt 1 at 1.250 s");
}

TEST_F(Digest, InvalidRowIsFoundAndDescribed) {
  const auto damage_after = [&](const std::string& change) {
    const auto broken = found_after(change);
    return broken ? broken->damage : "nothing found";
  };
  EXPECT_THAT(damage_after("UPDATE event SET kind = 'foo' WHERE event_id = 2"),
              HasSubstr("table event, row 2, column kind"));
  EXPECT_THAT(damage_after("UPDATE event SET trial_id = 99 WHERE event_id = 2"),
              HasSubstr("trial 99, which is not in this session"));
  EXPECT_THAT(damage_after("UPDATE frame SET trial_id = 99 WHERE frame_id = 2"),
              HasSubstr("trial 99, which is not in this session"));
  EXPECT_THAT(damage_after("UPDATE frame SET clone_qx = NULL WHERE frame_id = 2"),
              HasSubstr("table frame, row 2, column clone_qx"));
  EXPECT_THAT(damage_after("UPDATE session SET state = 'foo'"),
              HasSubstr("table session, row 2, column state"));
}

}  // namespace
}  // namespace heft::test
