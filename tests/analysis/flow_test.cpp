// Participant flow, tracking quality, and each participant's own threshold.
#include <gmock/gmock.h>

#include "Figures.h"
#include "MadeUpChoosers.h"
#include "analysis/Folds.h"
#include "analysis/dataset/Participants.h"
#include "analysis/dataset/Quality.h"

namespace heft {
namespace {

using namespace made_up;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

TEST(ParticipantFlow, CountsWhoWentHowFarAndWhyNot) {
  SessionData declined = session(1, "declined");
  declined.events.consented = false;
  declined.session.state = SessionState::aborted;
  SessionData finished = session(2, "finished");
  add_introduction(finished, 1);
  SessionData paused = session(3, "paused");
  add_introduction(paused, 1);
  paused.session.state = SessionState::paused;
  SessionData left_out = session(4, "left out");
  left_out.exclusion.anticipatory_responses = 0;
  add_introduction(left_out, 1).trial.validated_s = 0.1;
  left_out.attempts[0].trial.shown_s = 0;
  const std::vector<SessionData> sessions{declined, finished, paused, left_out};
  const ParticipantFlow flow = flow_of(sessions, participants_of(sessions));
  EXPECT_EQ(flow.n_asked, 4);
  EXPECT_EQ(flow.n_declined, 1);
  EXPECT_EQ(flow.n_started, 3);
  EXPECT_EQ(flow.n_finished, 2);
  EXPECT_EQ(flow.n_analyzed, 2);
  EXPECT_THAT(flow.excluded, ElementsAre(Pair("anticipatory responses", 1)));
  EXPECT_THAT(flow.unfinished, ElementsAre(Pair("paused", 1)));
}

TEST(ParticipantFlow, WhoAgreedInASecondSessionDidNotDecline) {
  SessionData first = session(1, "a"), second = session(2, "a");
  first.events.consented = false;
  second.events.consented = true;
  add_introduction(second, 1);
  const std::vector<SessionData> sessions{first, second};
  const ParticipantFlow flow = flow_of(sessions, participants_of(sessions));
  EXPECT_EQ(flow.n_asked, 1);
  EXPECT_EQ(flow.n_declined, 0);
  EXPECT_EQ(flow.n_analyzed, 1);
}

TEST(TrackingQuality, AddsUpAParticipantsSessions) {
  SessionData one = session(1, "a"), other = session(2, "a");
  one.frames = {100, 90, 2, 0.5};
  other.frames = {300, 300, 0, 0.9};
  Attempt& attempt = add_introduction(one, 1);
  attempt.trial.shown_s = 10;
  attempt.trial.validated_s = 20;
  attempt.trial.lost_s = 1;
  const Summary summary = summarized({one, other});
  EXPECT_EQ(estimates_of(all_estimates(summary), "in_view").size(), 1u);
  EXPECT_DOUBLE_EQ(*figure(summary, "in_view").value, 90);
  EXPECT_DOUBLE_EQ(*figure(summary, "tracked").value, 97.5);
  EXPECT_EQ(figure(summary, "jumps").value, 2);
  EXPECT_DOUBLE_EQ(*figure(summary, "tracking_quality").value, 0.8);
}

TEST(TrackingQuality, WithoutFramesHasTheTimeAlone) {
  const Summary summary = summarized({session(1, "a")});
  EXPECT_EQ(figure(summary, "tracking_losses").value, 0);
  EXPECT_FALSE(figure(summary, "tracked").value.has_value());
  EXPECT_FALSE(figure(summary, "in_view").value.has_value());
}

TEST(PersonThresholds, AreGivenWhereTheTrialsIdentifyThem) {
  RandomStream stream(3, "two people");
  std::vector<SessionData> sessions{session(1, "sees"), session(2, "sees nothing")};
  for (int i = 0; i < 6; ++i) {
    compare(sessions[0], {0.6745 / 100}, paired_at(200), stream);
    compare(sessions[1], {0}, paired_at(200), stream);
  }
  const Summary summary = summarized(sessions);
  const auto of = [&](std::string_view measure, const char* participant,
                      const char* staircases = "") {
    return figure(summary, measure, {{"participant", participant}, {"staircases", staircases}});
  };
  const StudyEstimate sees = of("threshold_75", "sees");
  ASSERT_TRUE(sees.value.has_value()) << sees.why;
  EXPECT_LT(*sees.low, 100);
  EXPECT_GT(*sees.high, 100);
  const StudyEstimate blind = of("threshold_75", "sees nothing");
  EXPECT_FALSE(blind.value.has_value());
  EXPECT_THAT(blind.why, HasSubstr("contains 0"));
  EXPECT_EQ(of("staircase_start", "sees nothing", "from above").value, 600);
  EXPECT_EQ(of("staircase_start", "sees nothing", "from below").value, 20);
}

TEST(EarlyAnswers, AreThoseThatTheSetupForbade) {
  SessionData data = session(1, "a");
  data.setups[0].setup.min_answer_s = 1.5;
  Attempt& attempt = add_introduction(data, 1);
  attempt.trial.shown_s = 0;
  attempt.trial.validated_s = 1;
  attempt.trial.first_contact_s = 0.5;
  EXPECT_TRUE(is_anticipatory(data, data.attempts[0]));
  const Quality quality = quality_of(std::vector{data});
  EXPECT_EQ(quality.counted.at(0).what, "answers earlier than 1.5 s");
  EXPECT_EQ(quality.counted[0].n, 1);
  data.setups[0].setup.min_answer_s = 0.5;
  EXPECT_FALSE(is_anticipatory(data, data.attempts[0]));
}

}  // namespace
}  // namespace heft
