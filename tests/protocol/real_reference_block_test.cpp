// Comparison blocks with a real object: the shipped example, and each mistake at its place.
#include <gmock/gmock.h>

#include "EditedFile.h"
#include "protocol/Protocol.h"
#include "tasks/Comparison.h"

namespace heft {
namespace {

std::string example() {
  return content_of(shipped_path("examples/real_reference"));
}

TEST(RealReferenceBlock, OfTheExampleHasItsKeys) {
  const Protocol protocol = parse_protocol(example(), "x.toml");
  const auto& block = *block_as<Comparison::Block>(protocol.blocks.at(0));
  ASSERT_TRUE(block.reference);
  EXPECT_EQ(block.reference->name, "brass cylinder");
  EXPECT_EQ(block.reference->mass_g, 200);
  EXPECT_EQ(block.staircases.at(0).reference_g, 200);
  EXPECT_EQ(assumed_trial_s(protocol, "comparison"), 15);
}

class BrokenRealReference : public testing::TestWithParam<Broken> {};

TEST_P(BrokenRealReference, IsOneMistakeAtItsPlace) {
  expect_broken(example(), GetParam(), [](auto& text) { parse_protocol(text, "x.toml"); });
}

const std::string other_block = R"(
[[block]]
kind = "comparison"
name = "against a cube"
answers = "heavier"
[[block.staircase]]
name = "against a cube"
reference_g = 200
kind = "constant"
levels = [50]
n_per_level = 2
)";
const std::vector<Broken> broken_references{
    {"mass_twice",
     {"kind = \"constant\"", "reference_g = ^200\nkind = \"constant\""},
     {"reference_g", "mass of the real object"}},
    {"sides",
     {"answers = \"heavier\" ", "sides = ^\"balanced\"\nanswers = \"heavier\" "},
     {"sides together with a real reference"}},
    {"long_name",
     {"{ name = \"brass cylinder\"", "^{ name = \"a brass cylinder with a hook\""},
     {"28 characters", "1 to 24"}},
    {"no_mass", {"mass_g = 200 }", "mass_g = ^0 }"}, {"mass_g is 0"}},
    {"mass_in_words", {"mass_g = 200 }", "mass_g = ^\"200\" }"}, {"mass_g", "expected a number"}},
    {"no_mass_and_catches",
     {"mass_g = 200 }", "mass_g = ^-1 }\ncatch_trials = { 200g = 2 }"},
     {"mass_g is -1"}},
    {"no_object", {"{ name = \"brass cylinder\", mass_g = 200 }", "^\"brass\""}, {"reference"}},
    {"no_mass_twice", {"mass_g = 200 }", "^mas_g = 200 }"}, {"mass_g"}},
    {"lighter_than_nothing", {"levels = [-150", "levels = [^-200"}, {"weigh 0 g"}},
};

INSTANTIATE_TEST_SUITE_P(Each, BrokenRealReference, testing::ValuesIn(broken_references),
                         name_of_broken);

TEST(RealReferenceBlock, IsNoReferenceBesideACubeOfItsMassInOneTechnique) {
  const auto mistakes = mistakes_of([&] { parse_protocol(example() + other_block, "x.toml"); });
  ASSERT_EQ(mistakes.size(), 1u);
  EXPECT_THAT(mistakes[0].message,
              testing::AllOf(testing::HasSubstr("against brass and against a cube"),
                             testing::HasSubstr("a real object")));
}

TEST(RealReferenceBlock, MayStandBesideACubeInAnotherTechnique) {
  std::string text = example() + other_block;
  text.replace(text.rfind("reference_g"), 11, "condition = \"C1\"\nreference_g");
  EXPECT_NO_THROW(parse_protocol(text, "x.toml"));
}

}  // namespace
}  // namespace heft
