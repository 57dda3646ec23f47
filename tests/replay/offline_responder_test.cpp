// Responders on what somebody else saw.
#include <gmock/gmock.h>

#include <set>

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

OfflineAnswers judged(const StoredSession& stored, const std::string& responder) {
  WhoAnswers who;
  from_text(responder, who);
  return answer_session(stored.reader(), stored.session(), who, [](double) {});
}

void expect_full_agreement(const std::vector<OfflineTrial>& trials) {
  for (const OfflineTrial& trial : trials) {
    EXPECT_EQ(trial.logged, trial.judged) << "trial " << trial.trial_number;
    EXPECT_EQ(trial.logged_labels, trial.judged_labels) << "trial " << trial.trial_number;
  }
}

TEST(Judging, EveryResponderAgreesWithItself) {
  const Protocol protocol = shipped_protocol("recommended");
  for (const std::string name : {"simulated", "coin", "criterion_only"})
    for (const std::uint64_t seed : {1u, 2u}) {
      const StoredSession stored(protocol, name, seed);
      const OfflineAnswers found = judged(stored, name);
      SCOPED_TRACE(name);
      EXPECT_EQ(static_cast<int>(found.trials.size()), stored.n_completed());
      EXPECT_GT(found.shown_s, 60);
      expect_full_agreement(found.trials);
    }
}

// A first choice that is wrong is followed by more frames and more choices.
TEST(Judging, TheIntroductionIsAnsweredByItsFirstChoice) {
  const Protocol protocol = shipped_protocol("quick");
  std::set<std::string> seen;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const StoredSession stored(protocol, "coin", seed);
    const std::vector<OfflineTrial> trials = judged(stored, "coin").trials;
    expect_full_agreement(trials);
    seen.insert(trials.front().logged);
  }
  EXPECT_THAT(seen, ElementsAre("heaviest", "other"));
}

TEST(Judging, WhoNeverFindsADifferenceAnswersSoWhateverWasLogged) {
  const StoredSession stored(shipped_protocol("quick"), "always_yes", 3);
  int n_comparisons = 0;
  for (const OfflineTrial& trial : judged(stored, "always_no").trials) {
    if (trial.task == "introduction") continue;
    const bool compares = trial.task == "comparison";
    EXPECT_EQ(trial.judged, compares ? "none" : "dont_know");
    EXPECT_NE(trial.logged, trial.judged);
    n_comparisons += compares;
  }
  EXPECT_GT(n_comparisons, 0);
}

TEST(Judging, TrialsWithoutFramesAreToldNotJudged) {
  const StoredSession stored(shipped_protocol("quick"), "coin", 3, false);
  const OfflineAnswers found = judged(stored, "coin");
  EXPECT_TRUE(found.trials.empty());
  EXPECT_EQ(found.n_without_frames, stored.n_completed());
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
  AttemptFold attempt;
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

OfflineTrial comparison(double reference_g, bool has_difference, const std::string& logged,
                        const std::string& judged) {
  OfflineTrial trial;
  trial.task = "comparison";
  trial.condition = "C2";
  trial.reference_g = reference_g;
  trial.has_difference = has_difference;
  trial.logged = logged;
  trial.judged = judged;
  return trial;
}

TEST(Agreements, CountByTaskTechniqueAndReference) {
  const auto found = agreements(
      {comparison(15, true, "comparison", "comparison"), comparison(15, true, "comparison", "none"),
       comparison(15, false, "none", "reference"), comparison(200, true, "none", "none")});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].reference_g, 15);
  EXPECT_EQ(found[0].answers.n(), 3);
  EXPECT_EQ(found[0].answers.n_agree(), 1);
  EXPECT_EQ(found[0].answers.n_by_pair.at({"none", "reference"}), 1);
  ASSERT_TRUE(found[0].logged);
  EXPECT_EQ(found[0].logged->d_prime, detection({2, 2, 1, 0})->d_prime);
  EXPECT_EQ(found[0].judged->d_prime, detection({2, 1, 1, 1})->d_prime);
  EXPECT_FALSE(found[1].logged) << "no trial without difference";
}

}  // namespace
}  // namespace heft
