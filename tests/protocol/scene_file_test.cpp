#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "EditedFile.h"
#include "physics/scene/Scene.h"
#include "protocol/readers/Files.h"

namespace heft {
namespace {

const std::string scene_file = R"(friction = 0.5
gravity_m_s2 = 3.7
[effector]
size_m = [0.1, 0.03, 0.02]
[coupling]
condition = "C1"
stiffness_n_per_m = 60
torsional_stiffness_nm_per_rad = 120.5
clone_mass_kg = 0.02
damping_ratio = 0.7
[clone]
offset_m = [0.01, 0, -0.02]
offset_rotvec_rad = [0, 0, 1.5]
[[cube]]
mass_kg = 0.015
size_m = 0.04
position_m = [-0.1, 0.02, 0.02]
[[cube]]
mass_kg = 1
size_m = [0.05, 0.04, 0.03]
position_m = [0.1, 0, 0.5]
yaw_rad = 0.25
)";

TEST(SceneFile, ReadsEveryKey) {
  const Scene scene = parse_scene(scene_file, "all.toml");
  EXPECT_EQ(scene.friction, 0.5);
  EXPECT_EQ(scene.gravity_m_s2, 3.7);
  EXPECT_EQ(scene.effector_size_m, Eigen::Vector3d(0.1, 0.03, 0.02));
  EXPECT_FALSE(scene.coupling.decoupled);
  EXPECT_EQ(scene.coupling.stiffness_n_per_m, 60);
  EXPECT_EQ(scene.coupling.torsional_stiffness_nm_per_rad, 120.5);
  EXPECT_EQ(scene.coupling.clone_mass_kg, 0.02);
  EXPECT_EQ(scene.coupling.damping_ratio, 0.7);
  EXPECT_EQ(scene.clone_offset.position_m, Eigen::Vector3d(0.01, 0, -0.02));
  EXPECT_NEAR(scene.clone_offset.orientation.w(), std::cos(0.75), 1e-15);
  EXPECT_NEAR(scene.clone_offset.orientation.z(), std::sin(0.75), 1e-15);
  ASSERT_EQ(scene.cubes.size(), 2u);
  EXPECT_EQ(scene.cubes[0].mass_kg, 0.015);
  EXPECT_EQ(scene.cubes[0].size_m, Eigen::Vector3d(0.04, 0.04, 0.04));
  EXPECT_EQ(scene.cubes[0].position_m, Eigen::Vector3d(-0.1, 0.02, 0.02));
  EXPECT_EQ(scene.cubes[0].yaw_rad, 0);
  EXPECT_EQ(scene.cubes[1].size_m, Eigen::Vector3d(0.05, 0.04, 0.03));
  EXPECT_EQ(scene.cubes[1].yaw_rad, 0.25);
}

TEST(SceneFile, ImplausibleNumbersAreRefusedAtTheirPlaces) {
  const auto refusal = [](const std::string& from, const std::string& to) -> std::string {
    std::string text = scene_file;
    try {
      parse_scene(text.replace(text.find(from), from.size(), to), "far.toml");
    } catch (const InvalidFile& error) {
      return error.what();
    }
    return "accepted";
  };
  using testing::HasSubstr;
  EXPECT_THAT(refusal("[-0.1, 0.02, 0.02]", "[1e308, 0.02, 0.02]"),
              HasSubstr("far.toml:17:15: position_m is 1e+308, expected a number, at "
                        "least -1000000 and at most 1000000"));
  EXPECT_THAT(refusal("[-0.1, 0.02, 0.02]", "[-0.1, 2e6, 0.02]"), HasSubstr("at most 1000000"));
  EXPECT_THAT(refusal("offset_m = [0.01,", "offset_m = [1e9,"), HasSubstr("offset_m"));
  EXPECT_THAT(refusal("size_m = 0.04", "size_m = 1e7"), HasSubstr("size_m"));
  EXPECT_THAT(refusal("[0.1, 0.03, 0.02]", "[0.1, 0.03, 1e11]"), HasSubstr("size_m"));
}

TEST(SceneFile, MissingKeysAreThePapersDecoupling) {
  const Scene scene = parse_scene("friction = 0.8\n", "short.toml");
  EXPECT_EQ(scene.gravity_m_s2, 9.81);
  EXPECT_TRUE(scene.coupling.decoupled);
  EXPECT_EQ(scene.coupling.stiffness_n_per_m, 50);
  EXPECT_EQ(scene.coupling.torsional_stiffness_nm_per_rad, 150);
  EXPECT_EQ(scene.coupling.clone_mass_kg, 0.010);
  EXPECT_EQ(scene.coupling.damping_ratio, 1);
  EXPECT_TRUE(scene.cubes.empty());
}

TEST(SceneFile, CubesMayTouchEachOther) {
  const auto scene = parse_scene(
      "[[cube]]\nmass_kg = 1\nsize_m = 0.1\nposition_m = [0, 0, 0.05]\n"
      "[[cube]]\nmass_kg = 1\nsize_m = 0.1\nposition_m = [0.1, 0, 0.05]\n"
      "[[cube]]\nmass_kg = 1\nsize_m = 0.1\nposition_m = [0.05, 0, 0.15]\n",
      "stack.toml");
  EXPECT_EQ(scene.cubes.size(), 3u);
}

class BrokenScene : public testing::TestWithParam<Broken> {};

TEST_P(BrokenScene, IsOneMistakeAtItsPlace) {
  expect_broken(scene_file, GetParam(), [](auto& text) { parse_scene(text, "x.toml"); });
}

const std::vector<Broken> broken_scenes{
    {"negative_friction", {"0.5", "^-0.5"}, {"friction is -0.5", "at least 0"}},
    {"negative_gravity", {"3.7", "^-3.7"}, {"gravity_m_s2", "at least 0"}},
    {"key_without_unit", {"gravity_m_s2 = 3.7", "^gravity = 3.7"}, {"\"gravity_m_s2\"?"}},
    {"key_of_another_table",
     {"mass_kg = 1\n", "mass_kg = 1\n^friction = 1\n"},
     {"friction", "[[cube]]"}},
    {"two_sizes", {"[0.1, 0.03, 0.02]", "^[0.1, 0.03]"}, {"2 numbers, expected 3"}},
    {"flat_effector", {"0.03, 0.02]", "^0, 0.02]"}, {"size_m is 0", "above 0"}},
    {"unknown_condition", {"\"C1\"", "^\"C3\""}, {"\"C1\" or \"C2\""}},
    {"no_stiffness", {"= 60", "= ^0"}, {"stiffness_n_per_m is 0", "above 0"}},
    {"negative_clone_mass", {"0.02\nd", "^-0.02\nd"}, {"clone_mass_kg is -0.02", "above 0"}},
    {"text_in_vector", {"[0.01, 0,", "[0.01, ^\"0\","}, {"offset_m is \"0\"", "a number"}},
    {"unknown_clone_key", {"offset_rotvec_rad", "^offset_rotvec"}, {"\"offset_rotvec_rad\"?"}},
    {"zero_mass", {"0.015", "^0"}, {"mass_kg is 0", "above 0"}},
    {"mass_that_underflows", {"0.015", "^1e-150"}, {"mass_kg is 1e-150", "1e-09 or more"}},
    {"negative_mass", {"0.015", "^-0.015"}, {"mass_kg is -0.015", "above 0"}},
    {"missing_mass", {"[[cube]]\nmass_kg = 0.015", "^[[cube]]"}, {"[[cube]] lacks \"mass_kg\""}},
    {"missing_position",
     {"[[cube]]\nmass_kg = 1\nsize_m = [0.05, 0.04, 0.03]\nposition_m = [0.1, 0, 0.5]",
      "^[[cube]]\nmass_kg = 1\nsize_m = 1"},
     {"lacks \"position_m\""}},
    {"size_as_text", {"size_m = 0.04", "size_m = ^\"4 cm\""}, {"size_m is \"4 cm\"", "above 0"}},
    {"infinite_yaw", {"0.25", "^-inf"}, {"yaw_rad is -inf", "finite"}},
    {"in_the_table", {"0.02, 0.02]", "0.02, ^0.01]"}, {"0.01 m into the table", "0.02 m"}},
    {"overlapping",
     {"[0.1, 0, 0.5]", "^[-0.06, 0.02, 0.02]"},
     {"cube 2 overlaps cube 1 (line 14)"}},
};

INSTANTIATE_TEST_SUITE_P(Each, BrokenScene, testing::ValuesIn(broken_scenes), name_of_broken);

}  // namespace
}  // namespace heft
