// Magnitude estimation: means, geometric means and exponents, computed by hand.
#include <gmock/gmock.h>

#include "Figures.h"
#include "MadeUpSessions.h"

namespace heft {
namespace {

using namespace made_up;
using testing::HasSubstr;

Attempt& add_number(SessionData& data, double mass_g, double number) {
  Attempt& attempt = add_attempt(data, "estimation", {mass_g});
  attempt.trial.plan.condition = "C2";
  attempt.trial.outcome = "estimated";
  attempt.trial.value = number;
  return attempt;
}

// Estimates of 100 g and 10 kg: one person gives the square root, the other the number of grams and
// once 0.
std::vector<SessionData> two_people() {
  SessionData root = session(1, "root"), grams = session(2, "grams");
  add_number(root, 100, 10);
  add_number(root, 10000, 100);
  add_number(grams, 100, 100);
  add_number(grams, 100, 0);
  add_number(grams, 10000, 10000);
  add_number(grams, 10000, 777).trial.status = TrialStatus::voided;
  return {root, grams};
}

TEST(Estimation, MeansAreOfEachParticipantsMean) {
  const Summary summary = summarized(two_people());
  const StudyEstimate light = figure(summary, "estimation_mean", {{"mass_g", "100"}});
  EXPECT_DOUBLE_EQ(*light.value, (10 + (100 + 0) / 2.0) / 2);
  EXPECT_DOUBLE_EQ(*light.sd, 40 / std::sqrt(2));  // of 10 and 50
  EXPECT_EQ(light.n, 2);
  EXPECT_EQ(light.n_trials, 3);
  EXPECT_DOUBLE_EQ(*figure(summary, "estimation_mean", {{"mass_g", "10000"}}).value, 5050);
}

TEST(Estimation, GeometricMeansAreOfNumbersAboveZeroAndTheOthersAreCounted) {
  const Summary summary = summarized(two_people());
  const StudyEstimate light = figure(summary, "estimation_geometric_mean", {{"mass_g", "100"}});
  EXPECT_NEAR(*light.value, std::sqrt(10.0 * 100), 1e-9);
  // The logarithms differ by log 10: their SD is that / sqrt 2, and t of one degree 12.706.
  EXPECT_NEAR(std::log(*light.high / *light.value), 12.7062 * std::log(10) / 2, 1e-4);
  EXPECT_NEAR(*light.value * *light.value, *light.low * *light.high, 1e-6);
  EXPECT_EQ(light.n_trials, 2);
  const StudyEstimate left_out = figure(summary, "estimation_left_out", {{"mass_g", "100"}});
  EXPECT_EQ(left_out.value, 1);
  EXPECT_EQ(left_out.n_trials, 3);
  EXPECT_EQ(figure(summary, "estimation_left_out", {{"mass_g", "10000"}}).value, 0);
}

TEST(Estimation, ExponentsAreSlopesOnLogarithms) {
  const Summary summary = summarized(two_people());
  const auto exponent = [&](const char* participant) {
    return figure(summary, "estimation_exponent", {{"participant", participant}});
  };
  EXPECT_NEAR(*exponent("root").value, 0.5, 1e-12);
  EXPECT_NEAR(*exponent("grams").value, 1, 1e-12);
  EXPECT_EQ(exponent("grams").n_trials, 2);
  EXPECT_NEAR(*exponent("").value, 0.75, 1e-12);
  EXPECT_NEAR(*exponent("").sd, 0.5 / std::sqrt(2), 1e-12);
  EXPECT_TRUE(exponent("").why.empty());
}

TEST(Estimation, WhoGaveNoNumbersAboveZeroIsCountedAndTheReasonGiven) {
  std::vector<SessionData> sessions = two_people();
  sessions.push_back(session(3, "nothing"));
  add_number(sessions.back(), 100, 0);
  add_number(sessions.back(), 10000, 3);
  const Summary summary = summarized(sessions);
  const StudyEstimate light = figure(summary, "estimation_geometric_mean", {{"mass_g", "100"}});
  EXPECT_NEAR(*light.value, std::sqrt(10.0 * 100), 1e-9);
  EXPECT_EQ(light.n, 2);
  EXPECT_EQ(light.why, "1 of 3 participants have none: no number above 0");
  const StudyEstimate exponent = figure(summary, "estimation_exponent");
  EXPECT_EQ(exponent.n, 2);
  EXPECT_THAT(exponent.why, HasSubstr("1 of 3 participants have none: numbers above 0 at fewer"));
  EXPECT_THAT(readable(summary), HasSubstr("1 of 3 participants have none: no number above 0"));
}

// Numbers proportional to the friction times the square of the mass.
TEST(Estimation, ExponentsOfMassAndFrictionAreOfOneRegression) {
  SessionData data = session(1, "a");
  const auto add = [&](double mass_g, double friction, double number) {
    add_number(data, mass_g, number).cubes[0].table_friction = friction;
  };
  add(100, 0.2, 1);
  add(200, 0.2, 4);
  add(200, 0.8, 16);
  const Summary summary = summarized({data});
  EXPECT_NEAR(*figure(summary, "estimation_exponent").value, 2, 1e-9);
  EXPECT_NEAR(*figure(summary, "estimation_friction_exponent").value, 1, 1e-9);
  const auto mean_of = [&](const char* friction) {
    return *figure(summary, "estimation_mean", {{"mass_g", "200"}, {"table_friction", friction}})
                .value;
  };
  EXPECT_EQ(mean_of("0.2"), 4);
  EXPECT_EQ(mean_of("0.8"), 16);
  EXPECT_THAT(readable(summary), HasSubstr("(of friction: 1.00)"));
}

TEST(Estimation, MassAndFrictionThatVaryTogetherAreNotIdentifiable) {
  SessionData data = session(1, "a");
  add_number(data, 100, 10).cubes[0].table_friction = 0.8;
  add_number(data, 200, 10).cubes[0].table_friction = 0.4;
  add_number(data, 400, 10).cubes[0].table_friction = 0.2;
  const Summary summary = summarized({data});
  EXPECT_FALSE(figure(summary, "estimation_exponent").value);
  EXPECT_THAT(figure(summary, "estimation_exponent").why, HasSubstr("varied together"));
}

TEST(Estimation, OfOneMassThereIsNoExponent) {
  SessionData data = session(1, "a");
  add_number(data, 100, 5);
  const StudyEstimate exponent = figure({data}, "estimation_exponent");
  EXPECT_FALSE(exponent.value.has_value());
  EXPECT_FALSE(exponent.why.empty());
}

}  // namespace
}  // namespace heft
