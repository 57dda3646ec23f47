// Adjustments: bias and spread, computed by hand.
#include <gmock/gmock.h>

#include <cmath>

#include "analysis/Figures.h"
#include "analysis/MadeUpSessions.h"

namespace heft {
namespace {

using namespace made_up;
using testing::HasSubstr;

Attempt& add_adjustment(SessionData& data, double reference_g, double value,
                        const std::string& condition = "C2") {
  Attempt& attempt = add_attempt(data, "adjustment", {reference_g, value});
  attempt.trial.plan.block = "adjust";
  attempt.trial.plan.condition = condition;
  attempt.trial.plan.reference_g = reference_g;
  attempt.trial.plan.level_g = 100;
  attempt.trial.outcome = "adjusted";
  attempt.trial.value = value;
  return attempt;
}

// Settings for 100 g: 90, 110 and 130 g by one person, 200 and 50 g by the other; for 200 g: 210 g,
// and 240 g.
std::vector<SessionData> two_people() {
  SessionData one = session(1, "one"), other = session(2, "other");
  for (const double value : {90, 110, 130}) add_adjustment(one, 100, value);
  for (const double value : {200, 50}) add_adjustment(other, 100, value);
  add_adjustment(one, 200, 210);
  add_adjustment(other, 200, 240);
  add_adjustment(other, 100, 777).trial.status = TrialStatus::voided;
  add_adjustment(other, 100, 777, "C1");
  Attempt& judgment = add_adjustment(other, 100, 777);
  judgment.trial.plan.task = "judgment";
  return {one, other};
}

StudyEstimate of(const Summary& summary, const char* measure, const char* reference_g,
                 const char* participant = "") {
  return figure(summary, measure,
                {{"condition", "C2"}, {"reference_g", reference_g}, {"participant", participant}});
}

TEST(AdjustmentBias, IsTheMeanOverPeopleOfEachOnesMean) {
  const Summary summary = summarized(two_people());
  const StudyEstimate light = of(summary, "adjustment_bias", "100");
  EXPECT_DOUBLE_EQ(*light.value, (10 + 25) / 2.0);
  // Student's t of one degree is 12.706; the standard error of 10 and 25 is 7.5.
  EXPECT_NEAR(*light.high - *light.value, 12.7062 * 7.5, 1e-3);
  EXPECT_EQ(light.n, 2);
  EXPECT_EQ(light.n_trials, 5);
  EXPECT_EQ(*of(summary, "adjustment_bias", "200").value, 25);
  EXPECT_EQ(*of(summary, "adjustment_bias", "100", "other").value, 25);
}

TEST(AdjustmentBias, InPercentIsGeometric) {
  const Summary summary = summarized(two_people());
  const double one = std::cbrt(0.9 * 1.1 * 1.3), other = 1;  // double and half
  EXPECT_NEAR(*of(summary, "adjustment_bias_percent", "100", "one").value, 100 * (one - 1), 1e-9);
  EXPECT_NEAR(*of(summary, "adjustment_bias_percent", "100", "other").value, 0, 1e-9);
  const StudyEstimate both = of(summary, "adjustment_bias_percent", "100");
  EXPECT_NEAR(*both.value, 100 * (std::sqrt(one * other) - 1), 1e-9);
  const auto ratio = [](double percent) { return 1 + percent / 100; };
  EXPECT_NEAR(ratio(*both.low) * ratio(*both.high), std::pow(ratio(*both.value), 2), 1e-9)
      << "on logarithms the value is in the middle of its interval";
}

TEST(AdjustmentSpread, IsTheMeanStandardDeviationOfEachPerson) {
  const Summary summary = summarized(two_people());
  EXPECT_DOUBLE_EQ(*of(summary, "adjustment_spread", "100", "one").value, 20);
  EXPECT_DOUBLE_EQ(*of(summary, "adjustment_spread", "100").value, (20 + 150 / std::sqrt(2)) / 2);
  const StudyEstimate heavy = of(summary, "adjustment_spread", "200");
  EXPECT_FALSE(heavy.value) << "each has one setting";
  EXPECT_EQ(heavy.why, "2 of 2 participants have none: a single setting");
}

TEST(AdjustmentStartEffect, IsTheMeanSlopeOfSettingsOnFirstMasses) {
  SessionData one = session(1, "one"), other = session(2, "other"), alike = session(3, "alike");
  // By hand: .3; and (-50 * 90 + 0 * 130 + 50 * 140) / (2 * 50^2) = .5.
  for (const double start_g : {50.0, 90.0, 210.0})
    add_adjustment(one, 100, 100 + 0.3 * (start_g - 100)).trial.plan.level_g = start_g - 100;
  for (const auto& [start_g, set_g] : {std::pair(50, 90), {100, 130}, {150, 140}})
    add_adjustment(other, 100, set_g).trial.plan.level_g = start_g - 100;
  for (const double set_g : {90, 100, 120}) add_adjustment(alike, 100, set_g);
  const Summary summary = summarized({one, other, alike});
  EXPECT_NEAR(*of(summary, "adjustment_start_effect", "100", "one").value, 0.3, 1e-12);
  EXPECT_NEAR(*of(summary, "adjustment_start_effect", "100", "other").value, 0.5, 1e-12);
  EXPECT_FALSE(of(summary, "adjustment_start_effect", "100", "alike").value);
  const StudyEstimate all = of(summary, "adjustment_start_effect", "100");
  EXPECT_NEAR(*all.value, 0.4, 1e-12);
  EXPECT_EQ(all.n, 2);
}

TEST(AdjustmentReport, HasTheBiasAndItsInterval) {
  const Summary summary = summarized(two_people());
  EXPECT_THAT(readable(summary), HasSubstr("Adjustment: masses set equal to the reference"));
  EXPECT_FALSE(figure(summary, "judgment_mean", {{"masses_g", "90"}}).measure);
}

}  // namespace
}  // namespace heft
