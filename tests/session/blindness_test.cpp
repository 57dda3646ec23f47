// What a simulated participant can and cannot perceive, with rigid-body physics.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "apparatus/TrialWorld.h"
#include "apparatus/sources/PictureSource.h"
#include "base/Random.h"
#include "engine/RunningAttempt.h"
#include "session/Protocols.h"
#include "tasks/Offers.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft {
namespace {

using testing::small_protocol;

// Changes a displayed frame before the participant sees it.
using Change = std::function<void(DisplayedFrame&)>;

struct Sorted {
  std::vector<TimedAction> actions;
  Outcome outcome = "dont_know";
  std::vector<std::optional<Label>> labels;

  // The same actions at the same times.
  bool operator==(const Sorted& other) const {
    return labels == other.labels &&
           std::ranges::equal(actions, other.actions,
                              [](const TimedAction& a, const TimedAction& b) {
                                return a.t_s == b.t_s && a.kind == b.kind && a.slot == b.slot &&
                                       a.label == b.label;
                              });
  }
};

// One sorting trial from its start to its answer.
Sorted sort_cubes(
    const Protocol& protocol, const std::string& condition, std::vector<double> masses_g,
    std::uint64_t seed, const Change& change = [](DisplayedFrame&) {}) {
  TrialPlan plan;
  plan.trial_number = 1;
  plan.task = "sorting";
  plan.condition = condition;
  plan.masses_g = std::move(masses_g);
  ResponderOptions options;
  options.seed = seed;
  const auto responder = responder_named("simulated").make(options);
  responder->begin_trial({1, 1, "sorting", stage_of(protocol, 3)});
  TrialWorld world(protocol, plan);
  TrialRow row;
  row.attempt_index = 1;
  RunningAttempt attempt(row, TaskBlock(Sorting::Block{}).trial(plan, seed), false);
  HandPictures pictures(*responder, protocol.display_rate_hz);
  pictures.begin_attempt({});
  Sorted answer;
  for (;;) {
    ShownFrame shown = world.advance(pictures.next()->sample);
    for (const Event& event : shown.events)
      if (event.as<CubesShown>()) attempt.show(event.t_s);
    change(shown.frame);
    for (const TimedAction& action : responder->see(shown.frame, attempt.screen())) {
      EXPECT_EQ(attempt.refusal({action.t_s, Action(action)}), std::nullopt);
      answer.actions.push_back(action);
      attempt.act(action, action.t_s);
      if (attempt.has_ended()) {
        answer.outcome = *attempt.row().outcome;
        answer.labels = labels_on(attempt.screen());
        return answer;
      }
    }
  }
}

TEST(Blindness, PermutingTheMassesInC1LeavesEveryAnswerUnchanged) {
  const Protocol protocol = small_protocol();
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    std::vector<double> masses_g{15, 200, 800};
    const Sorted first = sort_cubes(protocol, "C1", masses_g, seed);
    while (std::ranges::next_permutation(masses_g).found)
      EXPECT_EQ(sort_cubes(protocol, "C1", masses_g, seed), first) << "seed " << seed;
  }
}

TEST(Blindness, HidingTheCloneDropsC2SortingToChance) {
  const Protocol protocol = small_protocol();
  constexpr int n = 120;
  int n_right = 0, n_right_hidden = 0, n_answered_hidden = 0;
  for (std::uint64_t seed = 0; seed < n; ++seed) {
    std::vector<double> masses_g{15, 200, 800};
    RandomStream(seed, "order").shuffle(std::span(masses_g));
    n_right += sort_cubes(protocol, "C2", masses_g, seed).outcome == "correct";
    const Outcome hidden = sort_cubes(protocol, "C2", masses_g, seed, [](DisplayedFrame& frame) {
                             frame.clone.reset();
                           }).outcome;
    n_right_hidden += hidden == "correct";
    n_answered_hidden += hidden != "dont_know";
  }
  EXPECT_GT(n_right, n * 3 / 4);
  // One in six answered trials is correct by chance: within four standard errors.
  ASSERT_GT(n_answered_hidden, 20);
  const double chance = 1.0 / 6;
  EXPECT_NEAR(n_right_hidden, n_answered_hidden * chance,
              4 * std::sqrt(n_answered_hidden * chance * (1 - chance)));
}

TEST(Blindness, HalvingTheDisplayRateChangesWhatIsPerceived) {
  Protocol protocol = small_protocol();
  int n_changed = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    protocol.display_rate_hz = 15;
    const Sorted at_15 = sort_cubes(protocol, "C2", {15, 200, 800}, seed);
    protocol.display_rate_hz = 7.5;
    n_changed += !(sort_cubes(protocol, "C2", {15, 200, 800}, seed) == at_15);
  }
  EXPECT_GT(n_changed, 5);
}

}  // namespace
}  // namespace heft
