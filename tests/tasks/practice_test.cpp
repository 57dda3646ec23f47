// Practice before the trials of a block: how long it lasts, what it leaves untouched, feedback.
#include "tasks/blocks/Practice.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "base/files/TextFile.h"
#include "engine/Engine.h"
#include "psychophysics/Procedure.h"
#include "psychophysics/UpDown.h"
#include "replay/OfflineResponder.h"
#include "replay/Replay.h"
#include "replay/StoredSession.h"
#include "tasks/Tasks.h"

namespace heft {
namespace {
using ::testing::ElementsAre;
using testing::StoredSession;

constexpr int practice_trials = 4, until_correct = 2;

Comparison::Block comparisons() {
  Comparison::Block block;
  block.name = "compare";
  block.catch_fraction = 0.5;
  block.staircases = {
      {200,
       {"200g",
        UpDownConfig{
            .start = 400, .step = 100, .floor = 0, .stop_reversals = 4, .stop_trials = 12}},
       "C2"}};
  return block;
}

TaskBlock practiced(TaskBlock block, int until = until_correct, bool feedback = true) {
  block.practice = Practice{practice_trials, until, feedback};
  return block;
}

/// A session with one block, answered by hand.
class Answered {
 public:
  explicit Answered(const TaskBlock& block) {
    auto plan = std::make_shared<SessionPlan>();
    plan->blocks = {block};
    engine_.emplace(std::move(plan), 7);
  }

  /// The next trial of a comparison, answered with the heavier cube, or with the lighter one.
  TrialRow choose(bool heavier) {
    apply(TrialStarted{});
    apply(CubesShown{});
    const std::vector<double>& masses_g = engine_->next().plan->masses_g;
    const bool right = masses_g[1] > masses_g[0];
    return *apply(Action{"select", right == heavier ? 2 : 1}).trial;
  }
  /// Trials until practice ends, with these answers in turn; the last one is repeated.
  std::vector<TrialRow> practice(std::vector<bool> heavier) {
    std::vector<TrialRow> rows;
    for (std::size_t i = 0; engine_->next().plan && engine_->next().plan->is_practice; ++i)
      rows.push_back(choose(heavier[std::min(i, heavier.size() - 1)]));
    return rows;
  }
  Changes apply(EventPayload what) { return engine_->apply({++t_s_, std::move(what)}); }
  const Engine& engine() const { return *engine_; }

 private:
  std::optional<Engine> engine_;
  double t_s_ = 0;
};

TEST(Practice, EndsAfterSoManyCorrectAnswersInARowOrAfterItsTrials) {
  EXPECT_EQ(Answered(practiced(comparisons())).practice({true}).size(), 2u);
  EXPECT_EQ(Answered(practiced(comparisons())).practice({true, false, true}).size(), 4u);
  EXPECT_EQ(Answered(practiced(comparisons())).practice({false, true}).size(), 3u);
  EXPECT_EQ(Answered(practiced(comparisons())).practice({false}).size(), 4u);
  EXPECT_EQ(Answered(practiced(comparisons(), 0)).practice({true}).size(), 4u)
      << "without a criterion";
  EXPECT_EQ(Answered(comparisons()).practice({true}).size(), 0u);
}

TEST(Practice, ShowsTheFirstLevelWithoutCatchTrialsOnBothSides) {
  Comparison::Block block = comparisons();
  block.sides = Sides::balanced;
  TaskBlock long_practice = practiced(block, 0);
  long_practice.practice->trials = 40;
  Answered session(long_practice);
  int n_left = 0;
  const std::vector<TrialRow> rows = session.practice({true, false});
  ASSERT_EQ(rows.size(), 40u);
  for (const TrialRow& row : rows) {
    EXPECT_TRUE(row.plan.is_practice);
    EXPECT_EQ(row.plan.level_g, 400);
    EXPECT_FALSE(row.plan.is_catch);
    EXPECT_EQ(row.plan.staircase, "") << "no procedure is fed";
    n_left += row.plan.reference_slot == 1 ? 1 : 0;
  }
  EXPECT_NEAR(n_left, 20, 12);
}

// The block's trials, reversals and estimates are those of a block without practice.
TEST(Practice, LeavesTheStaircaseAsItWas) {
  Comparison::Block block = comparisons();
  block.catch_fraction = 0;
  const auto course = [&](const TaskBlock& trials) {
    Answered session(trials);
    session.practice({false});
    std::vector<double> levels_g;
    std::vector<EstimateRow> estimates;
    for (int i = 0; session.engine().next().kind == Next::Kind::trial; ++i) {
      session.apply(TrialStarted{});
      session.apply(CubesShown{});
      const TrialPlan plan = *session.engine().next().plan;
      EXPECT_EQ(plan.staircase, "200g");
      levels_g.push_back(*plan.level_g);
      const Action answer = i % 3 == 2 ? Action{"no_difference"} : Action{"select", 1};
      for (const EstimateRow& one : session.apply(answer).estimates) estimates.push_back(one);
    }
    EXPECT_FALSE(estimates.empty());
    return std::tuple(levels_g, estimates.at(0).jnd_g, estimates.at(0).n_trials);
  };
  EXPECT_EQ(course(practiced(block)), course(block));
}

TEST(Practice, FeedbackIsGivenBeforeTheNextTrialOfPracticeOnly) {
  Answered session(practiced(comparisons()));
  const auto feedback = [&] { return session.engine().screen().feedback; };
  EXPECT_FALSE(feedback()) << "before the first answer";
  session.choose(false);
  EXPECT_EQ(feedback(), false);
  session.choose(true);
  EXPECT_EQ(feedback(), true);
  session.apply(TrialStarted{});
  EXPECT_FALSE(feedback()) << "of the open trial";
  session.apply(CubesShown{});
  const std::vector<double> masses_g = session.engine().next().plan->masses_g;
  session.apply(Action{"select", masses_g[1] > masses_g[0] ? 2 : 1});
  EXPECT_FALSE(session.engine().next().plan->is_practice) << "two in a row";
  EXPECT_EQ(feedback(), true);
  session.choose(true);
  EXPECT_FALSE(feedback()) << "a trial that counts";
  Answered silent(practiced(comparisons(), until_correct, false));
  silent.choose(true);
  EXPECT_FALSE(silent.engine().screen().feedback);
}

TEST(Practice, AVetoedAnswerDoesNotCount) {
  Answered session(practiced(comparisons()));
  session.choose(true);
  const TrialRow second = session.choose(true);
  EXPECT_FALSE(session.engine().next().plan->is_practice);
  session.apply(AnswerVetoed{"by mistake"});
  EXPECT_FALSE(session.engine().screen().feedback);
  const TrialPlan again = *session.engine().next().plan;
  EXPECT_TRUE(again.is_practice);
  EXPECT_EQ(again.trial_number, second.plan.trial_number);
  EXPECT_EQ(again.attempt, second.plan.attempt + 1);
  session.choose(false);
  EXPECT_TRUE(session.engine().next().plan->is_practice) << "one wrong after one correct";
}

TEST(Practice, CorrectAnswersAreDefinedInThreeTasks) {
  EXPECT_TRUE(TaskBlock(comparisons()).has_correct_answers());
  EXPECT_TRUE(TaskBlock(Sorting::Block{}).has_correct_answers());
  EXPECT_TRUE(TaskBlock(Introduction::Block{}).has_correct_answers());
  EXPECT_FALSE(TaskBlock(Estimation::Block{}).has_correct_answers());
  EXPECT_FALSE(TaskBlock(Judgment::Block{}).has_correct_answers());
  EXPECT_FALSE(TaskBlock(Adjustment::Block{}).has_correct_answers());
  TrialRow row;
  row.plan.level_g = 100;
  row.outcome = "no_difference";
  EXPECT_EQ(Comparison::is_correct(row), false);
  row.outcome = "difference";
  EXPECT_EQ(Comparison::is_correct(row), true) << "\"different\"";
  row.chosen_slot = 1;
  row.choice_correct = false;
  EXPECT_EQ(Comparison::is_correct(row), false);
  row.plan.level_g = 0;
  EXPECT_FALSE(Comparison::is_correct(row));
  row.first_choice_s = row.validated_s = 3;
  EXPECT_EQ(Introduction::is_correct(row), true);
  row.validated_s = 4;
  EXPECT_EQ(Introduction::is_correct(row), false) << "not on the first try";
}

// Before sorting and comparisons, logged by a simulated participant.
TEST(Practice, IsReplayedAndLeftOutOfScores) {
  std::string text = read_text_file(source_folder() + "/protocols/quick.toml");
  for (const std::string kind : {"kind = \"sorting\"\n", "kind = \"comparison\"\n"})
    text.insert(text.find(kind), "practice = { trials = 2 }\n");
  const StoredSession stored(parse_protocol(text, "practiced.toml"), "simulated", 5);
  std::vector<std::string> tasks;
  for (const TrialRow& trial : stored.reader().trials(stored.id()))
    if (trial.plan.is_practice) tasks.push_back(trial.plan.task);
  EXPECT_THAT(tasks, ElementsAre("sorting", "sorting", "comparison", "comparison"));
  EXPECT_FALSE(verify_session(stored.reader(), stored.id(), [](double) {}).first);
  const Judgments judgments =
      judge_session(stored.reader(), stored.session(), {{Plug{"coin"}}, 4}, nullptr, [](double) {});
  EXPECT_EQ(std::ranges::count(judgments.left_out, is_practice, &LeftOutTrial::why), 4);
}

}  // namespace
}  // namespace heft
