// The table of parameters: which files may set them, and that every row has an effect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
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

bool is_simulated(const ParameterRow& row) {
  return find_row(row.name, simulated_parts) != nullptr;
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
  EXPECT_THAT(text, HasSubstr("p.toml:4:7: cue must be \"offset\", "));
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
    if (!is_simulated(row)) continue;
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

// Logarithms of two parameters of 4000 participants: criterion_mm, then judgment_noise_mm.
struct DrawnPairs {
  explicit DrawnPairs(const std::vector<Parameter>& file) {
    for (std::uint64_t seed = 0; seed < n; ++seed) {
      const auto drawn = participant_parameters({seed, file, ""}, simulated_parts);
      const double a = std::log(drawn.criterion_mm), b = std::log(drawn.judgment_noise_mm);
      sum_a += a, sum_b += b, aa += a * a, bb += b * b, ab += a * b;
    }
  }
  double mean_a() const { return sum_a / n; }
  double sd_a() const { return std::sqrt(aa / n - mean_a() * mean_a()); }
  double sd_b() const { return std::sqrt(bb / n - sum_b / n * sum_b / n); }
  double correlation() const { return (ab / n - mean_a() * sum_b / n) / (sd_a() * sd_b()); }

  static constexpr int n = 4000;
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
};

TEST(Populations, ParticipantsHaveTheFilesMediansSpreadsAndCorrelation) {
  const DrawnPairs drawn({{"criterion_mm.median", 4.0, {}},
                          {"criterion_mm.spread", 0.25, {}},
                          {"judgment_noise_mm.spread", 0.5, {}},
                          {"correlation.criterion_mm.judgment_noise_mm", -0.6, {}}});
  const double n = DrawnPairs::n;  // bounds: four standard errors
  EXPECT_NEAR(drawn.mean_a(), std::log(4.0), 4 * 0.25 / std::sqrt(n));
  EXPECT_NEAR(drawn.sd_a(), 0.25, 4 * 0.25 / std::sqrt(2 * n));
  EXPECT_NEAR(drawn.sd_b(), 0.5, 4 * 0.5 / std::sqrt(2 * n));
  EXPECT_NEAR(drawn.correlation(), -0.6, 4 * (1 - 0.36) / std::sqrt(n));
}

TEST(Populations, ACorrelationChangesNoOtherParameter) {
  const std::vector<Parameter> file{{"correlation.criterion_mm.judgment_noise_mm", 0.5, {}}};
  const auto with = drawn_values({7, file, ""}, simulated_parts);
  const auto without = drawn_values({7, {}, ""}, simulated_parts);
  for (const auto& [name, value] : without) {
    if (name == "criterion_mm" || name == "judgment_noise_mm") continue;
    EXPECT_EQ(with.at(name), value) << name;
  }
  EXPECT_EQ(drawn_values({7, file, ""}, simulated_parts), with);
}

TEST(Populations, MistakesAreReportedAtTheirPlaces) {
  const std::string text =
      refusal("population", {{"hold_s.spread", 4.0, {"p.toml", 1, 1}},
                             {"hold.spread", 0.1, {"p.toml", 2, 1}},
                             {"correlation.hold_s.pause_s", 1.0, {"p.toml", 3, 9}},
                             {"correlation.hold_s.hold_s", 0.5, {"p.toml", 4, 9}},
                             {"hold_s.mean", 1.0, {"p.toml", 5, 9}},
                             {"cue.name", std::string("offset"), {"p.toml", 6, 12}}});
  EXPECT_THAT(text, HasSubstr("p.toml:1:1: hold_s.spread is 4, expected 0 to 3"));
  EXPECT_THAT(text, HasSubstr("p.toml:2:1: unknown parameter \"hold\", did you mean"));
  EXPECT_THAT(text, HasSubstr("p.toml:3:9: correlation.hold_s.pause_s is 1, expected a number"));
  EXPECT_THAT(text, HasSubstr("p.toml:4:9: correlation.hold_s.hold_s is a correlation of a"));
  EXPECT_THAT(text, HasSubstr("p.toml:5:9: unknown parameter \"hold_s.mean\""));
  EXPECT_THAT(text, HasSubstr("p.toml:6:12: unknown parameter \"cue.name\""));
  EXPECT_THAT(refusal("population", {{"correlation.hold_s.pause_s", 0.9, {"p.toml", 1, 1}},
                                     {"correlation.hold_s.think_s", 0.9, {"p.toml", 2, 1}},
                                     {"correlation.pause_s.think_s", -0.9, {"p.toml", 3, 1}}}),
              HasSubstr("p.toml:3:1: no distribution has all these correlations together"));
}

// All actions of a participant in a few trials.
std::string trace(const std::vector<Parameter>& parameters) {
  std::string text;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const auto responder = fake::make("simulated", seed, parameters);
    fake::TrialSetup setup;
    setup.trial_number = static_cast<int>(seed) + 1;
    setup.condition = seed % 3 ? "C2" : "C1";
    setup.task = seed % 2 ? "sorting" : "comparison";
    if (setup.task == "comparison") setup.masses_g = {100, 160};
    setup.last_differed = seed % 4 == 1;
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
  for (const char* cue : {"cube_motion", "cd_ratio", "moved", "sliding_offset"})
    EXPECT_TRUE(trace({{"cue", std::string(cue), {}}}) != usual) << cue;
  // Two rows have an effect only if another parameter enables their mechanism.
  const std::map<std::string_view, Parameter> switches{
      {"haptic_mm", {"haptic_noise_mm", 2.0, {}}},
      {"criterion_persistence", {"criterion_drift_mm", 10.0, {}}}};
  for (const ParameterRow& row : parameter_rows()) {
    if (!is_simulated(row)) continue;
    const auto with = [&](double value) {
      std::vector<Parameter> given{{std::string(row.name), value, {}}};
      if (switches.contains(row.name)) given.push_back(switches.at(row.name));
      return trace(given);
    };
    const std::string at_least = with(row.least);
    EXPECT_TRUE(at_least != usual || with(row.most) != at_least ||
                with(row.most / 10) != at_least || with(row.most / 100) != at_least)
        << row.name;
  }
}

}  // namespace
}  // namespace heft
