// The table of parameters: what files may set, and that every row does something.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "FakeTrial.h"
#include "responders/ResponderParameters.h"

namespace heft {
namespace {
using testing::AllOf;
using testing::HasSubstr;

std::string refusal(std::string_view responder, const std::vector<Parameter>& parameters) {
  try {
    fake::make(responder, 1, parameters);
  } catch (const InvalidFile& invalid) {
    EXPECT_EQ(invalid.exit_code(), ExitCode::invalid_file);
    return invalid.what();
  }
  return "";
}

TEST(Parameters, MistakesAreReportedTogetherAtTheirPlaces) {
  const std::string text = refusal("simulated", {{"criterion_m", 3.0, {"p.toml", 1, 1}},
                                                 {"lapse_rate", 1.5, {"p.toml", 2, 14}},
                                                 {"hold_s", std::string("long"), {"p.toml", 3, 9}},
                                                 {"cue", std::string("ofset"), {"p.toml", 4, 7}},
                                                 {"p", 0.5, {"p.toml", 5, 1}}});
  EXPECT_THAT(text, HasSubstr("p.toml:1:1: unknown parameter \"criterion_m\", did you mean "
                              "\"criterion_mm\"?"));
  EXPECT_THAT(text, HasSubstr("p.toml:2:14: lapse_rate is 1.5, expected 0 to 1"));
  EXPECT_THAT(text, HasSubstr("p.toml:3:9: hold_s must be a number (s)"));
  EXPECT_THAT(text, HasSubstr("p.toml:4:7: cue must be \"offset\" or \"cube_motion\""));
  EXPECT_THAT(text, HasSubstr("p.toml:5:1: unknown parameter \"p\""));
}

TEST(Parameters, AResponderTakesOnlyItsOwn) {
  EXPECT_EQ(refusal("coin", {{"p", 0.25, {}}}), "");
  EXPECT_THAT(refusal("coin", {{"lapse_rate", 0.1, {"c.toml", 1, 1}}}),
              HasSubstr("expected \"p\""));
  EXPECT_EQ(refusal("criterion_only", {{"criterion_mm", 2.0, {}}}), "");
  EXPECT_THAT(refusal("criterion_only", {{"cue", std::string("offset"), {}}}), HasSubstr("cue"));
}

TEST(Parameters, EveryRowSaysAllAboutItselfAndIsDescribed) {
  const std::string text = describe_parameters(responder_named("simulated"));
  for (const ParameterRow& row : parameter_rows()) {
    EXPECT_LE(row.least, row.value) << row.name;
    EXPECT_LE(row.value, row.most) << row.name;
    EXPECT_FALSE(row.reason.empty()) << row.name;
    if (row.part == ParameterPart::coin) continue;
    EXPECT_THAT(
        text, AllOf(HasSubstr(std::string(row.name) + " = "), HasSubstr(std::string(row.reason))));
  }
  EXPECT_THAT(text, HasSubstr("cue = \"offset\""));
  EXPECT_EQ(describe_parameters(responder_named("always_yes")), "");
}

TEST(Parameters, ParticipantsDifferByTheSpreadAndNotAtAllWithoutIt) {
  std::vector<double> logs;
  for (std::uint64_t seed = 0; seed < 2000; ++seed)
    logs.push_back(std::log(participant_parameters({seed, {}, ""}, simulated_parts).criterion_mm /
                            default_parameters().criterion_mm));
  const double n = static_cast<double>(logs.size());
  const double mean = std::accumulate(logs.begin(), logs.end(), 0.0) / n;
  double variance = 0;
  for (double x : logs) variance += (x - mean) * (x - mean) / (n - 1);
  EXPECT_NEAR(mean, 0, 4 * 0.4 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(variance), 0.4, 4 * 0.4 / std::sqrt(2 * n));

  const ResponderOptions alike{5, {{"participant_spread", 0.0, {}}}, ""};
  EXPECT_EQ(participant_parameters(alike, simulated_parts).criterion_mm,
            default_parameters().criterion_mm);
}

// Everything a participant does in a few trials.
std::string trace(const std::vector<Parameter>& parameters) {
  std::string text;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const auto responder = fake::make("simulated", seed, parameters);
    fake::TrialSetup setup;
    setup.trial_number = static_cast<int>(seed) + 1;
    setup.condition = seed % 3 ? "C2" : "C1";
    setup.task = seed % 2 ? "sorting" : "comparison";
    if (setup.task == "comparison") setup.masses_g = {100, 160};
    const auto result = fake::run_trial(*responder, setup);
    for (const Pose& pose : result.hand)
      text += fmt::format("{} {} {} {};", pose.position_m.x(), pose.position_m.y(),
                          pose.position_m.z(), pose.orientation.w());
    for (const TimedAction& action : result.actions) text += fmt::format("{};", action.t_s);
    for (const std::string& word : fake::said(result)) text += word;
  }
  return text;
}

TEST(Parameters, EveryOneOfThemChangesWhatAParticipantDoes) {
  const std::string usual = trace({});
  EXPECT_TRUE(trace({}) == usual);
  EXPECT_TRUE(trace({{"cue", std::string("cube_motion"), {}}}) != usual);
  for (const ParameterRow& row : parameter_rows()) {
    if (row.part == ParameterPart::coin) continue;
    const auto with = [&](double value) { return trace({{std::string(row.name), value, {}}}); };
    EXPECT_TRUE(with(row.least) != usual || with(row.most) != usual) << row.name;
  }
}

}  // namespace
}  // namespace heft
