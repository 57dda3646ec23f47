// Comparison blocks that mix all kinds of procedures and a library user's one. Answers, voids and
// vetoes are random; folding again gives the same session, and each procedure ends as it does
// alone.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>

#include "engine/Engine.h"
#include "experiment/Rows.h"
#include "psychophysics/BayesianKinds.h"
#include "psychophysics/Bisection.h"
#include "psychophysics/ProcedureKinds.h"
#include "tasks/Comparison.h"

namespace heft {
namespace {

template <typename Row>
std::string text_of(const Row& row) {
  std::string text;
  const auto add = [&](const auto& self, const auto& value) -> void {
    if constexpr (requires { value.has_value(); })
      value ? self(self, *value) : void(text += "-");
    else if constexpr (std::is_enum_v<std::decay_t<decltype(value)>>)
      text += name_of(value);
    else if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
      text += std::to_string(value);
    else
      text += value;
    text += ' ';
  };
  visit_cells(row, [&](const CellColumn&, const auto& value) { add(add, value); });
  return text;
}

Procedure any_procedure(const std::string& name) {
  const auto quarter = [](int from, int to) { return *rc::gen::inRange(from, to) / 4.0; };
  switch (*rc::gen::inRange(0, 5)) {
    case 0: {
      UpDownConfig config{.start = quarter(1, 2400), .step = quarter(1, 600), .halve_every = 2};
      config.floor = 0;
      if (*rc::gen::arbitrary<bool>()) config.ceiling = config.start + quarter(1, 400);
      config.down = *rc::gen::inRange(1, 3);
      config.stop_reversals = *rc::gen::inRange(3, 8);
      config.stop_trials = *rc::gen::inRange(1, 30);
      return {name, config};
    }
    case 1:
      return {name, ConstantConfig{.levels = {-5, 0, quarter(1, 400)},
                                   .n_per_level = *rc::gen::inRange(1, 5)}};
    case 2: {
      QuestConfig config{.guess = quarter(4, 800), .guess_sd = 80, .beta = 0.02, .grain = 1};
      config.floor = 0;
      config.stop_trials = *rc::gen::inRange(1, 30);
      return {name, config};
    }
    case 3: {
      PsiConfig config = test::heavier_at_200g(*rc::gen::inRange(1, 20));
      for (double& level : config.levels.values) level /= 18;  // from -10 g, for 15 g too
      config.nuisance.resize(static_cast<std::size_t>(*rc::gen::inRange(0, 3)));
      if (*rc::gen::arbitrary<bool>()) config.stop_ci_width = 60;
      return {name, config};
    }
    default:
      return {name, test::Bisection(0, quarter(40, 2000), 5)};
  }
}

Comparison::Block any_block() {
  Comparison::Block block;
  block.name = "comparison";
  const int n = *rc::gen::inRange(1, 5);
  for (int i = 0; i < n; ++i)
    block.staircases.push_back(
        {i % 2 ? 15.0 : 200.0, any_procedure(std::string("s") + std::to_string(i)), {}});
  block.interleaving = {
      *rc::gen::element(Interleave::random, Interleave::round_robin, Interleave::sequential),
      *rc::gen::inRange(0, 4)};
  block.sides = *rc::gen::element(Sides::random, Sides::balanced);
  if (*rc::gen::arbitrary<bool>())
    block.catch_fraction = *rc::gen::inRange(0, 5) / 10.0;
  else
    block.catch_trials = {{200, *rc::gen::inRange(0, 4)}};
  return block;
}

/// A session and its results as text.
struct Folded {
  Folded(const std::shared_ptr<const SessionPlan>& plan, std::uint64_t seed) : engine(plan, seed) {}

  /// Whether the event is accepted.
  bool does(const Event& event) {
    const Admission admission = engine.admit(event);
    if (!admission.admitted) return false;
    const Changes changes = engine.apply(*admission.admitted).changes.value();
    events.push_back(event);
    if (const auto& plan = engine.next().plan)
      trace += "next " + std::to_string(plan->trial_number) + " " + std::to_string(plan->attempt) +
               " " + plan->staircase + " " + std::to_string(plan->level_g.value_or(-1)) + " " +
               std::to_string(plan->reference_slot.value_or(0)) + "\n";
    if (changes.trial) trace += "trial " + text_of(*changes.trial) + "\n";
    for (const ReversalRow& row : changes.withdrawn_reversals)
      trace += "withdrawn " + text_of(row) + "\n";
    for (const EstimateRow& row : changes.withdrawn_estimates) {
      trace += "withdrawn " + text_of(row) + "\n";
      estimates.erase(row.staircase);
    }
    for (const ReversalRow& row : changes.reversals) trace += text_of(row) + "\n";
    for (const EstimateRow& row : changes.estimates)
      trace += estimates[row.staircase] = text_of(row) + "\n";
    return true;
  }

  Engine engine;
  std::vector<Event> events;
  std::string trace;
  std::map<std::string, std::string> estimates;  ///< by staircase
};

// Answers positively above the threshold.
Action answer(const TrialPlan& plan, double threshold_g) {
  if (plan.is_catch || *plan.level_g <= threshold_g) return {"no_difference", {}, {}};
  return {"select", plan.reference_slot == 1 ? 2 : 1, {}};
}

/// Runs to the end. For each answer `happens()` chooses 1: a void before it, 2: a veto after it,
/// otherwise nothing.
void run(Folded& session, double threshold_g, const auto& happens) {
  double t_s = session.engine.last_s();
  while (session.engine.next().kind == Next::Kind::trial) {
    session.does({t_s += 1, TrialStarted{}});
    session.does({t_s += 1, CubesShown{}});
    const int what = happens();
    if (what == 1) {
      session.does({t_s += 1, TrialVoided{"interrupted"}});
      continue;
    }
    RC_ASSERT(session.does({t_s += 1, answer(*session.engine.next().plan, threshold_g)}));
    if (what == 2) session.does({t_s += 0.1, AnswerVetoed{"by mistake"}});
  }
  RC_ASSERT(session.engine.next().kind == Next::Kind::finish);
}

RC_GTEST_PROP(MixedProcedures, FoldAgainToSameSession, (std::uint64_t seed)) {
  auto plan = std::make_shared<SessionPlan>();
  plan->blocks = {any_block()};
  const double threshold_g = *rc::gen::inRange(1, 400);
  Folded session(plan, seed);
  RandomStream chance(seed, "what happens");
  run(session, threshold_g, [&] { return static_cast<int>(chance.below(8)); });

  Folded again(plan, seed);
  for (const Event& event : session.events) RC_ASSERT(again.does(event));
  RC_ASSERT(again.trace == session.trace);

  // Voids and vetoes do not change the results of procedures.
  Folded quiet(plan, seed);
  run(quiet, threshold_g, [] { return 0; });
  RC_ASSERT(quiet.estimates == session.estimates);
  RC_ASSERT(quiet.estimates.size() ==
            block_as<Comparison::Block>(plan->blocks[0])->staircases.size());
}

RC_GTEST_PROP(MixedProcedures, ContinueAfterInterruption, (std::uint64_t seed)) {
  auto plan = std::make_shared<SessionPlan>();
  plan->blocks = {any_block()};
  const double threshold_g = *rc::gen::inRange(1, 400);
  Folded session(plan, seed);
  run(session, threshold_g, [] { return 0; });
  const auto n_kept = *rc::gen::inRange<std::size_t>(0, session.events.size());
  Folded resumed(plan, seed);
  for (std::size_t i = 0; i < n_kept; ++i) resumed.does(session.events[i]);
  if (resumed.engine.trial_is_open())
    resumed.does({resumed.engine.last_s() + 1, TrialVoided{"interrupted"}});
  run(resumed, threshold_g, [] { return 0; });
  RC_ASSERT(resumed.estimates == session.estimates);
}

TEST(MixedProcedures, OwnProceduresIntervalIsRecorded) {
  auto plan = std::make_shared<SessionPlan>();
  Comparison::Block block;
  block.name = "comparison";
  block.staircases = {{15, {"own", test::Bisection(0, 100, 25)}, {}}};
  plan->blocks = {block};
  Folded session(plan, 1);
  session.does({1, TrialStarted{}});
  session.does({2, CubesShown{}});
  session.does({3, answer(*session.engine.next().plan, 40)});
  session.does({4, TrialStarted{}});
  session.does({5, CubesShown{}});
  const TrialPlan open = *session.engine.next().plan;
  const auto row = session.engine.apply(Event{6, answer(open, 40)}).estimates.at(0);
  EXPECT_EQ(row.method, "bisection");
  EXPECT_EQ(row.jnd_g, 37.5);
  EXPECT_EQ(row.low_g, 25);
  EXPECT_EQ(row.high_g, 50);
  EXPECT_EQ(row.reason, StopReason::precision);
  EXPECT_EQ(row.n_trials, 2);
}

}  // namespace
}  // namespace heft
