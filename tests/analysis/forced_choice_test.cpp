// Forced choices: thresholds against an independent fit (direct search of the same likelihood), and
// that they stay out of the figures of three-way comparisons.
#include <gmock/gmock.h>

#include <map>

#include "Figures.h"
#include "MadeUpSessions.h"

namespace heft {
namespace {

using namespace made_up;

// By level: how often the reference and the comparison were chosen.
using Counts = std::map<double, std::pair<int, int>>;

SessionData chooser(std::int64_t id, const char* participant, const Counts& counts) {
  SessionData data = session(id, participant);
  for (const auto& [level_g, n] : counts)
    for (int i = 0; i < n.first + n.second; ++i) {
      Attempt& attempt = add_comparison(data, "constant", 200, level_g);
      attempt.answers_offered = ComparisonAnswers::heavier;
      attempt.trial.plan.condition = "C2";
      attempt.trial.outcome = "difference";
      attempt.trial.chosen_slot = i < n.first ? 1 : 2;  // the reference is on the left
    }
  return data;
}

const Counts both_signs{{-160, {39, 1}}, {-80, {34, 6}}, {-40, {25, 15}},
                        {40, {12, 28}},  {80, {5, 35}},  {160, {1, 39}}};
const Counts heavier{{40, {16, 24}}, {80, {11, 29}}, {160, {4, 36}}, {320, {1, 39}}};

TEST(ForcedChoice, LevelsOfBothSignsGiveThresholdAndPointOfEquality) {
  const Summary summary = summarized({chooser(1, "a", both_signs)});
  const StudyEstimate threshold = figure(summary, "forced_threshold_75");
  EXPECT_NEAR(*threshold.value, 48.2439, 2e-3);
  EXPECT_LT(*threshold.low, *threshold.value);
  EXPECT_GT(*threshold.high, *threshold.value);
  EXPECT_EQ(threshold.n_trials, 240);
  EXPECT_NEAR(*figure(summary, "forced_pse").value, -6.3402, 2e-3);
  const StudyEstimate share = figure(summary, "forced_chosen", {{"level_g", "-40"}});
  EXPECT_DOUBLE_EQ(*share.value, 37.5);
  EXPECT_EQ(share.n_hits, 15);
}

TEST(ForcedChoice, HeavierComparisonsGiveTheThresholdAlone) {
  const Summary summary = summarized({chooser(1, "a", heavier)});
  EXPECT_NEAR(*figure(summary, "forced_threshold_75").value, 90.4185, 2e-3);
  EXPECT_FALSE(find_estimate(summary.estimates, "forced_pse"));
}

TEST(ForcedChoice, IsMeanOverParticipants) {
  const Summary summary = summarized({chooser(1, "a", both_signs), chooser(2, "b", heavier)});
  const StudyEstimate threshold = figure(summary, "forced_threshold_75", {{"participant", ""}});
  EXPECT_NEAR(*threshold.value, (48.2439 + 90.4185) / 2, 2e-3);
  EXPECT_EQ(threshold.n, 2);
  EXPECT_EQ(threshold.method, "Student's t");
}

TEST(ForcedChoice, OfACoinHasNoThresholdButAReason) {
  const Summary summary =
      summarized({chooser(1, "coin", {{-80, {20, 20}}, {0, {21, 19}}, {80, {20, 20}}})});
  const StudyEstimate threshold = figure(summary, "forced_threshold_75");
  EXPECT_FALSE(threshold.value || threshold.low || threshold.high);
  EXPECT_FALSE(threshold.why.empty());
}

TEST(ForcedChoice, StaysOutOfThreeWayComparisons) {
  const SessionData data = chooser(1, "a", both_signs);
  EXPECT_FALSE(data.attempts.front().is_usable_comparison());
  EXPECT_TRUE(data.attempts.front().is_usable_comparison(ComparisonAnswers::heavier));
  EXPECT_FALSE(find_estimate(summarized({data}).estimates, "sensitivity"));
}

}  // namespace
}  // namespace heft
