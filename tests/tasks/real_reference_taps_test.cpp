// Fifty comparisons with a real object at the window: lifted, then answered; the tapped answers are
// logged, in both shipped languages and four window sizes.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>

#include "base/Random.h"
#include "psychophysics/Constant.h"
#include "session/TappedSession.h"
#include "tasks/Comparison.h"

namespace heft {
namespace {

using testing::Tap;
using testing::TappedScreen;
using testing::TappedSession;

/// Reports to have lifted the object, then taps an answer, whose button was not available before.
class Lifter {
 public:
  explicit Lifter(std::uint64_t seed) : random_(seed, "lifter") {}

  std::optional<Tap> operator()(const TappedScreen& screen) {
    const ScreenState& state = screen.screen();
    if (state.screen != Screen::trial) return testing::tap_on(testing::onwards(screen), random_);
    if (state.faded || !state.can_answer) return std::nullopt;
    const auto [meant, is_new] = meant_.try_emplace(state.trial_number);
    if (is_new) meant->second = answers[random_.below(answers.size())];
    const Control* answer = screen.control(meant->second);
    EXPECT_TRUE(answer);
    if (!state.can_validate) {
      EXPECT_FALSE(answer->enabled);
      return testing::tap_on(screen.control("lifted"), random_);
    }
    return testing::tap_on(answer, random_);
  }

  const std::map<int, std::string>& meant() const { return meant_; }

 private:
  static constexpr std::array answers{"cube_1", "select_object", "no_difference"};

  RandomStream random_;
  std::map<int, std::string> meant_;
};

std::string control_of(const TrialRow& row) {
  if (row.outcome == "no_difference") return "no_difference";
  return row.chosen_slot == row.plan.reference_slot ? "select_object" : "cube_1";
}

TEST(RealReferenceTaps, WhatWasTappedIsWhatIsLogged) {
  Comparison::Block block;
  block.name = "c";
  block.reference = RealObject{"Mass of brass, label B2", 200};
  block.staircases = {
      {200, {"c", ConstantConfig{.levels = {-100, 0, 50, 100, 200}, .n_per_level = 10}}}};
  std::uint64_t seed = 0;
  for (const testing::TappedSetting& setting : testing::tapped_settings()) {
    SCOPED_TRACE(::testing::PrintToString(setting));
    Lifter lifter(++seed);
    TappedSession session(testing::protocol_alone(block), std::ref(lifter), setting);
    ASSERT_EQ(session.run(), RunEnd::finished);
    std::map<int, std::string> logged;
    for (const RecordedEntry& entry : session.sink.entries())
      if (const auto* recorded = std::get_if<RecordedEvent>(&entry))
        if (const auto& row = recorded->changes.trial; row && row->status == TrialStatus::completed)
          logged[row->plan.trial_number] = control_of(*row);
    EXPECT_EQ(logged.size(), 50u);
    EXPECT_EQ(logged, lifter.meant());
    EXPECT_EQ(testing::events_of(session.sink, event_kind<Action>).size(), 100u)
        << "lifted and answered once in each trial";
  }
}

}  // namespace
}  // namespace heft
