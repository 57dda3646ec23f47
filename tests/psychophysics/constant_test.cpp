// The method of constant stimuli: its schedule and order.
#include "psychophysics/Constant.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>

#include "psychophysics/Procedure.h"

namespace heft {
namespace {

ConstantConfig any_constant() {
  ConstantConfig config;
  const auto levels =
      *rc::gen::nonEmpty(rc::gen::container<std::set<int>>(rc::gen::inRange(-100, 100)));
  config.levels.assign(levels.begin(), levels.end());
  config.n_per_level = *rc::gen::inRange(1, 12);
  config.order = *rc::gen::element(ConstantOrder::blocks, ConstantOrder::shuffled);
  return config;
}

std::uint64_t any_seed() {
  return *rc::gen::arbitrary<std::uint64_t>();
}

/// The levels that a procedure presents, with responses `answer()`; each trial's level is queried
/// `looks` times.
template <typename Answers>
std::vector<double> presented(Procedure procedure, std::uint64_t seed, int looks,
                              const Answers& answer) {
  std::vector<double> levels;
  while (!procedure.finished()) {
    double level = 0;
    for (int look = 0; look < looks; ++look)
      level = procedure.next_level(level_stream(seed, procedure.name()));
    levels.push_back(level);
    procedure.respond(answer(), level);
  }
  return levels;
}

std::vector<double> presented(const Procedure& procedure, std::uint64_t seed) {
  return presented(procedure, seed, 1, [] { return Response{true}; });
}

RC_GTEST_PROP(ConstantProperty, EveryLevelComesAsOftenAsWanted, ()) {
  const ConstantConfig config = any_constant();
  std::map<double, int> counts;
  for (double level : presented({"s", config}, any_seed())) ++counts[level];
  RC_ASSERT(counts.size() == config.levels.size());
  for (double level : config.levels) RC_ASSERT(counts[level] == config.n_per_level);
}

RC_GTEST_PROP(ConstantProperty, EveryBlockHoldsEachLevelOnce, ()) {
  ConstantConfig config = any_constant();
  config.order = ConstantOrder::blocks;
  const std::vector<double> schedule = presented({"s", config}, any_seed());
  const std::size_t n = config.levels.size();
  for (std::size_t i = 0; i < schedule.size(); i += n) {
    const auto block = std::span(schedule).subspan(i, n);
    RC_ASSERT(std::set(block.begin(), block.end()).size() == n);
  }
}

RC_GTEST_PROP(ConstantProperty, OnlyTheSeedOrdersTheTrials, ()) {
  const Procedure config("s", any_constant());
  const std::uint64_t seed = any_seed();
  const auto by_chance = [] {
    return Response{*rc::gen::arbitrary<bool>(),
                    *rc::gen::element(Choice::comparison, Choice::reference, Choice::none)};
  };
  RC_ASSERT(presented(config, seed, 1, by_chance) == presented(config, seed));
}

RC_GTEST_PROP(ConstantProperty, AVoidTrialConsumesNothing, ()) {
  const Procedure config("s", any_constant());
  const std::uint64_t seed = any_seed();
  const int looks = *rc::gen::inRange(2, 5);
  RC_ASSERT(presented(config, seed, looks, [] { return Response{}; }) == presented(config, seed));
}

RC_GTEST_PROP(ConstantProperty, EndsByItsTrialsAndEstimatesNothing, ()) {
  const ConstantConfig config = any_constant();
  Procedure procedure("s", config);
  const auto planned = procedure.planned_trials();
  for (int trial = 1; trial <= planned; ++trial) {
    RC_ASSERT(!procedure.finished());
    const Update update = procedure.respond({true}, 1);
    RC_ASSERT(!update.reversal);
    RC_ASSERT(update.finish.has_value() == (trial == planned));
  }
  RC_ASSERT(procedure.finish() == StopReason::trials);
  const std::vector<Estimate> estimates = procedure.estimates();
  RC_ASSERT(estimates.size() == 1u);
  RC_ASSERT(estimates[0].method == "constant");
  RC_ASSERT(!estimates[0].value && !estimates[0].low && !estimates[0].high);
  RC_ASSERT(estimates[0].n_trials == planned);
}

TEST(Constant, SeedsAndNamesHaveOrdersOfTheirOwn) {
  const ConstantConfig config{.levels = {1, 2, 3, 4, 5, 6}, .n_per_level = 5};
  const auto first = presented({"a", config}, 1);
  EXPECT_EQ(first, presented({"a", config}, 1));
  EXPECT_NE(first, presented({"a", config}, 2));
  EXPECT_NE(first, presented({"b", config}, 1));
}

TEST(Constant, EachBlockIsShuffledAgain) {
  const auto schedule =
      presented({"a", ConstantConfig{.levels = {1, 2, 3, 4, 5, 6, 7, 8}, .n_per_level = 20}}, 1);
  std::set<std::vector<double>> blocks;
  for (std::size_t i = 0; i < schedule.size(); i += 8)
    blocks.insert(
        {schedule.begin() + static_cast<long>(i), schedule.begin() + static_cast<long>(i) + 8});
  EXPECT_GT(blocks.size(), 15u);
}

// 20.5 is the 99.9 % point of chi-square with 5 degrees of freedom; the seeds are fixed.
void expect_all_equally_likely(const std::map<std::vector<double>, int>& counts, int n) {
  ASSERT_EQ(counts.size(), 6u);
  double chi_square = 0;
  for (const auto& [order, count] : counts)
    chi_square += (count - n / 6.0) * (count - n / 6.0) / (n / 6.0);
  EXPECT_LT(chi_square, 20.5);
}

TEST(Constant, EveryOrderIsEquallyLikely) {
  constexpr int n = 6000;
  std::map<std::vector<double>, int> blocks, shuffled;
  for (int seed = 0; seed < n; ++seed) {
    const auto key = static_cast<std::uint64_t>(seed);
    ++blocks[constant_schedule({.levels = {1, 2, 3}}, RandomStream(key, "levels/a"))];
    ++shuffled[constant_schedule(
        {.levels = {1, 2}, .n_per_level = 2, .order = ConstantOrder::shuffled},
        RandomStream(key, "levels/a"))];
  }
  expect_all_equally_likely(blocks, n);
  expect_all_equally_likely(shuffled, n);  // 1122, 1212, 1221, 2112, 2121, 2211
}

}  // namespace
}  // namespace heft
