// Models answer what another participant was shown.
#include <gmock/gmock.h>

#include <cmath>

#include "base/Error.h"
#include "replay/AttemptReplay.h"
#include "replay/OfflineResponder.h"
#include "replay/StoredSession.h"

namespace heft {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::shipped_protocol;
using testing::StoredSession;

Judgments judged(const StoredSession& stored, const std::string& responder, std::uint64_t seed = 1,
                 const Protocol* what_if = nullptr) {
  JudgeRequest request{{}, 40, seed};
  from_text(responder, request.responders.emplace_back());
  return judge_session(stored.reader(), stored.session(), request, what_if, [](double) {});
}

std::vector<std::map<std::string, int>> drawn(const Judgments& judgments) {
  std::vector<std::map<std::string, int>> all;
  for (const JudgedTrial& trial : judgments.trials) all.push_back(trial.models[0].n_by_answer);
  return all;
}

GroupScores total(const std::vector<JudgedTrial>& trials) {
  return scores_of(trials, 1, ScoreGroups::all).front();
}

// A model shares no random stream with the session, or it would predict its own answers better than
// possible.
TEST(Judging, AModelsOwnLogsScoreAsItExpects) {
  const Protocol protocol = shipped_protocol("examples/paired_staircases");
  std::vector<JudgedTrial> trials;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    StoredSession stored(protocol, "simulated", seed);
    Judgments found = judged(stored, "simulated");
    EXPECT_EQ(static_cast<int>(found.trials.size()), stored.n_completed());
    EXPECT_GT(found.shown_s, 60);
    std::ranges::move(found.trials, std::back_inserter(trials));
  }
  double sum = 0, sum_squared = 0;
  for (const JudgedTrial& trial : trials) {
    const double beyond = log_score(trial, 0) - log_score_of_own(trial, 0);
    sum += beyond;
    sum_squared += beyond * beyond;
  }
  EXPECT_GT(trials.size(), 100u);
  EXPECT_LT(std::abs(sum), 3 * std::sqrt(sum_squared));
  const GroupScores all = total(trials);
  EXPECT_GT(all.models[0].log_score.value, all.shares.value + 0.1);
  EXPECT_LT(all.models[0].agreement.value, 0.95);
}

TEST(Judging, DrawsFollowFromTheSeedAlone) {
  const StoredSession stored(shipped_protocol("quick"), "simulated", 3);
  const auto once = drawn(judged(stored, "simulated", 5));
  EXPECT_EQ(drawn(judged(stored, "simulated", 5)), once);
  EXPECT_NE(drawn(judged(stored, "simulated", 6)), once);
}

TEST(Judging, WhoNeverFindsADifferenceAnswersSoWhateverWasLogged) {
  const StoredSession stored(shipped_protocol("quick"), "simulated", 3);
  int n_comparisons = 0;
  for (const JudgedTrial& trial : judged(stored, "always_no").trials) {
    if (trial.task != "comparison") continue;
    ++n_comparisons;
    EXPECT_EQ(trial.n_answers, 3);
    EXPECT_EQ(trial.models[0].n, 40) << "draws";
    EXPECT_EQ(trial.models[0].n_of("none"), 40);
  }
  EXPECT_GT(n_comparisons, 0);
}

TEST(Judging, SortingsAreScoredByEveryCubesLabel) {
  const StoredSession stored(shipped_protocol("quick"), "simulated", 3);
  int n_sortings = 0;
  for (const JudgedTrial& trial : judged(stored, "coin").trials) {
    if (trial.task != "sorting") continue;
    ++n_sortings;
    EXPECT_EQ(trial.n_answers, 7) << "six orders, and I don't know";
    EXPECT_EQ(trial.labels.size(), 3u);
    EXPECT_EQ(trial.models[0].n_by_label.size(), 3u);
  }
  EXPECT_GT(n_sortings, 0);
}

TEST(Judging, UntouchedTrialsAreLeftOut) {
  const StoredSession stored(shipped_protocol("quick"), "coin", 3);
  const Judgments found = judged(stored, "simulated");
  EXPECT_TRUE(found.trials.empty());
  EXPECT_EQ(std::ssize(found.left_out), stored.n_completed());
  for (std::size_t i = 0; i < found.left_out.size(); ++i) {
    EXPECT_EQ(found.left_out[i].session_id, stored.id());
    EXPECT_EQ(found.left_out[i].trial_number, static_cast<int>(i) + 1);
    EXPECT_EQ(found.left_out[i].why, is_untouched);
  }
}

TEST(Judging, VoidedTrialsAreLeftOut) {
  const StoredSession stored(shipped_protocol("quick"), "simulated", 3, true, 4);
  const Judgments found = judged(stored, "simulated");
  EXPECT_EQ(found.trials.size(), 4u);
  ASSERT_EQ(found.left_out.size(), 1u);
  EXPECT_EQ(found.left_out[0].why, is_voided);
  EXPECT_EQ(found.left_out[0].trial_number, 5);
}

TEST(Judging, SessionsArePooled) {
  const StoredSession stored(shipped_protocol("quick"), "simulated", 3, true, 4);
  const Judgments one = judged(stored, "simulated");
  Judgments both = one;
  both.add(one);
  EXPECT_EQ(both.trials.size(), 8u);
  EXPECT_EQ(both.left_out.size(), 2u);
  EXPECT_EQ(both.shown_s, 2 * one.shown_s);
}

TEST(Judging, TrialsWithoutFramesAreLeftOut) {
  const StoredSession stored(shipped_protocol("quick"), "simulated", 3, false);
  const Judgments found = judged(stored, "coin");
  EXPECT_TRUE(found.trials.empty());
  EXPECT_EQ(std::ranges::count(found.left_out, lacks_frames, &LeftOutTrial::why),
            stored.n_completed());
}

TEST(Judging, TheLoggedPhysicsShowsTheLoggedFrames) {
  const Protocol protocol = shipped_protocol("quick");
  const StoredSession stored(protocol, "simulated", 3);
  EXPECT_EQ(drawn(judged(stored, "simulated", 1, &protocol)), drawn(judged(stored, "simulated")));
}

// A hundred times the stiffness: the clone hardly lags, and cubes look alike.
TEST(Judging, AStiffSpringLeavesLittleToSee) {
  const Protocol protocol = shipped_protocol("quick");
  Protocol stiff = protocol;
  stiff.coupling.stiffness_n_per_m *= 100;
  const StoredSession stored(protocol, "simulated", 3);
  const auto share_none = [&](const Protocol* what_if) {
    AnswerDraws all;
    for (const JudgedTrial& trial : judged(stored, "simulated", 1, what_if).trials)
      if (trial.task == "comparison")
        for (const auto& [answer, n] : trial.models[0].n_by_answer) {
          all.n += n;
          all.n_by_answer[answer] += n;
        }
    return static_cast<double>(all.n_of("none")) / all.n;
  };
  EXPECT_GT(share_none(&stiff), share_none(nullptr) + 0.2);
}

TEST(Judging, APersonIsNoResponder) {
  const StoredSession stored(shipped_protocol("quick"), "coin", 3);
  try {
    judged(stored, "human");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::usage);
    EXPECT_THAT(error.what(), HasSubstr("person"));
  }
}

TEST(SeenFrames, EndWithTheAnswerAndLackWhatAPauseHid) {
  ProjectedAttempt attempt;
  attempt.events = {{11, 0, {1.5, SessionPaused{"cat"}}, {}},
                    {12, 0, {2.5, SessionContinued{}}, {}},
                    {13, 0, {4.5, Action{"dont_know"}}, {}}};
  std::vector<FrameRow> rows;
  const std::vector<int> after_event{11, 11, 12, 13, 13, 14};
  for (std::size_t i = 0; i < after_event.size(); ++i) {
    rows.emplace_back();
    rows.back().after_event = after_event[i];
    rows.back().trial_t_s = static_cast<double>(i);
  }
  std::vector<double> seen_s;
  for (const DisplayedFrame& frame : seen_frames(attempt, rows, 13)) seen_s.push_back(frame.t_s);
  EXPECT_THAT(seen_s, ElementsAre(0, 1, 3, 4));
}

}  // namespace
}  // namespace heft
