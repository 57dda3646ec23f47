// Techniques: declared, named by blocks and staircases, and mistakes in them.
#include <gmock/gmock.h>

#include "base/Error.h"
#include "physics/scene/Scene.h"
#include "protocol/Protocol.h"
#include "protocol/readers/Files.h"
#include "tasks/Tasks.h"

namespace heft {
namespace {

using ::testing::HasSubstr;

constexpr auto declared = R"(title = "Techniques"
[coupling]
stiffness_n_per_m = 40
[[technique]]
name = "soft"
kind = "spring"
stiffness_n_per_m = 20
[[technique]]
name = "tied"
kind = "coupled"
[[block]]
kind = "sorting"
name = "sorting"
masses_g = [15, 100, 200, 800]
trials = { soft = 2, C1 = 1, tied = 3 }
[[block]]
kind = "comparison"
name = "comparison"
technique = "soft"
[[block.staircase]]
name = "a"
reference_g = 200
start = 100
step = 50
floor = 0
[[block.staircase]]
name = "b"
technique = "C2"
reference_g = 200
start = 100
step = 50
floor = 0
)";

std::string declared_with(const std::string& from, const std::string& to) {
  std::string text = declared;
  return text.replace(text.find(from), from.size(), to);
}

std::string what_is_wrong_in(const std::string& text) {
  try {
    parse_protocol(text, "techniques.toml");
  } catch (const InvalidFile& error) {
    return error.what();
  }
  return "none";
}

TEST(Techniques, AreDeclaredAndNamed) {
  const Protocol protocol = parse_protocol(declared, "techniques.toml");
  const auto& sorting = *block_as<Sorting::Block>(protocol.blocks[0]);
  EXPECT_EQ(sorting.n_trials(), 6);
  EXPECT_EQ(sorting.masses_g.size(), 4u);
  const auto& comparison = *block_as<Comparison::Block>(protocol.blocks[1]);
  EXPECT_EQ(comparison.condition, "soft");
  EXPECT_EQ(comparison.staircases[0].condition, "");
  EXPECT_EQ(comparison.staircases[1].condition, "C2");
}

TEST(Techniques, MakeTheScenesCoupling) {
  const Protocol protocol = parse_protocol(declared, "techniques.toml");
  EXPECT_EQ(scene_of(protocol, "soft", {15}).coupling.stiffness_n_per_m, 20);
  EXPECT_EQ(scene_of(protocol, "soft", {15}).coupling.torsional_stiffness_nm_per_rad, 150);
  EXPECT_EQ(scene_of(protocol, "C2", {15}).coupling.stiffness_n_per_m, 40);
  EXPECT_TRUE(scene_of(protocol, "C2", {15}).coupling.decoupled);
  EXPECT_FALSE(scene_of(protocol, "tied", {15}).coupling.decoupled);
  EXPECT_FALSE(scene_of(protocol, "C1", {15}).coupling.decoupled);
}

TEST(Techniques, UnknownOnesAreReportedAtTheirPlaces) {
  EXPECT_THAT(what_is_wrong_in(declared_with("technique = \"soft\"", "technique = \"sft\"")),
              HasSubstr("techniques.toml:19:"));
  EXPECT_THAT(what_is_wrong_in(declared_with("tied = 3", "tide = 3")),
              HasSubstr("no technique \"tide\""));
  EXPECT_THAT(what_is_wrong_in(declared_with("kind = \"coupled\"", "kind = \"elastic\"")),
              HasSubstr("techniques.toml:10:"));
  EXPECT_THAT(what_is_wrong_in(declared_with("name = \"tied\"", "name = \"soft\"")),
              HasSubstr("another technique is named"));
  EXPECT_THAT(what_is_wrong_in(declared_with("{ soft = 2, C1 = 1, tied = 3 }", "{ soft = 0 }")),
              HasSubstr("the block has 0 trials"));
}

TEST(Techniques, OfAScene) {
  const Scene scene = parse_scene(
      "[[technique]]\nname = \"soft\"\nkind = \"spring\"\nstiffness_n_per_m = 20\n[[cube]]\n"
      "mass_kg = 0.2\nsize_m = 0.035\nyaw_rad = 0\nposition_m = [0, 0, 0.0175]\n",
      "scene.toml");
  EXPECT_EQ(scene.coupling.stiffness_n_per_m, 20);
  EXPECT_TRUE(scene.coupling.decoupled);
}

constexpr auto displacing = R"(title = "Displacing"
[[technique]]
name = "ratio"
kind = "gain"
gain_of_mass = [[15, 0.95], [200, 0.6], [800, 0.2]]
[[technique]]
name = "slow"
kind = "speed_limit"
limit_m_s_of_mass = [[15, 0.5], [800, 0.02]]
return_s = 0.2
[[block]]
kind = "sorting"
name = "sorting"
masses_g = [15, 800]
trials = { ratio = 2, C2 = 1, slow = 3 }
)";

std::string mistakes_after(const std::string& from, const std::string& to) {
  std::string text = displacing;
  return what_is_wrong_in(text.replace(text.find(from), from.size(), to));
}

TEST(Techniques, DisplacementsArePassedToTheScene) {
  const Protocol protocol = parse_protocol(displacing, "techniques.toml");
  const Scene ratio = scene_of(protocol, "ratio", {15});
  EXPECT_FALSE(ratio.coupling.decoupled);
  ASSERT_TRUE(ratio.displacement);
  EXPECT_DOUBLE_EQ(std::get<Gain>(*ratio.displacement).of_mass.at(0.2), 0.6);
  EXPECT_DOUBLE_EQ(std::get<Gain>(*ratio.displacement).return_s, 0.05);
  const Scene slow = scene_of(protocol, "slow", {15});
  EXPECT_DOUBLE_EQ(std::get<SpeedLimit>(*slow.displacement).of_mass.at(0.8), 0.02);
  EXPECT_DOUBLE_EQ(std::get<SpeedLimit>(*slow.displacement).return_s, 0.2);
  EXPECT_FALSE(scene_of(protocol, "C2", {15}).displacement);
  EXPECT_FALSE(scene_of(protocol, "C1", {15}).displacement);
}

TEST(Techniques, AreChangedBySettings) {
  const Protocol protocol =
      parse_protocol(displacing, "techniques.toml",
                     std::vector<ProtocolSetting>{{"technique.ratio.gain_of_mass", "[[100, 0.5]]"},
                                                  {"technique.slow.return_s", "0.3"}});
  EXPECT_DOUBLE_EQ(std::get<Gain>(*scene_of(protocol, "ratio", {15}).displacement).of_mass.at(0.8),
                   0.5);
  EXPECT_DOUBLE_EQ(std::get<SpeedLimit>(*scene_of(protocol, "slow", {15}).displacement).return_s,
                   0.3);
}

TEST(Techniques, InvalidTablesAreRefusedAtTheirPlaces) {
  const auto expect = [](const std::string& from, const std::string& to, const std::string& what) {
    EXPECT_THAT(mistakes_after(from, to), HasSubstr(what)) << to;
  };
  expect("[800, 0.2]", "[200, 0.2]",
         "techniques.toml:5:41: gain_of_mass changes from 200 to 200 g");
  expect("[800, 0.2]", "[800]", "techniques.toml:5:41: gain_of_mass is an array, expected pairs");
  expect("[800, 0.2]", "[800, -0.2]",
         "techniques.toml:5:47: gain_of_mass is -0.2, expected a number, at least 0");
  expect("[15, 0.95]", "[0, 0.95]", "techniques.toml:5:18: gain_of_mass is 0, expected");
  expect("[[15, 0.95], [200, 0.6], [800, 0.2]]", "[]", "techniques.toml:5:16: gain_of_mass is");
  expect("gain_of_mass =", "limit_m_s_of_mass =", "unknown key \"limit_m_s_of_mass\"");
  expect("return_s = 0.2", "return_s = 0", "techniques.toml:10:12: return_s is 0");
  expect("return_s = 0.2", "stiffness_n_per_m = 2", "unknown key \"stiffness_n_per_m\"");
  expect("limit_m_s_of_mass = [[15, 0.5], [800, 0.02]]\n", "", "lacks \"limit_m_s_of_mass\"");
  expect("kind = \"speed_limit\"", "kind = \"speedlimit\"", "did you mean \"speed_limit\"?");
  expect("kind = \"speed_limit\"\n", "", "lacks \"kind\"");
}

TEST(Techniques, OfASceneMayDisplaceTheClone) {
  const std::string table =
      "[[technique]]\nname = \"g\"\nkind = \"gain\"\ngain_of_mass = [[15, 0.5]]\n";
  EXPECT_TRUE(parse_scene(table, "scene.toml").displacement);
  EXPECT_FALSE(parse_scene("[coupling]\ncondition = \"C2\"\n" + table, "scene.toml").displacement);
}

}  // namespace
}  // namespace heft
