#include "protocol/Protocol.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "EditedFile.h"
#include "base/files/TextFile.h"
#include "psychophysics/ProcedureKinds.h"
#include "tasks/Tasks.h"

namespace heft {
namespace {

using testing::ElementsAre;

Protocol shipped(const std::string& name) {
  return load_protocol(shipped_path(name));
}

TEST(Protocol, KeepsItsTextAndName) {
  const Protocol protocol = shipped("paper");
  EXPECT_EQ(protocol.name, "paper");
  EXPECT_EQ(protocol.text, content_of(shipped_path("paper")));
  EXPECT_EQ(protocol.sha256, sha256(protocol.text));
}

TEST(Protocol, ChoosesHowTheEffectorMovesBetweenPictures) {
  const std::string text = content_of(shipped_path("quick"));
  const DriveInput over_video = parse_protocol(text, "x.toml").simulator.input;
  EXPECT_EQ(over_video.mode, InputMode::path);
  EXPECT_EQ(over_video.predict_s, 0);
  const DriveInput see_through =
      parse_protocol(text, "x.toml",
                     std::vector<ProtocolSetting>{{"physics.input", "extrapolate"},
                                                  {"physics.predict_s", "0.05"}})
          .simulator.input;
  EXPECT_EQ(see_through.mode, InputMode::extrapolate);
  EXPECT_EQ(see_through.predict_s, 0.05);
}

TEST(PaperProtocol, HasThePapersBlocks) {
  const Protocol protocol = shipped("paper");
  EXPECT_EQ(protocol.display_rate_hz, 15);
  EXPECT_EQ(protocol.coupling.stiffness_n_per_m, 50);
  EXPECT_EQ(protocol.coupling.torsional_stiffness_nm_per_rad, 150);
  EXPECT_EQ(protocol.coupling.clone_mass_kg, 0.010);
  EXPECT_EQ(protocol.friction, 0.8);
  EXPECT_EQ(protocol.layout.cube_size_m, 0.035);
  ASSERT_EQ(protocol.blocks.size(), 5u);
  EXPECT_TRUE(std::holds_alternative<DemonstrationBlock>(protocol.blocks[0]));
  const auto& introduction = *block_as<Introduction::Block>(protocol.blocks[1]);
  EXPECT_THAT(introduction.masses_g, ElementsAre(15, 800));
  EXPECT_EQ(introduction.condition, "C2");
  const auto& sorting = *block_as<Sorting::Block>(protocol.blocks[2]);
  EXPECT_THAT(sorting.masses_g, ElementsAre(15, 200, 800));
  EXPECT_EQ(sorting.n_trials(), 10);
  EXPECT_EQ(sorting.trials.at(0).technique, "C1");
  EXPECT_EQ(sorting.trials.at(0).trials, 5);
  EXPECT_TRUE(std::holds_alternative<BreakBlock>(protocol.blocks[3]));
}

TEST(PaperProtocol, HasThePapersStaircases) {
  const Protocol protocol = shipped("paper");
  const auto& comparison = *block_as<Comparison::Block>(protocol.blocks.at(4));
  EXPECT_EQ(comparison.condition, "C2");
  EXPECT_EQ(comparison.catch_fraction, 0);
  EXPECT_EQ(comparison.positive_answer, PositiveAnswer::any_choice);
  EXPECT_EQ(comparison.interleaving.interleave, Interleave::random);
  std::vector<std::vector<double>> table;
  for (const auto& [reference_g, procedure, technique] : comparison.staircases) {
    const auto& staircase = procedure.get_if<UpDown>()->config();
    table.push_back({reference_g, staircase.start, staircase.step.value()});
    EXPECT_EQ(staircase.halve_every, 2);
    EXPECT_EQ(staircase.stop_reversals, 10);
    EXPECT_EQ(staircase.discard_reversals, 2);
    EXPECT_EQ(staircase.up, 1);
    EXPECT_EQ(staircase.down, 1);
    EXPECT_EQ(staircase.floor, 0);
    EXPECT_EQ(staircase.change_step, ChangeStep::before_move);
  }
  EXPECT_THAT(table, ElementsAre(ElementsAre(15, 175, 50), ElementsAre(200, 600, 150),
                                 ElementsAre(800, 700, 200)));
}

// As documented in paper.toml: missing keys above the blocks have its values.
TEST(PaperProtocol, HasTheDefaults) {
  const Protocol paper = shipped("paper");
  const Protocol defaults = parse_protocol(
      "title = \"t\"\n[[block]]\nkind = \"demonstration\"\nname = \"d\"\n", "short.toml");
  EXPECT_EQ(paper.display_rate_hz, defaults.display_rate_hz);
  EXPECT_EQ(paper.void_after_s, defaults.void_after_s);
  EXPECT_EQ(paper.require_contact, defaults.require_contact);
  EXPECT_EQ(paper.effector_size_m, defaults.effector_size_m);
  EXPECT_EQ(paper.coupling.damping_ratio, defaults.coupling.damping_ratio);
  EXPECT_EQ(paper.friction, defaults.friction);
  EXPECT_EQ(paper.friction_is, defaults.friction_is);
  EXPECT_EQ(paper.gravity_m_s2, defaults.gravity_m_s2);
  EXPECT_EQ(paper.simulator.name, defaults.simulator.name);
  EXPECT_EQ(paper.simulator.rate_hz, defaults.simulator.rate_hz);
  EXPECT_EQ(paper.simulator.input.mode, defaults.simulator.input.mode);
  EXPECT_EQ(paper.simulator.input.predict_s, defaults.simulator.input.predict_s);
  EXPECT_EQ(paper.layout.gap_m, defaults.layout.gap_m);
  EXPECT_EQ(paper.layout.row_y_m, defaults.layout.row_y_m);
  EXPECT_EQ(paper.layout.start_distance_m, defaults.layout.start_distance_m);
  EXPECT_EQ(paper.layout.area_m, defaults.layout.area_m);
  EXPECT_EQ(paper.layout.out_of_area, OutOfArea::together) << "the default is that of older logs";
  EXPECT_EQ(defaults.layout.out_of_area, OutOfArea::give_back);
  EXPECT_EQ(paper.layout.clear_m, defaults.layout.clear_m);
  EXPECT_EQ(std::get<DemonstrationBlock>(paper.blocks[0]).duration_s,
            std::get<DemonstrationBlock>(defaults.blocks[0]).duration_s);
}

TEST(PaperProtocol, HasTheDefaultsOfBlocks) {
  const Protocol paper = shipped("paper");
  const auto& introduction = *block_as<Introduction::Block>(paper.blocks[1]);
  EXPECT_EQ(introduction.condition, Introduction::Block{}.condition);
  EXPECT_EQ(introduction.wrong_answer, Introduction::Block{}.wrong_answer);
  const auto& sorting = *block_as<Sorting::Block>(paper.blocks[2]);
  EXPECT_EQ(sorting.max_run, Sorting::Block{}.max_run);
  EXPECT_EQ(sorting.orders, Sorting::Block{}.orders);
  EXPECT_EQ(std::get<BreakBlock>(paper.blocks[3]).least_duration_s, BreakBlock{}.least_duration_s);
  const auto& comparison = *block_as<Comparison::Block>(paper.blocks[4]);
  EXPECT_EQ(comparison.condition, Comparison::Block{}.condition);
  EXPECT_EQ(comparison.catch_fraction, Comparison::Block{}.catch_fraction);
  EXPECT_EQ(comparison.sides, Comparison::Block{}.sides);
  EXPECT_EQ(comparison.positive_answer, Comparison::Block{}.positive_answer);
  EXPECT_EQ(comparison.interleaving.interleave, InterleaveConfig{}.interleave);
  EXPECT_EQ(comparison.interleaving.max_lag, InterleaveConfig{}.max_lag);
  const auto& written = comparison.staircases[0].staircase.get_if<UpDown>()->config();
  const UpDownConfig defaults;
  EXPECT_EQ(written.min_step, defaults.min_step);
  EXPECT_EQ(written.step_scale, defaults.step_scale);
  EXPECT_EQ(written.initial_1up1down, defaults.initial_1up1down);
  EXPECT_EQ(written.at_bound, defaults.at_bound);
  EXPECT_EQ(written.bound_is_reversal, defaults.bound_is_reversal);
  EXPECT_EQ(written.change_step, defaults.change_step);
  EXPECT_EQ(written.stop_reversals, defaults.stop_reversals);
  EXPECT_EQ(written.min_trials, defaults.min_trials);
  EXPECT_EQ(written.discard_reversals, defaults.discard_reversals);
  EXPECT_EQ(defaults.halve_every, 0);
  EXPECT_EQ(defaults.stop_trials, 200);
}

TEST(Protocol, APairIsOneStaircaseFromAboveAndOneFromBelow) {
  const Protocol protocol = parse_protocol(
      "title = \"t\"\n[[block]]\nkind = \"comparison\"\nname = \"c\"\ncatch_trials = 4\n"
      "[[block.staircase]]\nname = \"s\"\npaired = true\nreference_g = 200\nstart = 90\n"
      "step = 5\nfloor = 3\n",
      "pair.toml");
  const auto& block = *block_as<Comparison::Block>(protocol.blocks[0]);
  ASSERT_EQ(block.staircases.size(), 2U);
  const auto of = [&](std::size_t i) {
    return block.staircases[i].staircase.get_if<UpDown>()->config();
  };
  EXPECT_EQ(block.staircases[0].staircase.name(), "s from above");
  EXPECT_EQ(block.staircases[1].staircase.name(), "s from below");
  EXPECT_EQ(of(0).start, 90);
  EXPECT_EQ(of(1).start, 3);  // the floor, where nothing else is said
  EXPECT_EQ(of(0).step, of(1).step);
  EXPECT_EQ(block.staircases[1].reference_g, 200);
  EXPECT_EQ(block.catch_trials[0].trials, 4);
}

TEST(PairedStaircases, StartEachReferenceFromAboveAndFromNearZero) {
  const Protocol protocol = shipped("examples/paired_staircases");
  const auto& comparison = *block_as<Comparison::Block>(protocol.blocks.back());
  EXPECT_EQ(comparison.catch_fraction, 0);
  std::map<double, int> catches;
  for (const auto& [reference_g, trials] : comparison.catch_trials) catches[reference_g] = trials;
  EXPECT_EQ(catches, (std::map<double, int>{{15, 10}, {200, 10}, {800, 10}}));
  EXPECT_EQ(comparison.sides, Sides::random);
  std::map<double, std::pair<int, int>> starts;  // above, near zero
  for (const auto& [reference_g, procedure, technique] : comparison.staircases) {
    const auto& staircase = procedure.get_if<UpDown>()->config();
    ++(staircase.start > 2 * *staircase.step ? starts[reference_g].first
                                             : starts[reference_g].second);
  }
  EXPECT_EQ(starts,
            (std::map<double, std::pair<int, int>>{{15, {1, 1}}, {200, {1, 1}}, {800, {1, 1}}}));
}

TEST(Slots, AreInARowAroundTheMiddle) {
  Layout layout;
  layout.cube_size_m = 0.04;
  layout.gap_m = 0.06;
  layout.row_y_m = 0.01;
  const auto slots = slot_positions(layout, 3);
  ASSERT_EQ(slots.size(), 3u);
  EXPECT_TRUE(slots[0].isApprox(Eigen::Vector3d(-0.1, 0.01, 0.02)));
  EXPECT_TRUE(slots[1].isApprox(Eigen::Vector3d(0, 0.01, 0.02)));
  EXPECT_TRUE(slots[2].isApprox(Eigen::Vector3d(0.1, 0.01, 0.02)));
  EXPECT_DOUBLE_EQ(slot_positions(layout, 2)[0].x(), -0.05);
}

TEST(Stage, HasTheProtocolsGeometry) {
  Protocol protocol;
  protocol.display_rate_hz = 30;
  protocol.layout.start_distance_m = 0.07;
  const Stage stage = stage_of(protocol, 2);
  EXPECT_EQ(stage.n_slots(), 2);
  EXPECT_EQ(stage.display_rate_hz, 30);
  EXPECT_EQ(stage.start_distance_m, 0.07);
  EXPECT_EQ(stage.effector_size_m, protocol.effector_size_m);
}

TEST(Scene, HasTheTrialsCubesInKilograms) {
  Protocol protocol;
  const Scene scene = scene_of(protocol, "C1", {800, 15});
  EXPECT_FALSE(scene.coupling.decoupled);
  EXPECT_TRUE(scene_of(protocol, "C2", {800, 15}).coupling.decoupled);
  ASSERT_EQ(scene.cubes.size(), 2u);
  EXPECT_DOUBLE_EQ(scene.cubes[0].mass_kg, 0.8);
  EXPECT_DOUBLE_EQ(scene.cubes[1].mass_kg, 0.015);
  EXPECT_LT(scene.cubes[0].position_m.x(), scene.cubes[1].position_m.x());
  EXPECT_DOUBLE_EQ(scene.cubes[0].position_m.z(), protocol.layout.cube_size_m / 2);
}

TEST(Scene, HasTheProtocolsContactsUnlessATechniqueHasItsOwn) {
  const Protocol protocol = parse_protocol(
      "title = \"t\"\n[physics]\ncontact_compliance_m_per_n = 0.0001\n"
      "[[technique]]\nname = \"rigid\"\nkind = \"spring\"\ncontact_compliance_m_per_n = 0\n"
      "[[block]]\nkind = \"demonstration\"\nname = \"demo\"\nduration_s = 20\n",
      "p.toml");
  EXPECT_EQ(scene_of(protocol, "C1", {}).contact_compliance_m_per_n, 1e-4);
  EXPECT_EQ(scene_of(protocol, "rigid", {}).contact_compliance_m_per_n, 0);
}

TEST(Scene, CubesMayHaveTheirOwnFrictionOnTheTable) {
  const Protocol protocol;
  const Scene scene = scene_of(protocol, "C2", {100, 200}, {0.4, 0.2});
  EXPECT_EQ(scene.table_friction(0), 0.4);
  EXPECT_EQ(scene.table_friction(1), 0.2);
  EXPECT_EQ(scene.friction, 0.8);
  EXPECT_EQ(scene_of(protocol, "C2", {100}).table_friction(0), 0.8);
}

TEST(Scene, MultipliesFrictionGivenPerBody) {
  Protocol protocol;
  EXPECT_DOUBLE_EQ(scene_of(protocol, "C2", {}).friction, 0.8);
  protocol.friction_is = FrictionIs::per_body;
  EXPECT_DOUBLE_EQ(scene_of(protocol, "C2", {}).friction, 0.64);
}

}  // namespace
}  // namespace heft
