// The next participant of a study, from its log.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apparatus/StudyPlaces.h"
#include "base/Error.h"

namespace heft {
namespace {

using ::testing::HasSubstr;

StudyPlan six_people() {
  StudyPlan plan;
  plan.name = "mass";
  plan.participants = 6;
  plan.seed = 1;
  plan.id_prefix = "P";
  plan.groups = {{"young", "a.toml", {}}, {"old", "b.toml", {}}};
  plan.orders = {{"x", "y", "z"}, {"y", "z", "x"}, {"z", "x", "y"}};
  return plan;
}

class Log {
 public:
  explicit Log(StudyPlan plan) : plan_(std::move(plan)) {}

  // Adds the next participant's session, which ends in this state.
  void add(SessionState state = SessionState::finished, Purpose purpose = Purpose::main,
           const std::optional<std::string>& id = {}) {
    const PlannedParticipant next = planned_participant(plan_, sessions, purpose, id);
    add_row(next.id, state, purpose, info_of(plan_, next.place));
  }
  void add_row(const std::string& id, SessionState state, Purpose purpose,
               const std::map<std::string, std::string>& info) {
    SessionRow row;
    row.session_id = static_cast<std::int64_t>(sessions.size()) + 1;
    row.header.participant = id;
    row.header.purpose = purpose;
    row.header.participant_info = info;
    row.state = state;
    sessions.push_back(row);
  }
  PlannedParticipant next(const std::optional<std::string>& id = {}) const {
    return planned_participant(plan_, sessions, Purpose::main, id);
  }

  std::vector<SessionRow> sessions;

 private:
  StudyPlan plan_;
};

TEST(StudyPlaces, AreTakenInTurn) {
  Log log(six_people());
  for (int i = 1; i <= 6; ++i) {
    EXPECT_EQ(log.next().place.number, i);
    EXPECT_EQ(log.next().id, "P0" + std::to_string(i));
    log.add();
  }
  EXPECT_THROW(log.next(), Error);
}

TEST(StudyPlaces, AreWhatTheLogReadsBack) {
  Log log(six_people());
  log.add();
  const auto place = place_of(log.sessions.front().header.participant_info);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->study, "mass");
  EXPECT_EQ(place->number, 1);
  EXPECT_EQ(place->participants, 6);
  EXPECT_EQ(place_words(log.sessions.front().header.participant_info), "1 of 6");
  EXPECT_FALSE(place_of({}));
}

TEST(StudyPlaces, OfWhoLeftForGoodAreGivenAgainUnderAnotherId) {
  Log log(six_people());
  log.add();
  log.add(SessionState::aborted);
  EXPECT_EQ(log.next().place.number, 2);
  EXPECT_EQ(log.next().id, "P02b");
  log.add();
  EXPECT_EQ(log.next().id, "P03");
}

TEST(StudyPlaces, OfUnfinishedSessionsAreTaken) {
  Log log(six_people());
  log.add(SessionState::paused);
  EXPECT_EQ(log.next().place.number, 2);
  EXPECT_EQ(log.next("P01").place.number, 1);
}

TEST(StudyPlaces, AreOnesOwn) {
  Log log(six_people());
  log.add(SessionState::finished, Purpose::main, "Anna");
  log.add();
  EXPECT_EQ(log.next("Anna").place.number, 1);
  EXPECT_EQ(log.next("P05").place.number, 5);  // as the plan calls them
  EXPECT_EQ(log.next("Otto").place.number, 3);
}

TEST(StudyPlaces, OfPilotsAndOtherStudiesDontCount) {
  Log log(six_people());
  log.add_row("P01", SessionState::finished, Purpose::pilot, {});  // of an older version
  log.add_row("P09", SessionState::finished, Purpose::main, {{"study", "another"}});
  log.add_row("P10", SessionState::finished, Purpose::main, {});
  EXPECT_EQ(log.next().place.number, 1);
  EXPECT_EQ(log.next().id, "P01b");
}

TEST(StudyPlaces, AndIdsOfRehearsalsAreNoOneElses) {
  Log log(six_people());
  for (const Purpose purpose : {Purpose::pilot, Purpose::test, Purpose::simulated})
    for (const char* number : {"01", "02"}) {
      const PlannedParticipant next =
          planned_participant(six_people(), log.sessions, purpose, std::nullopt);
      EXPECT_EQ(next.id, fmt::format("{}-P{}", name_of(purpose), number));
      log.add(SessionState::finished, purpose, next.id);
      EXPECT_EQ(log.sessions.back().header.participant, next.id);
    }
  EXPECT_EQ(planned_participant(six_people(), log.sessions, Purpose::test, "P05").id, "test-P05");
  EXPECT_EQ(log.next().id, "P01");
  EXPECT_EQ(log.next().place.number, 1);
}

TEST(StudyPlaces, GivenOtherwiseThanThePlanSaysAreRefused) {
  Log log(six_people());
  log.add();
  const auto refusal = [&](const StudyPlan& plan) -> std::string {
    try {
      planned_participant(plan, log.sessions, Purpose::main, {});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  StudyPlan more = six_people();
  more.participants = 60;
  EXPECT_EQ(refusal(more), "");
  StudyPlan other = six_people();
  for (StudyGroup& group : other.groups) group.name += "er";
  EXPECT_THAT(refusal(other), HasSubstr("session 1 of participant P01 has place 1"));
}

TEST(NearIds, AreThoseThatPeopleTakeForOneAnother) {
  const auto is_near = [](const std::string& id, const std::string& other) {
    Log log(six_people());
    log.add_row(other, SessionState::finished, Purpose::main, {});
    return near_id(id, log.sessions) == other;
  };
  for (const char* id : {"1", " 01", "O1", "0l", "001", "0-1"})
    EXPECT_TRUE(is_near(id, "01")) << id;
  EXPECT_TRUE(is_near("p07", "P-07"));
  EXPECT_TRUE(is_near("P7", "P07"));
  EXPECT_TRUE(is_near("0", "00"));
  for (const char* id : {"01", "10", "02", "11", "101", "01b"})
    EXPECT_FALSE(is_near(id, "01")) << id;
  EXPECT_FALSE(is_near("100", "1"));
  for (const char* id : {"1", "01", " 1", "O1"}) EXPECT_TRUE(is_near(id, "P01")) << id;
  for (const char* id : {"10", "A01", "P10", "2"}) EXPECT_FALSE(is_near(id, "P01")) << id;
  EXPECT_FALSE(is_near("1", "P2-01")) << "which of its numbers is meant?";
}

TEST(NearIds, OfAPlanMayLackItsPrefixAndZeros) {
  StudyPlan plan = six_people();
  plan.id_prefix = "P2-";
  for (const char* id : {"1", "01", "p2-01", "P2_01", "O1"})
    EXPECT_EQ(near_planned_id(id, plan), "P2-01") << id;
  for (const char* id : {"P2-01", "7", "A01"})
    EXPECT_EQ(near_planned_id(id, plan), std::nullopt) << id;
}

TEST(NearIds, WithoutTheLettersOfARehearsalAreNoOnes) {
  Log log(six_people());
  log.add_row("simulated-01", SessionState::finished, Purpose::simulated, {});
  EXPECT_EQ(near_id("1", log.sessions), std::nullopt);
}

}  // namespace
}  // namespace heft
