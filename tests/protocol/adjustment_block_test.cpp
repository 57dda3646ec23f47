// Adjustment blocks: the shipped example, and each mistake at its place.
#include <gmock/gmock.h>

#include "EditedFile.h"
#include "protocol/Protocol.h"
#include "tasks/Adjustment.h"

namespace heft {
namespace {

std::string example() {
  return content_of(shipped_path("examples/adjustment"));
}

TEST(AdjustmentBlock, OfTheExampleHasItsKeys) {
  const Protocol protocol = load_protocol(shipped_path("examples/adjustment"));
  const auto& block = *block_as<Adjustment::Block>(protocol.blocks.at(1));
  EXPECT_THAT(block.reference_g.values, testing::ElementsAre(100, 200));
  EXPECT_THAT(block.start_g, testing::ElementsAre(50, 500));
  EXPECT_THAT(block.steps_g, testing::ElementsAre(50, 10));
  ASSERT_EQ(block.trials.size(), 1u);
  EXPECT_EQ(block.trials[0].technique, "C2");
  EXPECT_EQ(block.expected_trials(), 6);
  EXPECT_EQ(block.most_cubes(), 2);
}

TEST(AdjustmentBlock, MayHaveOneReference) {
  const std::string text = edited(example(), {"[100, 200]", "150"}).text;
  const Protocol protocol = parse_protocol(text, "x.toml");
  EXPECT_THAT(block_as<Adjustment::Block>(protocol.blocks.at(1))->reference_g.values,
              testing::ElementsAre(150));
}

class BrokenAdjustment : public testing::TestWithParam<Broken> {};

TEST_P(BrokenAdjustment, IsOneMistakeAtItsPlace) {
  expect_broken(example(), GetParam(), [](auto& text) { parse_protocol(text, "x.toml"); });
}

const std::vector<Broken> broken_adjustments{
    {"no_reference",
     {"reference_g = [100, 200]", "reference_g = ^[]"},
     {"reference_g has 0 numbers"}},
    {"same_reference_twice", {"[100, 200]", "[100, ^100]"}, {"reference_g has 100 g twice"}},
    {"reference_without_mass", {"[100, 200]", "[100, ^0]"}, {"reference_g"}},
    {"no_range", {"start_g = [50, 500]", "start_g = ^[50]"}, {"start_g is [50]", "a range"}},
    {"range_reversed", {"[50, 500]", "^[500, 50]"}, {"start_g is [500, 50]"}},
    {"start_below_the_fine_step",
     {"steps_g = [50, 10]", "steps_g = ^[100, 60]"},
     {"the fine step is 60 g", "at most 50 g"}},
    {"one_step", {"steps_g = [50, 10]", "steps_g = ^[50]"}, {"steps_g is [50]", "the coarse"}},
    {"fine_step_first", {"[50, 10]", "^[10, 50]"}, {"steps_g is [10, 50]"}},
    {"no_trials", {"trials = 3 ", "trials = ^0 "}, {"trials is 0"}},
    {"too_many_trials", {"trials = 3 ", "trials = ^300 "}, {"the block has 600 trials"}},
    {"unknown_key", {"steps_g = [50, 10]", "steps_g = [50, 10]\n^step_g = 3"}, {"\"step_g\""}},
};

INSTANTIATE_TEST_SUITE_P(Each, BrokenAdjustment, testing::ValuesIn(broken_adjustments),
                         name_of_broken);

}  // namespace
}  // namespace heft
