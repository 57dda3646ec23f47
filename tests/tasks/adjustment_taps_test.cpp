// Adjustment by taps: the log has the steps that were tapped, and no mass changes under the
// effector.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "SourceFolder.h"
#include "base/Random.h"
#include "base/math/Geometry.h"
#include "protocol/readers/Files.h"
#include "session/TappedSession.h"
#include "tasks/Adjustment.h"

namespace heft {
namespace {

using testing::Tap;
using testing::TappedScreen;
using testing::TappedSession;

/// Taps up to four random steps in each trial, and confirms.
class Adjuster {
 public:
  explicit Adjuster(std::uint64_t seed) : random_(seed, "adjuster") {}

  std::optional<Tap> operator()(const TappedScreen& screen) {
    return testing::tap_on(screen.control(wanted_on(screen)), random_);
  }

  /// The steps of each trial, g.
  std::map<int, std::vector<double>> meant;

 private:
  std::string wanted_on(const TappedScreen& screen) {
    const ScreenState& state = screen.screen();
    if (state.screen != Screen::trial) return screen.control("more") ? "more" : "next";
    if (state.faded || !state.can_answer) return "";
    const auto [found, is_new] = meant.try_emplace(state.trial_number);
    if (is_new) n_wanted_ = random_.below(5);
    const auto& offer = std::any_cast<const Adjustment::Offer&>(state.offer);
    EXPECT_EQ(screen.page().marks.at(0).slot, offer.slot) << "the cube that changes is marked";
    const auto n_taken = static_cast<std::size_t>(state.n_choices);
    if (n_taken == n_wanted_) return "equal";
    if (found->second.size() == n_taken) {  // otherwise the last tap came too early
      std::vector<std::size_t> possible;
      for (std::size_t i = 0; i < offer.steps.size(); ++i)
        if (offer.steps[i].is_possible) possible.push_back(i);
      wanted_ = possible.at(random_.below(possible.size()));
      found->second.push_back(offer.steps[wanted_].change_g);
    }
    return fmt::format("adjust_{}", wanted_ + 1);
  }

  RandomStream random_;
  std::size_t n_wanted_ = 0, wanted_ = 0;
};

Adjustment::Block adjustments() {
  Adjustment::Block block;
  block.name = "adjustment";
  block.reference_g.values = {100, 200};
  block.start_g = {20, 500};
  block.steps_g = {50, 10};
  block.trials = {{"C2", 25}};
  return block;
}

TEST(AdjustmentTaps, WhatWasTappedIsWhatIsLogged) {
  std::uint64_t seed = 0;
  for (const testing::TappedSetting& setting : testing::tapped_settings()) {
    SCOPED_TRACE(::testing::PrintToString(setting));
    Adjuster adjuster(++seed);
    TappedSession session(testing::protocol_alone(adjustments()), std::ref(adjuster), setting);
    ASSERT_EQ(session.run(), RunEnd::finished);
    std::map<int, double> set_g;
    std::map<int, std::vector<double>> logged;
    TrialRow open;
    for (const RecordedEntry& entry : session.sink.entries()) {
      const auto* recorded = std::get_if<RecordedEvent>(&entry);
      if (!recorded) continue;
      if (recorded->changes.trial) open = *recorded->changes.trial;
      const int number = open.plan.trial_number;
      for (const AnswerRow& answer : recorded->changes.answers) {
        logged.try_emplace(number);
        if (answer.action == "adjust") logged[number].push_back(*answer.value);
      }
      if (open.status == TrialStatus::completed) set_g[number] = *open.value;
      if (open.status != TrialStatus::completed || !recorded->changes.trial) continue;
      double sum_g = *open.plan.reference_g + *open.plan.level_g;
      for (const double step_g : adjuster.meant[number]) sum_g += step_g;
      EXPECT_NEAR(*open.value, sum_g, 1e-9) << "trial " << number;
    }
    EXPECT_EQ(set_g.size(), 50u);
    EXPECT_EQ(logged, adjuster.meant);
  }
}

// The hand keeps pushing while it taps: the cubes with the new mass appear only once the effector
// is clear of their places.
TEST(AdjustmentTaps, CubesWithANewMassAppearClearOfTheEffector) {
  Adjuster adjuster(9);
  TappedSession session(testing::protocol_alone(adjustments()),
                        load_texts(source_folder() + "/protocols/texts/en.toml"),
                        std::ref(adjuster));
  ASSERT_EQ(session.run(), RunEnd::finished);
  int n_without_cubes = 0, n_replaced = 0;
  bool is_step = false;  // and no frame with cubes since
  for (const RecordedEntry& entry : session.sink.entries()) {
    if (const auto* recorded = std::get_if<RecordedEvent>(&entry)) {
      if (const auto* action = recorded->event.as<Action>()) is_step = action->kind == "adjust";
      continue;
    }
    const FrameRow& frame = std::get<FrameRow>(entry);
    if (!is_step) continue;
    if (frame.cubes.empty()) {
      ++n_without_cubes;
      continue;
    }
    is_step = false;
    ++n_replaced;
    EXPECT_FALSE(frame.contact_slot);
    const Stage stage = stage_of(*session.protocol, 2);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(frame.cubes[i].position_m, stage.slots_m[i]);
      EXPECT_FALSE(boxes_overlap(frame.cubes[i], Eigen::Vector3d::Constant(stage.cube_size_m),
                                 frame.effector, stage.effector_size_m));
    }
  }
  EXPECT_GT(n_replaced, 50);
  EXPECT_GT(n_without_cubes, 20) << "the effector was among the cubes in some of the steps";
}

}  // namespace
}  // namespace heft
