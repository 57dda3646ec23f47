// Techniques as data: declared, named by blocks and staircases, and what is wrong with them.
#include <gmock/gmock.h>

#include "base/Error.h"
#include "physics/Scene.h"
#include "protocol/Files.h"
#include "protocol/Protocol.h"

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

std::string edited(const std::string& from, const std::string& to) {
  std::string text = declared;
  return text.replace(text.find(from), from.size(), to);
}

std::string mistakes_in(const std::string& text) {
  try {
    parse_protocol(text, "techniques.toml");
  } catch (const InvalidFile& error) {
    return error.what();
  }
  return "none";
}

TEST(Techniques, AreDeclaredAndNamed) {
  const Protocol protocol = parse_protocol(declared, "techniques.toml");
  const auto& sorting = std::get<SortingBlock>(protocol.blocks[0]);
  EXPECT_EQ(sorting.n_trials(), 6);
  EXPECT_EQ(sorting.masses_g.size(), 4u);
  const auto& comparison = std::get<ComparisonBlock>(protocol.blocks[1]);
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

TEST(Techniques, ThatAreNotThereAreNamedWithTheirPlace) {
  EXPECT_THAT(mistakes_in(edited("technique = \"soft\"", "technique = \"sft\"")),
              HasSubstr("techniques.toml:19:"));
  EXPECT_THAT(mistakes_in(edited("tied = 3", "tide = 3")), HasSubstr("no technique \"tide\""));
  EXPECT_THAT(mistakes_in(edited("kind = \"coupled\"", "kind = \"elastic\"")),
              HasSubstr("techniques.toml:10:"));
  EXPECT_THAT(mistakes_in(edited("name = \"tied\"", "name = \"soft\"")), HasSubstr("already a"));
  EXPECT_THAT(mistakes_in(edited("{ soft = 2, C1 = 1, tied = 3 }", "{ soft = 0 }")),
              HasSubstr("trials are 0 in all"));
}

TEST(Techniques, OfAScene) {
  const Scene scene = parse_scene(
      "[[technique]]\nname = \"soft\"\nkind = \"spring\"\nstiffness_n_per_m = 20\n[[cube]]\n"
      "mass_kg = 0.2\nsize_m = 0.035\nyaw_rad = 0\nposition_m = [0, 0, 0.0175]\n",
      "scene.toml");
  EXPECT_EQ(scene.coupling.stiffness_n_per_m, 20);
  EXPECT_TRUE(scene.coupling.decoupled);
}

}  // namespace
}  // namespace heft
