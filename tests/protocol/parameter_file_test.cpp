#include <gtest/gtest.h>

#include "EditedFile.h"
#include "experiment/Participant.h"
#include "protocol/readers/Files.h"

namespace heft {
namespace {

const std::string parameters_file = R"(# a responder
zeta = 0.5
guess = true
alpha = 3
cue = "offset"
)";

TEST(ParameterFile, KeepsTheFilesOrderAndPlaces) {
  const auto parameters = parse_parameters(parameters_file, "p.toml");
  ASSERT_EQ(parameters.size(), 4u);
  EXPECT_EQ(parameters[0].name, "zeta");
  EXPECT_EQ(std::get<double>(parameters[0].value), 0.5);
  EXPECT_EQ(to_string(parameters[0].place), "p.toml:2:8");
  EXPECT_EQ(std::get<bool>(parameters[1].value), true);
  EXPECT_EQ(parameters[2].name, "alpha");
  EXPECT_EQ(std::get<double>(parameters[2].value), 3);
  EXPECT_EQ(std::get<std::string>(parameters[3].value), "offset");
}

TEST(ParameterFile, MayBeEmpty) {
  EXPECT_TRUE(parse_parameters("", "p.toml").empty());
}

class BrokenParameters : public testing::TestWithParam<Broken> {};

TEST_P(BrokenParameters, IsOneMistakeAtItsPlace) {
  expect_broken(parameters_file, GetParam(), [](auto& text) { parse_parameters(text, "x.toml"); });
}

const std::vector<Broken> broken_parameters{
    {"array", {"= 3", "= ^[3]"}, {"alpha is an array"}},
    {"table", {"cue = \"offset\"", "^[cue]"}, {"cue is a table"}},
    {"not_a_number", {"0.5", "^nan"}, {"zeta is nan", "finite"}},
    {"overflow", {"0.5", "^1e999"}, {"zeta is 1e999"}},
    {"date", {"0.5", "^2024-05-01"}, {"zeta is a date"}},
};

INSTANTIATE_TEST_SUITE_P(Each, BrokenParameters, testing::ValuesIn(broken_parameters),
                         name_of_broken);

}  // namespace
}  // namespace heft
