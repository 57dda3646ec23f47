// The engine alone: no physics, no clock, no database.
#include "engine/Engine.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/Error.h"
#include "base/Random.h"
#include "engine/Plans.h"
#include "psychophysics/ProcedureKinds.h"
#include "tasks/Offers.h"

namespace heft {
namespace {

using ::testing::HasSubstr;
using ::testing::Optional;
using testing::shared;
using testing::small_plan;

Event action(double t_s, ActionKind kind, std::optional<int> slot = {},
             std::optional<Label> label = {}) {
  return {t_s, Action{std::move(kind), slot, std::move(label)}};
}

// Drives an engine as the runner does, one event per second.
struct Session {
  explicit Session(SessionPlan session_plan = small_plan(), std::uint64_t seed = 7)
      : engine(shared(std::move(session_plan)), seed) {}

  Changes does(EventPayload what) { return engine.apply({++t_s, std::move(what)}); }
  Changes acts(ActionKind kind, std::optional<int> slot = {}, std::optional<Label> label = {}) {
    return engine.apply(action(++t_s, std::move(kind), slot, std::move(label)));
  }
  std::string refusal(ActionKind kind, std::optional<int> slot = {},
                      std::optional<Label> label = {}) {
    return engine.admit(action(t_s + 1, std::move(kind), slot, std::move(label))).refusal;
  }
  TrialPlan start() {
    does(TrialStarted{});
    does(CubesShown{});
    return *engine.next().plan;
  }
  int slot_of(double mass_g) const {
    const auto& masses_g = engine.next().plan->masses_g;
    return static_cast<int>(std::ranges::find(masses_g, mass_g) - masses_g.begin()) + 1;
  }
  Changes touches(int slot, double seconds) {
    engine.apply({++t_s, CubeTouch{slot, std::nullopt}});
    return engine.apply({++t_s, CubeTouch{slot, seconds}});
  }
  CubeRow pushes(int slot, double max_push_displacement_m, double peak_lag_m) {
    engine.apply({++t_s, CubeTouch{slot}});
    return engine.apply({++t_s, CubeTouch{slot, 1, max_push_displacement_m, peak_lag_m}})
        .cubes.at(0);
  }
  // Everything before the first sorting trial.
  void reach_sorting() {
    does(DemonstrationShown{});
    start();
    acts("select", slot_of(800));
  }
  void reach_comparison() {
    reach_sorting();
    while (engine.next().plan->task == "sorting") {
      start();
      acts("dont_know");
    }
  }

  Engine engine;
  double t_s = 0;
};

TEST(Engine, RunsBlocksInOrder) {
  Session session;
  EXPECT_EQ(session.engine.next().kind, Next::Kind::demonstration);
  session.does(DemonstrationShown{});
  EXPECT_EQ(session.engine.next().kind, Next::Kind::trial);
  EXPECT_EQ(session.engine.next().plan->task, "introduction");
  EXPECT_EQ(session.engine.next().plan->condition, "C2");
  session.start();
  session.acts("select", session.slot_of(800));
  for (int n = 2; n <= 5; ++n) {
    EXPECT_EQ(session.engine.next().plan->task, "sorting");
    EXPECT_EQ(session.engine.next().plan->trial_number, n);
    EXPECT_FALSE(session.engine.next().rest);
    session.start();
    session.acts("dont_know");
  }
  ASSERT_TRUE(session.engine.next().rest);
  EXPECT_EQ(session.engine.next().rest->name, "break");
  EXPECT_EQ(session.engine.next().plan->task, "comparison");
  session.start();
  EXPECT_FALSE(session.engine.next().rest) << "a break is never inside a trial";
}

TEST(Engine, IntroductionEndsWithCorrectAnswer) {
  Session session;
  session.does(DemonstrationShown{});
  session.start();
  const Changes wrong = session.acts("select", session.slot_of(15));
  EXPECT_EQ(wrong.trial->status, TrialStatus::open);
  EXPECT_EQ(wrong.answers.size(), 1u);
  EXPECT_TRUE(session.engine.screen().try_again);
  EXPECT_THAT(session.refusal("dont_know"), HasSubstr("introduction"));
  const Changes right = session.acts("select", session.slot_of(800));
  EXPECT_EQ(right.trial->status, TrialStatus::completed);
  EXPECT_EQ(right.trial->outcome, "correct");
  EXPECT_EQ(session.engine.next().plan->task, "sorting");
}

TEST(Engine, ReshufflesAfterWrongIntroduction) {
  SessionPlan session_plan = small_plan();
  block_as<Introduction::Block>(session_plan.blocks[1])->wrong_answer = WrongAnswer::reshuffle;
  int moved = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Session session(session_plan, seed);
    session.does(DemonstrationShown{});
    const TrialPlan before = session.start();
    session.acts("select", session.slot_of(15));
    EXPECT_EQ(session.engine.next().plan->n_reshuffles, 1);
    EXPECT_THAT(session.refusal("select", 1), HasSubstr("not shown yet"));
    session.does(CubesShown{});
    if (session.engine.next().plan->masses_g != before.masses_g) ++moved;
  }
  EXPECT_GT(moved, 8);
  EXPECT_LT(moved, 32);
}

TEST(Engine, LabelsAreExclusiveAndCorrectable) {
  Session session;
  session.reach_sorting();
  session.start();
  session.acts("label", 1, "heaviest");
  session.acts("label", 2, "heaviest");
  EXPECT_EQ(labels_on(session.engine.screen())[0], std::nullopt) << "a used label moves";
  EXPECT_EQ(labels_on(session.engine.screen())[1], "heaviest");
  session.acts("label", 2, "lightest");
  EXPECT_EQ(labels_on(session.engine.screen())[1], "lightest");
  session.acts("unlabel", 2);
  EXPECT_EQ(labels_on(session.engine.screen())[1], std::nullopt);
  EXPECT_THAT(session.refusal("unlabel", 2), HasSubstr("no label"));
  EXPECT_THAT(session.refusal("select", 2), HasSubstr("no action \"select\""));
  EXPECT_THAT(session.refusal("label", 4, "lightest"), HasSubstr("no cube 4"));
  EXPECT_THAT(session.refusal("label", 1), HasSubstr("has no label"));
}

TEST(Engine, RefusesValidateWithoutAllLabels) {
  Session session;
  session.reach_sorting();
  session.start();
  EXPECT_THAT(session.refusal("validate"), HasSubstr("not all cubes"));
  session.acts("label", session.slot_of(15), "lightest");
  session.acts("label", session.slot_of(200), "intermediate");
  EXPECT_FALSE(session.engine.screen().can_validate);
  EXPECT_THAT(session.refusal("validate"), HasSubstr("not all cubes"));
  session.acts("label", session.slot_of(800), "heaviest");
  EXPECT_TRUE(session.engine.screen().can_validate);
  const Changes done = session.acts("validate");
  EXPECT_EQ(done.trial->outcome, "correct");
  EXPECT_EQ(done.trial->validated_s, session.t_s);
}

TEST(Engine, SwappedPairIsIncorrectAndDontKnowIsKept) {
  Session session;
  session.reach_sorting();
  session.start();
  session.acts("label", session.slot_of(15), "intermediate");
  session.acts("label", session.slot_of(200), "lightest");
  session.acts("label", session.slot_of(800), "heaviest");
  EXPECT_EQ(session.acts("validate").trial->outcome, "incorrect");
  session.start();
  EXPECT_EQ(session.acts("dont_know").trial->outcome, "dont_know");
}

TEST(Engine, SelectEndsComparisonAndUpdatesStaircase) {
  Session session;
  session.reach_comparison();
  const TrialPlan plan = session.start();
  EXPECT_DOUBLE_EQ(plan.masses_g[*plan.reference_slot == 1 ? 0 : 1], *plan.reference_g);
  const int lighter = *plan.reference_slot;
  const Changes done = session.acts("select", lighter);
  EXPECT_EQ(done.trial->outcome, "difference");
  EXPECT_EQ(done.trial->choice_correct, false);
  EXPECT_EQ(done.trial->chosen_slot, lighter);
  // Any choice is positive by the paper's rule, so the staircase moves down.
  for (;;) {
    const TrialPlan next = session.start();
    if (next.staircase == plan.staircase) {
      EXPECT_LT(*next.level_g, *plan.level_g);
      break;
    }
    session.acts("no_difference");
  }
}

TEST(Engine, RunsBothStaircasesToEstimates) {
  Session session;
  session.reach_comparison();
  std::vector<EstimateRow> estimates;
  std::vector<ReversalRow> reversals;
  int n = 0;
  while (session.engine.next().kind == Next::Kind::trial) {
    session.start();
    const bool alike = ++n % 3 == 0;
    const Changes done = alike ? session.acts("no_difference") : session.acts("select", 1);
    estimates.insert(estimates.end(), done.estimates.begin(), done.estimates.end());
    reversals.insert(reversals.end(), done.reversals.begin(), done.reversals.end());
  }
  ASSERT_EQ(estimates.size(), 2u);
  for (const EstimateRow& estimate : estimates) {
    if (estimate.reason != StopReason::reversals) continue;
    double sum = 0;
    for (const ReversalRow& reversal : reversals)
      if (reversal.staircase == estimate.staircase && reversal.number > 2) sum += reversal.level_g;
    EXPECT_DOUBLE_EQ(*estimate.jnd_g, sum / (estimate.n_reversals - 2));
  }
  EXPECT_EQ(session.engine.next().kind, Next::Kind::finish);
  EXPECT_EQ(session.does(SessionEnded{}).state, SessionState::finished);
  EXPECT_EQ(session.engine.next().kind, Next::Kind::over);
}

TEST(Engine, VoidRepeatsTrialAndKeepsStaircase) {
  int moved = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Session session(small_plan(), seed);
    session.reach_comparison();
    const TrialPlan before = session.start();
    const Changes voided = session.does(TrialVoided{"veto"});
    EXPECT_EQ(voided.trial->status, TrialStatus::voided);
    EXPECT_THAT(voided.trial->void_reason, Optional(std::string("veto")));
    EXPECT_TRUE(voided.reversals.empty());
    const TrialPlan after = *session.engine.next().plan;
    EXPECT_EQ(after.attempt, 2);
    EXPECT_EQ(after.trial_number, before.trial_number);
    EXPECT_EQ(after.staircase, before.staircase);
    EXPECT_EQ(after.level_g, before.level_g);
    if (after.reference_slot != before.reference_slot) ++moved;
  }
  EXPECT_GT(moved, 8);
  EXPECT_LT(moved, 32);
}

TEST(Engine, CrashRepeatsAttemptWithSameDraws) {
  Session session;
  session.reach_sorting();
  const TrialPlan before = session.start();
  session.acts("label", 1, "heaviest");
  session.does(TrialVoided{"interrupted"});
  session.does(SessionResumed{});
  const TrialPlan after = *session.engine.next().plan;
  EXPECT_EQ(after.attempt, before.attempt);
  EXPECT_EQ(after.masses_g, before.masses_g);
  session.start();
  EXPECT_EQ(labels_on(session.engine.screen())[0], std::nullopt) << "labels start anew";
}

TEST(Engine, ThreeVoidsWithoutCrashesPauseSession) {
  Session session;
  session.reach_sorting();
  for (int crash = 0; crash < 5; ++crash) {
    session.start();
    session.does(TrialVoided{"interrupted"});
  }
  EXPECT_EQ(session.engine.state(), SessionState::running);
  for (int i = 0; i < max_voids; ++i) {
    session.start();
    const Changes voided = session.does(TrialVoided{"camera_lost"});
    EXPECT_EQ(voided.state.has_value(), i + 1 == max_voids);
  }
  EXPECT_EQ(session.engine.next().kind, Next::Kind::paused);
  EXPECT_TRUE(session.engine.needs_experimenter());
  session.does(SessionContinued{});
  EXPECT_EQ(session.engine.next().plan->attempt, 4);
}

TEST(Engine, RefusesAnswersWhilePausedAndBeforeCubes) {
  Session session;
  session.reach_sorting();
  session.does(TrialStarted{});
  EXPECT_THAT(session.refusal("dont_know"), HasSubstr("not shown yet"));
  session.does(CubesShown{});
  session.does(SessionPaused{"camera_lost"});
  EXPECT_EQ(session.engine.screen().screen, Screen::paused);
  EXPECT_THAT(session.refusal("dont_know"), HasSubstr("paused"));
  session.does(SessionContinued{});
  EXPECT_EQ(session.refusal("dont_know"), "");
}

TEST(Engine, AccountsForTimeAndContacts) {
  Session session;
  session.reach_sorting();
  session.start();  // shown at t
  const double shown_s = session.t_s;
  session.touches(2, 0.75);                        // began t+1, ended t+2
  session.touches(2, 0.5);                         // t+3, t+4
  session.does(EffectorLost{});                    // t+5
  session.does(SessionPaused{"camera_lost"});      // t+6: lost for 1 s
  session.does(SessionContinued{});                // t+7: paused for 1 s
  session.does(EffectorFound{});                   // t+8: lost for 1 s more
  const Changes done = session.acts("dont_know");  // t+9
  const TrialRow& row = *done.trial;
  EXPECT_EQ(row.shown_s, shown_s);
  EXPECT_EQ(row.first_contact_s, shown_s + 1);
  EXPECT_EQ(row.first_choice_s, shown_s + 9);
  EXPECT_EQ(row.lost_s, 2);
  EXPECT_EQ(row.paused_s, 1);
}

TEST(Engine, IgnoresPausesBeforeCubes) {
  Session session;
  session.reach_sorting();
  session.does(TrialStarted{});
  session.does(SessionPaused{"camera_lost"});
  session.does(SessionContinued{});
  session.does(EffectorLost{});
  session.does(EffectorFound{});
  session.does(CubesShown{});
  const Changes done = session.acts("dont_know");
  EXPECT_EQ(done.trial->paused_s, 0);
  EXPECT_EQ(done.trial->lost_s, 0);
}

TEST(Engine, CountsResetsOfOneOrAllCubes) {
  SessionPlan session_plan = small_plan();
  block_as<Introduction::Block>(session_plan.blocks[1])->wrong_answer = WrongAnswer::reshuffle;
  Session session(session_plan);
  session.does(DemonstrationShown{});
  session.start();
  const auto resets = [](const Changes& changes) {
    std::vector<int> n;
    for (const CubeRow& cube : changes.cubes) n.push_back(cube.n_resets);
    return n;
  };
  EXPECT_EQ(resets(session.does(CubesReset{2})), (std::vector{0, 1}));
  EXPECT_EQ(resets(session.does(CubesReset{})), (std::vector{1, 2}));
  const Changes reshuffled = session.acts("select", session.slot_of(15));
  EXPECT_EQ(resets(reshuffled), (std::vector{1, 2})) << "the slots keep their counts";
  session.does(CubesShown{});
  EXPECT_TRUE(session.acts("select", session.slot_of(800)).cubes.empty())
      << "an answer that moves no cube reports none";
}

TEST(Engine, CountsPushesPerCube) {
  Session session;
  session.reach_sorting();
  session.start();
  session.touches(2, 0.75);
  const double began_s = session.t_s + 1;
  const CubeRow cube = session.touches(2, 0.5).cubes.at(0);
  EXPECT_EQ(cube.slot, 2);
  EXPECT_EQ(cube.n_pushes, 2);
  EXPECT_EQ(cube.contact_s, 1.25);
  EXPECT_EQ(cube.last_contact_s, began_s + 0.5);
}

TEST(Engine, KeepsMaximumPushAndLagOfEachCube) {
  Session session;
  session.reach_sorting();
  session.start();
  session.pushes(2, 0.03, 0.001);
  session.pushes(1, 0.05, 0.04);
  const CubeRow cube = session.pushes(2, 0.02, 0.01);
  EXPECT_EQ(cube.max_push_displacement_m, 0.03);
  EXPECT_EQ(cube.peak_lag_m, 0.01);
  EXPECT_EQ(session.touches(2, 0.5).cubes.at(0).peak_lag_m, 0.01) << "a touch without a lag";
}

TEST(Engine, RecordsDrawnParametersOnce) {
  Session session;
  SessionConfig setup;
  const auto told = [&] { return session.engine.apply({++session.t_s, setup}).parameters; };
  EXPECT_TRUE(told().empty());
  setup.participant_parameters = {{"hold_s", 0.3}, {"p", 0.5}};
  const auto drawn = told();
  ASSERT_EQ(drawn.size(), 2u);
  EXPECT_EQ(drawn[0].name, "hold_s");
  EXPECT_EQ(drawn[0].setup_index, 2);
  setup.view = {"window"};
  EXPECT_TRUE(told().empty());
  setup.participant_parameters["p"] = 0.6;
  EXPECT_EQ(told().size(), 2u);
}

TEST(Engine, RequiresContactWithEveryCube) {
  SessionPlan session_plan = small_plan();
  session_plan.require_contact = true;
  Session session(session_plan);
  session.does(DemonstrationShown{});
  session.start();
  EXPECT_THAT(session.refusal("select", 1), HasSubstr("touched"));
  session.touches(1, 0.1);
  EXPECT_FALSE(session.engine.screen().can_answer);
  session.touches(2, 0.1);
  EXPECT_TRUE(session.engine.screen().can_answer);
  EXPECT_EQ(session.refusal("select", 1), "");
}

TEST(Engine, CatchTrialsHaveEqualMassesAndNoStaircase) {
  SessionPlan session_plan = small_plan();
  block_as<Comparison::Block>(session_plan.blocks[4])->catch_fraction = 0.5;
  Session session(session_plan);
  session.reach_comparison();
  int n_catch = 0, n = 0;
  while (session.engine.next().kind == Next::Kind::trial) {
    const TrialPlan plan = session.start();
    const Changes done = session.acts("select", 1);
    ++n;
    if (!plan.is_catch) continue;
    ++n_catch;
    EXPECT_EQ(plan.staircase, "");
    EXPECT_EQ(plan.masses_g[0], plan.masses_g[1]);
    EXPECT_EQ(done.trial->choice_correct, std::nullopt);
    EXPECT_TRUE(done.reversals.empty() && done.estimates.empty());
  }
  EXPECT_GT(n_catch, n / 4);
}

// The trials of a comparison block with random answers; some attempts are void.
std::vector<TrialPlan> plans_of(const SessionPlan& session_plan, std::uint64_t seed) {
  Session session(session_plan, seed);
  session.reach_comparison();
  RandomStream answers(seed, "answers");
  std::vector<TrialPlan> plans;
  while (session.engine.next().kind == Next::Kind::trial) {
    plans.push_back(session.start());
    session.acts("select", answers.coin(0.5) ? 1 : 2);
  }
  return plans;
}

TEST(Engine, FixedCatchTrialsComeAsPlanned) {
  SessionPlan session_plan = small_plan();
  auto& block = *block_as<Comparison::Block>(session_plan.blocks[4]);
  block.catch_every = 5;
  block.sides = Sides::balanced;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    block.catch_trials = {{15, 4}, {200, static_cast<int>(seed) % 7}};
    const std::vector<TrialPlan> plans = plans_of(session_plan, seed);
    std::map<double, int> caught;
    int n_caught = 0;
    std::map<std::string, std::vector<int>> slots;
    for (std::size_t i = 0; i < plans.size(); ++i) {
      const TrialPlan& plan = plans[i];
      slots[plan.staircase].push_back(*plan.reference_slot);
      if (!plan.is_catch) continue;
      EXPECT_GE(i, 3U) << seed;
      EXPECT_EQ(plan.masses_g[0], plan.masses_g[1]);
      ++caught[*plan.reference_g];
      ++n_caught;
    }
    EXPECT_EQ(caught[15], 4) << seed;
    EXPECT_EQ(caught[200], static_cast<int>(seed) % 7) << seed;
    // One in every five trials, until the last staircase ends.
    std::size_t n = plans.size();
    while (plans[n - 1].is_catch) --n;
    for (std::size_t from = 0; from + 5 <= n && static_cast<int>(from) / 5 < n_caught; from += 5)
      EXPECT_EQ(std::count_if(plans.begin() + static_cast<std::ptrdiff_t>(from),
                              plans.begin() + static_cast<std::ptrdiff_t>(from) + 5,
                              [](const auto& p) { return p.is_catch; }),
                1)
          << seed << " " << from;
    for (const auto& [staircase, of_it] : slots)
      for (std::size_t from = 0; from + 4 <= of_it.size(); from += 4)
        EXPECT_EQ(std::count(of_it.begin() + static_cast<std::ptrdiff_t>(from),
                             of_it.begin() + static_cast<std::ptrdiff_t>(from) + 4, 1),
                  2)
            << seed << " " << staircase;
  }
}

Procedure constant(const std::string& name) {
  return {name, ConstantConfig{.levels = {-10, 0, 20, 80}, .n_per_level = 3}};
}

SessionPlan constant_plan() {
  SessionPlan session_plan = small_plan();
  auto& block = *block_as<Comparison::Block>(session_plan.blocks[4]);
  block.staircases = {{15, constant("constant")}, {200, testing::staircase("200g", 600, 150)}};
  session_plan.blocks = {block};
  return session_plan;
}

TEST(Engine, ConstantStimuliRunBesideStaircaseWithoutJnd) {
  Session session(constant_plan());
  std::map<double, int> counts;
  std::vector<EstimateRow> estimates;
  while (session.engine.next().kind == Next::Kind::trial) {
    const TrialPlan plan = session.start();
    const Changes done = session.acts("select", 1);
    if (plan.staircase == "constant") {
      ++counts[*plan.level_g];
      EXPECT_DOUBLE_EQ(plan.masses_g[0] + plan.masses_g[1], 30 + *plan.level_g);
      EXPECT_TRUE(done.reversals.empty());
    }
    estimates.insert(estimates.end(), done.estimates.begin(), done.estimates.end());
  }
  EXPECT_EQ(counts, (std::map<double, int>{{-10, 3}, {0, 3}, {20, 3}, {80, 3}}));
  ASSERT_EQ(estimates.size(), 2u);
  const auto row = std::ranges::find(estimates, "constant", &EstimateRow::staircase);
  ASSERT_NE(row, estimates.end());
  EXPECT_EQ(row->method, "constant");
  EXPECT_EQ(row->reason, StopReason::trials);
  EXPECT_EQ(row->jnd_g, std::nullopt);
  EXPECT_EQ(row->n_trials, 12);
  EXPECT_EQ(session.engine.next().kind, Next::Kind::finish);
}

// (staircase, level) of every completed trial; voids attempts as `vetoed` requires.
std::vector<std::pair<std::string, double>> course(std::uint64_t seed, auto vetoed) {
  Session session(constant_plan(), seed);
  std::vector<std::pair<std::string, double>> course;
  for (int n = 0; session.engine.next().kind == Next::Kind::trial; ++n) {
    const TrialPlan plan = session.start();
    if (plan.attempt <= 2 && vetoed(n)) {
      session.does(TrialVoided{n % 2 ? "veto" : "interrupted"});
      continue;
    }
    session.acts("no_difference");
    course.emplace_back(plan.staircase, *plan.level_g);
  }
  return course;
}

TEST(Engine, VoidTrialsConsumeNoConstantLevel) {
  const auto whole = course(7, [](int) { return false; });
  EXPECT_EQ(course(7, [](int n) { return n % 3 == 0; }), whole);
  EXPECT_NE(course(8, [](int) { return false; }), whole);
}

// Two trials with equal answers: the second level shows whether the first was positive.
TEST(Engine, BlocksRuleDefinesPositiveAnswers) {
  for (const PositiveAnswer rule : {PositiveAnswer::any_choice, PositiveAnswer::correct_choice})
    for (const bool choose_reference : {false, true}) {
      SessionPlan session_plan = small_plan();
      auto& block = *block_as<Comparison::Block>(session_plan.blocks.back());
      block.positive_answer = rule;
      block.staircases.pop_back();
      Session session(session_plan);
      session.reach_comparison();
      const TrialPlan plan = session.start();
      const int comparison = 3 - *plan.reference_slot;
      session.acts("select", choose_reference ? *plan.reference_slot : comparison);
      const bool positive = rule == PositiveAnswer::any_choice || !choose_reference;
      const double step_g = *session.engine.next().plan->level_g - *plan.level_g;
      EXPECT_EQ(step_g < 0, positive) << name_of(rule) << choose_reference;
    }
}

TEST(Engine, SortingBlocksHavePlannedConditionsAndRuns) {
  SessionPlan session_plan = small_plan();
  auto& block = *block_as<Sorting::Block>(session_plan.blocks[2]);
  block.trials = {{"C1", 5}, {"C2", 5}};
  block.max_run = 2;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Session session(session_plan, seed);
    session.reach_sorting();
    int n_c1 = 0, run = 0;
    std::optional<std::string> last;
    while (session.engine.next().plan->task == "sorting") {
      const TrialPlan plan = session.start();
      if (plan.condition == "C1") ++n_c1;
      run = plan.condition == last ? run + 1 : 1;
      last = plan.condition;
      EXPECT_LE(run, 2);
      session.acts("dont_know");
    }
    EXPECT_EQ(n_c1, 5);
  }
}

TEST(Engine, BalancedOrdersUseEachOrderOncePerRound) {
  SessionPlan session_plan = small_plan();
  auto& block = *block_as<Sorting::Block>(session_plan.blocks[2]);
  constexpr std::ptrdiff_t orders_of_three_cubes = 6;
  block.trials = {{"C1", 2 * orders_of_three_cubes}, {"C2", 2 * orders_of_three_cubes}};
  block.orders = SortingOrders::balanced;
  Session session(session_plan);
  session.reach_sorting();
  std::map<std::string, std::vector<std::vector<double>>> orders;
  while (session.engine.next().plan->task == "sorting") {
    const TrialPlan plan = session.start();
    orders[plan.condition].push_back(plan.masses_g);
    session.acts("dont_know");
  }
  for (const std::string condition : {"C1", "C2"}) {
    const auto& shown = orders[condition];
    ASSERT_THAT(shown, ::testing::SizeIs(2 * orders_of_three_cubes));
    for (const auto round : {shown.begin(), shown.begin() + orders_of_three_cubes})
      EXPECT_EQ(std::set(round, round + orders_of_three_cubes).size(), 6u) << condition;
  }
}

TEST(Engine, InvalidEventThrowsAndChangesNothing) {
  Session session;
  EXPECT_THROW(session.engine.apply(Event{1, TrialStarted{}}), Error);
  EXPECT_EQ(session.engine.n_events(), 0);
  session.does(DemonstrationShown{});
  EXPECT_THAT(session.engine.admit(Event{0.5, TrialStarted{}}).refusal, HasSubstr("is before"));
  EXPECT_THAT(session.engine.admit(Event{5, SessionEnded{}}).refusal,
              HasSubstr("not all blocks are completed"));
}

// Random events at random times: most are refused, none breaks the engine.
Event random_event(RandomStream& stream, double t_s) {
  const int slot = static_cast<int>(stream.below(5));
  const auto some_slot = stream.coin(0.7) ? std::optional(slot) : std::nullopt;
  const auto label =
      stream.coin(0.5) ? std::optional(Label(Sorting::labels.at(stream.below(9)))) : std::nullopt;
  const auto value = stream.coin(0.5) ? std::optional(stream.uniform() * 2 - 0.5) : std::nullopt;
  static const auto kinds = words_of<ActionKind>();
  const std::vector<EventPayload> all{
      TrialStarted{},
      Action{ActionKind(kinds.at(stream.below(kinds.size()))), some_slot, label},
      TrialVoided{stream.coin(0.5) ? "camera_lost" : std::string(void_interrupted)},
      TrialVoided{},
      SessionPaused{"why"},
      SessionContinued{},
      CubesReset{some_slot},
      DemonstrationShown{},
      SessionResumed{},
      SessionEnded{static_cast<Ending>(stream.below(2))},
      SessionConfig{},
      CubesShown{},
      CubeTouch{slot, value},
      EffectorLost{},
      EffectorFound{},
      Note{"a note"},
      BreakTaken{}};
  return {t_s, all[stream.below(all.size())]};
}

// A likely event, so that random sequences make progress.
Event likely_event(const Engine& engine, RandomStream& stream, double t_s) {
  switch (engine.next().kind) {
    case Next::Kind::demonstration:
      return Event{t_s, DemonstrationShown{}};
    case Next::Kind::trial:
      return Event{t_s, TrialStarted{}};
    case Next::Kind::paused:
      return Event{t_s, SessionContinued{}};
    case Next::Kind::act:
      if (!engine.screen().can_answer) return Event{t_s, CubesShown{}};
      if (engine.next().plan->task != "sorting" && stream.coin(0.6))
        return action(t_s, "select", static_cast<int>(stream.below(2)) + 1);
      return action(t_s, engine.next().plan->task == "sorting" ? "dont_know" : "no_difference");
    default:
      return Event{t_s, SessionEnded{}};
  }
}

RC_GTEST_PROP(EngineProperty, RandomEventsKeepInvariants, (std::uint64_t seed)) {
  RandomStream stream(seed, "events");
  Engine engine(shared(small_plan()), seed);
  std::vector<Event> folded;
  std::map<int, TrialStatus> status;
  std::map<std::string, int> n_reversals;
  double t_s = 0;
  for (int i = 0; i < 400 && engine.next().kind != Next::Kind::over; ++i) {
    t_s += stream.uniform();
    const Event next =
        stream.coin(0.6) ? likely_event(engine, stream, t_s) : random_event(stream, t_s);
    const int n_before = engine.n_events();
    if (!engine.admit(next).admitted) {
      RC_ASSERT_THROWS_AS(engine.apply(next), Error);
      RC_ASSERT(engine.n_events() == n_before);
      continue;
    }
    const Changes changes = engine.apply(next);
    folded.push_back(next);
    if (changes.trial) {
      const int index = changes.trial->attempt_index;
      RC_ASSERT(status[index] == TrialStatus::open);  // a closed trial never changes again
      status[index] = changes.trial->status;
      RC_ASSERT(changes.trial->outcome.has_value() ==
                (changes.trial->status == TrialStatus::completed));
      RC_ASSERT(changes.trial->paused_s >= 0 && changes.trial->lost_s >= 0);
    }
    for (const ReversalRow& row : changes.reversals)
      RC_ASSERT(row.number == ++n_reversals[row.staircase]);
    const auto labels = labels_on(engine.screen());
    for (std::size_t a = 0; a < labels.size(); ++a)
      for (std::size_t b = a + 1; b < labels.size(); ++b)
        RC_ASSERT(!labels[a] || labels[a] != labels[b]);
  }
  // The same events fold to the same state.
  Engine again(shared(small_plan()), seed);
  for (const Event& e : folded) again.apply(e);
  RC_ASSERT(again.n_completed() == engine.n_completed());
  RC_ASSERT(again.next().kind == engine.next().kind);
  RC_ASSERT(again.next().plan.has_value() == engine.next().plan.has_value());
  if (again.next().plan) RC_ASSERT(again.next().plan->masses_g == engine.next().plan->masses_g);
}

}  // namespace
}  // namespace heft
