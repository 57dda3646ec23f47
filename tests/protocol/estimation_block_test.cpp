// Estimation blocks: the shipped example, and each mistake at its place.
#include <gmock/gmock.h>

#include "EditedFile.h"
#include "protocol/Protocol.h"
#include "tasks/Estimation.h"

namespace heft {
namespace {

std::string example() {
  return content_of(shipped_path("examples/estimation"));
}

TEST(EstimationBlock, OfTheExampleHasItsKeys) {
  const Protocol protocol = load_protocol(shipped_path("examples/estimation"));
  const auto& block = *block_as<Estimation::Block>(protocol.blocks.at(1));
  EXPECT_THAT(block.masses_g, testing::ElementsAre(15, 50, 100, 200, 400));
  ASSERT_EQ(block.trials.size(), 1u);
  EXPECT_EQ(block.trials[0].technique, "C2");
  EXPECT_EQ(block.trials[0].trials, 3);
  EXPECT_EQ(block.scale, "number");
  EXPECT_EQ(block.low, 1);
  EXPECT_EQ(block.high, 500);
  EXPECT_EQ(block.modulus->mass_g, 100);
  EXPECT_EQ(block.modulus->value, 10);
  EXPECT_EQ(block.n_trials(), 16) << "with the standard";
}

TEST(EstimationBlock, MayHaveTrialsByTechniqueAndAQuestionAsItsScale) {
  const std::string numbers = "scale = \"number\"\nlow = 1\nhigh = 500\n";
  std::string text = example();
  text.erase(text.find("modulus"));
  text.replace(text.find(numbers), numbers.size(), "scale = \"borg_cr10.exertion\"\n");
  const std::string each = "trials_per_mass = 3";
  text.replace(text.find(each), each.size(), "trials = { C1 = 2, C2 = 1 }");
  text.erase(text.rfind("condition = \"C2\""), 16);
  const Protocol protocol = parse_protocol(text, "x.toml");
  const auto& block = *block_as<Estimation::Block>(protocol.blocks.at(1));
  EXPECT_EQ(block.n_trials(), 15);
  EXPECT_THAT(questionnaires_of(protocol), testing::ElementsAre("borg_cr10"));
}

class BrokenEstimation : public testing::TestWithParam<Broken> {};

TEST_P(BrokenEstimation, IsOneMistakeAtItsPlace) {
  expect_broken(example(), GetParam(), [](auto& text) { parse_protocol(text, "x.toml"); });
}

const std::vector<Broken> broken_estimations{
    {"no_masses",
     {"[[block]]\nkind = \"estimation\"\nname = \"estimation\"\nmasses_g = [15, 50, 100, 200, 400]",
      "^[[block]]\nkind = \"estimation\"\nname = \"estimation\""},
     {"lacks \"masses_g\""}},
    {"a_mass_twice",
     {"[15, 50, 100", "[15, 50, ^15"},
     {"15 g twice", "trials_per_mass sets the number"}},
    {"no_weight", {"[15, 50", "[^0, 50"}, {"masses_g"}},
    {"unknown_technique", {"\"C2\"\n# \"number\"", "^\"C3\"\n# \"number\""}, {"C3"}},
    {"no_trials", {"trials_per_mass = 3", "trials_per_mass = ^0"}, {"trials_per_mass is 0"}},
    {"unknown_scale", {"scale = \"number\"", "scale = ^\"numbers\""}, {"NAME.KEY"}},
    {"range_the_wrong_way", {"high = 500", "high = ^0.5"}, {"more than low 1"}},
    {"below_nothing", {"low = 1\n", "low = ^-1\n"}, {"0 or more"}},
    {"modulus_off_the_scale",
     {"modulus = { mass_g = 100, value = 10 }", "modulus = ^{ mass_g = 100, value = 1000 }"},
     {"the modulus is 1000"}},
    {"modulus_without_value",
     {"{ mass_g = 100, value = 10", "^{ mass_g = 100"},
     {"lacks \"value\""}},
    {"unknown_key", {"low = 1\n", "low = 1\n^lowest = 1\n"}, {"\"lowest\""}},
};

INSTANTIATE_TEST_SUITE_P(Each, BrokenEstimation, testing::ValuesIn(broken_estimations),
                         name_of_broken);

}  // namespace
}  // namespace heft
