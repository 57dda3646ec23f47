// Selection of the next staircase: order, random draws, lag.
#include "psychophysics/Interleaving.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "psychophysics/Staircases.h"
#include "psychophysics/UpDown.h"

namespace heft {
namespace {

using testing::ElementsAre;

/// Staircases that end after the given numbers of trials.
std::vector<Procedure> staircases_of(std::initializer_list<int> lengths) {
  std::vector<Procedure> staircases;
  for (int length : lengths)
    staircases.emplace_back("s", UpDownConfig{.start = 10, .step = 1, .stop_trials = length});
  return staircases;
}

/// Runs all staircases to their end, one stream a trial.
std::vector<std::size_t> order_of(std::vector<Procedure> staircases, const InterleaveConfig& config,
                                  std::uint64_t seed = 1) {
  std::vector<std::size_t> order;
  std::optional<std::size_t> previous;
  for (std::uint64_t trial = 1;; ++trial) {
    RandomStream stream(seed, "interleave", trial);
    const auto next = next_staircase(staircases, config, previous, stream);
    if (!next) return order;
    staircases[*next].respond({true}, 10);
    order.push_back(*next);
    previous = next;
  }
}

TEST(Interleaving, NothingIsNextWhenAllAreFinished) {
  EXPECT_TRUE(order_of({}, {}).empty());
  EXPECT_THAT(order_of(staircases_of({1}), {}), ElementsAre(0));
}

TEST(Interleaving, RoundRobinTakesTheUnfinishedInFileOrder) {
  EXPECT_THAT(order_of(staircases_of({2, 1, 3}), {.interleave = Interleave::round_robin}),
              ElementsAre(0, 1, 2, 0, 2, 2));
}

TEST(Interleaving, RoundRobinContinuesAfterTheLastCompletedTrial) {
  const auto staircases = staircases_of({5, 5, 5});
  RandomStream stream(1, "unused");
  const InterleaveConfig config{.interleave = Interleave::round_robin};
  EXPECT_EQ(next_staircase(staircases, config, 1, stream), 2);
  EXPECT_EQ(next_staircase(staircases, config, 1, stream), 2);  // after a void: the same again
  EXPECT_EQ(next_staircase(staircases, config, 2, stream), 0);
}

TEST(Interleaving, SequentialFinishesOneFirst) {
  EXPECT_THAT(order_of(staircases_of({2, 3, 1}), {.interleave = Interleave::sequential}),
              ElementsAre(0, 0, 1, 1, 1, 2));
}

TEST(Interleaving, SequentialContinuesWhereTheLagHoldsOneBack) {
  EXPECT_THAT(order_of(staircases_of({3, 3}), {.interleave = Interleave::sequential, .max_lag = 2}),
              ElementsAre(0, 0, 1, 0, 1, 1));
}

TEST(Interleaving, DrawsNothingWhereThereIsNoChoice) {
  auto staircases = staircases_of({1, 1});
  staircases[0].respond({true}, 10);
  RandomStream stream(7, "interleave"), untouched(7, "interleave");
  EXPECT_EQ(next_staircase(staircases, {}, std::nullopt, stream), 1);
  EXPECT_EQ(stream.bits(), untouched.bits());
}

TEST(Interleaving, SameSeedSameOrder) {
  const auto staircases = staircases_of({20, 20, 20});
  EXPECT_EQ(order_of(staircases, {}, 42), order_of(staircases, {}, 42));
  EXPECT_NE(order_of(staircases, {}, 42), order_of(staircases, {}, 43));
}

double chi_square(const std::vector<int>& counts, double expected) {
  double sum = 0;
  for (int count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
}

// 13.8 is the 99.9 % point of chi-square with 2 degrees of freedom; the seed is fixed.
TEST(Interleaving, RandomIsUniformAmongTheUnfinished) {
  auto staircases = staircases_of({100, 1, 100, 100});
  staircases[1].respond({true}, 10);
  std::vector<int> counts(4);
  constexpr int n_draws = 30000;
  for (std::uint64_t trial = 1; trial <= n_draws; ++trial) {
    RandomStream stream(2024, "interleave", trial);
    ++counts[*next_staircase(staircases, {}, std::nullopt, stream)];
  }
  EXPECT_EQ(counts[1], 0);
  EXPECT_LT(chi_square({counts[0], counts[2], counts[3]}, n_draws / 3.0), 13.8);
}

// 26.1 is the 99.9 % point with 8 degrees of freedom: successive draws don't depend on each other.
TEST(Interleaving, RandomDrawsAreIndependentOfTheLastOne) {
  const auto staircases = staircases_of({100, 100, 100});
  std::vector<int> pairs(9);
  std::size_t last = 0;
  constexpr int n_draws = 30000;
  for (std::uint64_t trial = 1; trial <= n_draws; ++trial) {
    RandomStream stream(2025, "interleave", trial);
    const std::size_t next = *next_staircase(staircases, {}, last, stream);
    ++pairs[3 * last + next];
    last = next;
  }
  EXPECT_LT(chi_square(pairs, n_draws / 9.0), 26.1);
}

RC_GTEST_PROP(InterleavingProperty, EveryStaircaseRunsToItsOwnEnd, ()) {
  const InterleaveConfig config{
      *rc::gen::element(Interleave::random, Interleave::round_robin, Interleave::sequential),
      *rc::gen::inRange(0, 5)};
  const auto lengths = *rc::gen::container<std::vector<int>>(3, rc::gen::inRange(1, 30));
  const auto order = order_of(staircases_of({lengths[0], lengths[1], lengths[2]}), config,
                              *rc::gen::arbitrary<std::uint64_t>());
  for (std::size_t i = 0; i < 3; ++i)
    RC_ASSERT(std::count(order.begin(), order.end(), i) == lengths[i]);
}

RC_GTEST_PROP(InterleavingProperty, NoStaircaseGetsFurtherAheadThanTheLag, ()) {
  const int max_lag = *rc::gen::inRange(1, 6);
  const auto interleave =
      *rc::gen::element(Interleave::random, Interleave::round_robin, Interleave::sequential);
  const std::vector<int> lengths =
      *rc::gen::container<std::vector<int>>(4, rc::gen::inRange(1, 30));
  const auto order = order_of(staircases_of({lengths[0], lengths[1], lengths[2], lengths[3]}),
                              {interleave, max_lag}, *rc::gen::arbitrary<std::uint64_t>());
  std::vector<int> done(4);
  for (std::size_t i : order) {
    int least = 1000;  // completed trials of the least advanced unfinished one, before this trial
    for (std::size_t j = 0; j < 4; ++j)
      if (done[j] < lengths[j]) least = std::min(least, done[j]);
    ++done[i];
    RC_ASSERT(done[i] - least <= max_lag);
  }
}

TEST(InterleavedRun, AVoidTrialLeavesTheStaircasesUnchanged) {
  InterleavedRun run({1, {.interleave = Interleave::round_robin}, staircases_of({2, 2})});
  run.void_trial();
  EXPECT_EQ(run.trial(), 2);
  EXPECT_EQ(run.level(), 10);
  EXPECT_EQ(run.staircases().front().n_trials(), 0);
  run.respond({true});
  EXPECT_EQ(run.trial(), 3);
  EXPECT_EQ(&run.staircase(), &run.staircases().back());
}

RC_GTEST_PROP(InterleavedRunProperty, ItsTrialsAreInTheOrderOfTheDraws, ()) {
  const InterleaveConfig config{
      *rc::gen::element(Interleave::random, Interleave::round_robin, Interleave::sequential),
      *rc::gen::inRange(0, 5)};
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const auto staircases = staircases_of({5, 9, 2});
  InterleavedRun run({seed, config, staircases});
  std::vector<std::size_t> order;
  while (!run.finished()) {
    order.push_back(static_cast<std::size_t>(&run.staircase() - run.staircases().data()));
    RC_ASSERT(run.trial() == static_cast<int>(order.size()));
    run.respond({true});
  }
  RC_ASSERT(order == order_of(staircases, config, seed));
}

}  // namespace
}  // namespace heft
