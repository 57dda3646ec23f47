// The check of the participant's display before a session, and its verdicts on a slow one.
#include <gmock/gmock.h>

#include "session/DisplayCheck.h"
#include "session/Protocols.h"
#include "session/TappedScreen.h"
#include "tasks/Tasks.h"

namespace heft {
namespace {

using ::testing::HasSubstr;
using testing::made_up_monotonic;
using testing::made_up_s;
using testing::quick_protocol;
using testing::short_comparison;

/// A display on which each frame takes simulated time.
class SlowDisplay final : public ArView {
 public:
  explicit SlowDisplay(double frame_s) : frame_s_(frame_s) {}

  std::optional<double> present(const ViewFrame& shown, const ScreenState& screen) override {
    made_up_s += frame_s_;
    frames.push_back(shown);
    screens.push_back(screen);
    return made_up_s;
  }
  std::vector<Touch> wait(double seconds) override {
    made_up_s += std::max(seconds, 1e-4);
    return {};
  }
  std::optional<DisplayFacts> display() const override { return DisplayFacts{}; }

  std::vector<ViewFrame> frames;
  std::vector<ScreenState> screens;

 private:
  double frame_s_;
};

Protocol protocol_at_15_hz() {
  Protocol protocol = quick_protocol();
  protocol.display_rate_hz = 15;
  return protocol;
}

std::vector<CheckResult> checked(ArView& view, const Protocol& protocol) {
  const auto hand = responder_named("simulated").make({});
  HandPictures pictures(*hand, protocol.display_rate_hz);
  SessionClock clock = SessionClock::wall_from(0, made_up_monotonic);
  return check_equipment({protocol, pictures, *hand, view, clock});
}

CheckVerdict verdict_with(double frame_s) {
  SlowDisplay view(frame_s);
  const auto results = checked(view, protocol_at_15_hz());
  EXPECT_EQ(results.size(), 1u);
  return results.front().verdict;
}

TEST(DisplayCheck, PresentsATrialsPicturesOnThePageOfTheProtocolsTrials) {
  SlowDisplay view(0.004);
  const Protocol protocol = protocol_at_15_hz();
  const auto results = checked(view, protocol);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results.front().verdict, CheckVerdict::ok) << results.front().finding;
  EXPECT_THAT(results.front().finding, HasSubstr("a picture each 66.7 ms, 4 ms after its capture"));
  ASSERT_EQ(view.frames.size(), 61u) << "60 and the first, which does not count";
  EXPECT_EQ(view.frames.back().frame.cubes.size(), 3u);
  EXPECT_EQ(view.screens.back().task, "sorting");
  EXPECT_FALSE(view.screens.back().can_answer);
}

TEST(DisplayCheck, FailsWhereAFrameTakesLongerThanItsPeriod) {
  EXPECT_EQ(verdict_with(0.050), CheckVerdict::ok);
  EXPECT_EQ(verdict_with(0.080), CheckVerdict::failed);
  EXPECT_EQ(verdict_with(0.300), CheckVerdict::failed);
}

TEST(DisplayCheck, HasATrialsPageForAProtocolWithoutTrials) {
  SlowDisplay view(0.004);
  Protocol protocol = protocol_at_15_hz();
  protocol.blocks.clear();
  checked(view, protocol);
  EXPECT_EQ(view.frames.back().frame.cubes.size(), 3u);
}

// Otherwise a forced choice would show "no difference" until its first trial.
TEST(DisplayCheck, ShowsTheAnswersOfTheProtocolsTrials) {
  Protocol protocol = protocol_at_15_hz();
  Comparison::Block block = short_comparison(3);
  for (const ComparisonAnswers answers :
       {ComparisonAnswers::heavier, ComparisonAnswers::same_different,
        ComparisonAnswers::heavier_or_none}) {
    SlowDisplay view(0.004);
    block.answers = answers;
    protocol.blocks = {block};
    checked(view, protocol);
    ASSERT_FALSE(view.screens.empty());
    for (const ScreenState& screen : view.screens)
      EXPECT_EQ(offer_of<Comparison>(screen.offer).answers, answers);
  }
  block.reference = RealObject{"brass cylinder", 15};
  protocol.blocks = {block};
  SlowDisplay view(0.004);
  checked(view, protocol);
  EXPECT_EQ(offer_of<Comparison>(view.screens.back().offer).object, "brass cylinder");
  EXPECT_EQ(view.screens.back().n_slots, 1);
}

/// Pictures at 15 Hz, of which every n-th is late.
std::vector<PresentedPicture> presented(double period_s, int each, double late_s, int n_dropped) {
  std::vector<PresentedPicture> all;
  for (int i = 0; i < 60; ++i) {
    const double capture_s = i * period_s;
    all.push_back({capture_s, capture_s + 0.02 + (i % each == 0 ? late_s : 0), 0});
  }
  all.back().n_dropped = n_dropped;
  return all;
}

TEST(DisplayVerdict, WarnsOfLateAndOfDroppedPictures) {
  constexpr double period_s = 1.0 / 15;
  const auto verdict = [&](int each, double late_s, int n_dropped) {
    return display_verdict(presented(period_s, each, late_s, n_dropped), 15).verdict;
  };
  EXPECT_EQ(verdict(60, 0, 1), CheckVerdict::ok);
  EXPECT_EQ(verdict(20, 0.11, 0), CheckVerdict::ok) << "130 ms is not late";
  EXPECT_EQ(verdict(20, 0.13, 0), CheckVerdict::warning);
  EXPECT_EQ(verdict(60, 0, 2), CheckVerdict::warning);
  EXPECT_EQ(verdict(60, 0, 6), CheckVerdict::warning);
  EXPECT_EQ(verdict(60, 0, 7), CheckVerdict::failed);
}

TEST(DisplayVerdict, FailsWithoutPicturesAndBelowTheProtocolsRate) {
  EXPECT_EQ(display_verdict({}, 15).verdict, CheckVerdict::failed);
  EXPECT_EQ(display_verdict(presented(1 / 13.7, 60, 0, 0), 15).verdict, CheckVerdict::ok);
  const CheckResult slow = display_verdict(presented(1 / 13.4, 60, 0, 0), 15);
  EXPECT_EQ(slow.verdict, CheckVerdict::failed);
  EXPECT_THAT(slow.finding, HasSubstr("the protocol displays one each 66.7 ms"));
}

}  // namespace
}  // namespace heft
