// Forced choices: thresholds against an independent fit (direct search of the same likelihood), and
// that they are excluded from the figures of three-way comparisons.
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <memory>

#include "Figures.h"
#include "MadeUpSessions.h"
#include "psychophysics/ProcedureKinds.h"

namespace heft {
namespace {

using namespace made_up;

// By level: how often the reference and the comparison were chosen.
using Counts = std::map<double, std::pair<int, int>>;

void add_choices(SessionData& data, const Counts& counts, double reference_g, double times = 1) {
  for (const auto& [level_g, n] : counts)
    for (int i = 0; i < n.first + n.second; ++i) {
      Attempt& attempt = add_comparison(data, "constant", reference_g, times * level_g);
      attempt.answers_offered = ComparisonAnswers::heavier;
      attempt.trial.plan.condition = "C2";
      attempt.trial.outcome = "difference";
      attempt.trial.chosen_slot = i < n.first ? 1 : 2;  // the reference is on the left
    }
}

SessionData chooser(std::int64_t id, const char* participant, const Counts& counts) {
  SessionData data = session(id, participant);
  add_choices(data, counts, 200);
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

TEST(ForcedChoice, IsGeometricMeanOverParticipants) {
  const Summary summary = summarized({chooser(1, "a", both_signs), chooser(2, "b", heavier)});
  const StudyEstimate threshold = figure(summary, "forced_threshold_75", {{"participant", ""}});
  const double ratio = std::sqrt(90.4185 / 48.2439);
  EXPECT_NEAR(*threshold.value, 48.2439 * ratio, 2e-3);
  const double t_of_1_degree = 12.7062;
  EXPECT_NEAR(std::log(*threshold.high / *threshold.value), t_of_1_degree * std::log(ratio), 1e-3);
  EXPECT_NEAR(std::log(*threshold.value / *threshold.low), t_of_1_degree * std::log(ratio), 1e-3)
      << "above 0";
  EXPECT_EQ(threshold.n, 2);
  EXPECT_EQ(threshold.method, "Student's t of logarithms");
}

// One whose thresholds are proportional to the reference, and one whose thresholds are equal.
TEST(WeberFraction, AndTheExponentOfThresholds) {
  SessionData weber = session(1, "weber"), equal = session(2, "equal");
  for (SessionData* data : {&weber, &equal}) {
    add_choices(*data, both_signs, 200);
    add_choices(*data, both_signs, 600, data == &weber ? 3 : 1);
  }
  const Summary summary = summarized({weber, equal});
  const auto of = [&](const char* measure, const char* participant, const char* reference_g) {
    return figure(summary, measure, {{"participant", participant}, {"reference_g", reference_g}});
  };
  for (const char* reference_g : {"200", "600"})
    EXPECT_NEAR(*of("forced_weber_fraction", "weber", reference_g).value, 48.2439 / 200, 1e-5);
  EXPECT_NEAR(*of("forced_weber_fraction", "equal", "600").value, 48.2439 / 600, 1e-5);
  EXPECT_NEAR(*of("forced_weber_fraction", "equal", "600").high,
              *of("forced_threshold_75", "equal", "600").high / 600, 1e-9);
  EXPECT_NEAR(*of("forced_weber_fraction", "", "600").value, 48.2439 / 600 * std::sqrt(3), 1e-5);
  EXPECT_NEAR(*of("forced_threshold_exponent", "weber", "").value, 1, 1e-4);
  EXPECT_NEAR(*of("forced_threshold_exponent", "equal", "").value, 0, 1e-4);
  const StudyEstimate exponent = of("forced_threshold_exponent", "", "");
  EXPECT_NEAR(*exponent.value, 0.5, 1e-4);
  EXPECT_NEAR(*exponent.high, 0.5 + 12.7062 * 0.5, 1e-3);  // Student's t of one degree
  EXPECT_EQ(exponent.n, 2);
}

TEST(WeberFraction, ExponentNeedsThresholdsAtTwoReferences) {
  SessionData data = session(1, "a");
  add_choices(data, both_signs, 200);
  EXPECT_FALSE(find_estimate(summarized({data}).estimates, "forced_threshold_exponent"));
  add_choices(data, {{-80, {20, 20}}, {80, {20, 20}}}, 600);
  const StudyEstimate exponent = figure({data}, "forced_threshold_exponent");
  EXPECT_FALSE(exponent.value);
  EXPECT_EQ(exponent.why, "a threshold at fewer than two references");
}

TEST(WeberFraction, OfAReferenceOfNoMassIsNone) {
  SessionData data = session(1, "a");
  add_choices(data, heavier, 0);
  EXPECT_FALSE(find_estimate(summarized({data}).estimates, "forced_weber_fraction"));
}

// The goodness of fit itself is tested in tests/inference.
TEST(ForcedChoice, FitsOfConstantStimuliAreJudged) {
  ConstantConfig config;
  config.levels = {-160, -80, -40, 40, 80, 160};
  config.n_per_level = 40;
  SessionData constant = chooser(1, "constant", both_signs);
  constant.staircases["constant"] = {std::make_shared<const Procedure>("constant", config)};
  SessionData lapsing = session(2, "lapsing");
  add_choices(lapsing,
              {{-160, {29, 11}},
               {-80, {30, 10}},
               {-40, {31, 9}},
               {40, {10, 30}},
               {80, {9, 31}},
               {160, {11, 29}}},
              200);
  lapsing.staircases = constant.staircases;
  SessionData adaptive = chooser(3, "adaptive", both_signs);
  UpDownConfig steps;
  steps.start = 160;
  steps.step = 40;
  steps.stop_reversals = 8;
  steps.stop_trials = 60;
  adaptive.staircases["constant"] = {std::make_shared<const Procedure>("constant", steps)};
  const SessionData unknown = chooser(4, "unknown", both_signs);
  const Summary summary = summarized({constant, lapsing, adaptive, unknown});
  const auto p_of = [&](const char* participant) {
    return figure(summary, "forced_fit_p", {{"participant", participant}});
  };
  EXPECT_GT(*p_of("constant").value, 0.05);
  EXPECT_LT(*p_of("lapsing").value, 0.05);
  EXPECT_FALSE(p_of("adaptive").value);
  EXPECT_EQ(p_of("adaptive").why, "an adaptive procedure chose the differences by earlier answers");
  EXPECT_EQ(p_of("unknown").why, "the procedure that chose the differences is unknown");
  const StudyEstimate rejected = figure(summary, "forced_fits_rejected");
  EXPECT_EQ(rejected.value, 1);
  EXPECT_EQ(rejected.n, 2);
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
