// A procedure that is not one of Heft's is run, copied and interleaved with them.
#include <gmock/gmock.h>

#include "psychophysics/Bisection.h"
#include "psychophysics/Constant.h"
#include "psychophysics/Interleaving.h"
#include "psychophysics/Staircases.h"

namespace heft {
namespace {

using testing::Optional;

/// Runs them to their end, for an observer who perceives levels above `threshold`.
std::vector<Procedure> run(std::vector<Procedure> staircases, const InterleaveConfig& config,
                           double threshold) {
  std::optional<std::size_t> previous;
  for (std::uint64_t trial = 1;; ++trial) {
    RandomStream stream(1, "interleave", trial);
    const auto next = next_staircase(staircases, config, previous, stream);
    if (!next) return staircases;
    Procedure& staircase = staircases[*next];
    const double level = staircase.next_level(level_stream(1, staircase.name()));
    staircase.respond({level > threshold}, level);
    previous = next;
  }
}

TEST(OwnProcedure, IsInterleavedWithOurs) {
  const std::vector<Procedure> fresh{{"own", test::Bisection(0, 512, 4)},
                                     {"15g", test::paper_15g()},
                                     {"constant", ConstantConfig{.levels = {1, 2}}}};
  for (const Interleave order :
       {Interleave::random, Interleave::round_robin, Interleave::sequential}) {
    const auto staircases = run(fresh, {order, 2}, 101);
    EXPECT_EQ(staircases[0].finish(), StopReason::precision);
    EXPECT_EQ(staircases[0].n_trials(), 7);  // 512 / 2^7 = 4
    const Estimate estimate = staircases[0].estimates().at(0);
    EXPECT_THAT(estimate.value, Optional(102));
    EXPECT_THAT(estimate.low, Optional(100));
    EXPECT_THAT(estimate.high, Optional(104));
    EXPECT_EQ(staircases[1].finish(), StopReason::reversals);
    EXPECT_EQ(staircases[2].n_trials(), 2);
  }
}

TEST(OwnProcedure, IsAValueWhoseCopiesAreApart) {
  Procedure one("own", test::Bisection(0, 512, 4));
  one.respond({true}, 256);
  Procedure other = one;
  other.respond({true}, 128);
  EXPECT_EQ(one.n_trials(), 1);
  EXPECT_EQ(other.n_trials(), 2);
  EXPECT_EQ(one.next_level(level_stream(1, "own")), 128);
  EXPECT_EQ(other.next_level(level_stream(1, "own")), 64);
  other = one;
  EXPECT_EQ(other.next_level(level_stream(1, "own")), 128);
  EXPECT_EQ(other.n_trials(), 1);
}

TEST(OwnProcedure, MayLeaveItsPlansUnsaid) {
  const Procedure own("own", test::Bisection(0, 512, 4));
  EXPECT_FALSE(own.planned_trials());
  EXPECT_TRUE(own.planned_levels().empty());
  EXPECT_TRUE(own.get_if<test::Bisection>());
  EXPECT_FALSE(own.get_if<UpDown>());
}

}  // namespace
}  // namespace heft
