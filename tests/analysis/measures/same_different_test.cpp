// Same-different comparisons: thresholds against an independent fit (direct search of the same
// likelihood), and that they stay out of the figures of three-way comparisons.
#include <gmock/gmock.h>

#include <functional>
#include <map>
#include <memory>

#include "analysis/Figures.h"
#include "analysis/MadeUpSessions.h"
#include "psychophysics/ProcedureKinds.h"

namespace heft {
namespace {

using namespace made_up;

// By level: how often the answers were "same" and "different".
using Counts = std::map<double, std::pair<int, int>>;

SessionData judge(std::int64_t id, const char* participant, const Counts& counts) {
  SessionData data = session(id, participant);
  for (const auto& [level_g, n] : counts)
    for (int i = 0; i < n.first + n.second; ++i) {
      Attempt& attempt = add_comparison(data, "constant", 200, i % 2 == 0 ? level_g : -level_g);
      attempt.answers_offered = ComparisonAnswers::same_different;
      attempt.trial.plan.condition = "C2";
      attempt.trial.outcome = i < n.first ? "no_difference" : "difference";
    }
  return data;
}

const Counts sensitive{
    {0, {30, 10}}, {60, {24, 16}}, {120, {14, 26}}, {180, {5, 35}}, {240, {1, 39}}};

TEST(SameDifferent, AnswersGiveThresholdAndCriterionOfDifferencesOfEitherSign) {
  const Summary summary = summarized({judge(1, "a", sensitive)});
  const StudyEstimate threshold = figure(summary, "same_different_threshold_75");
  EXPECT_NEAR(*threshold.value, 51.30688, 1e-4);
  EXPECT_NEAR(*threshold.low, 41.75649, 1e-3);
  EXPECT_NEAR(*threshold.high, 63.93722, 1e-3);
  EXPECT_EQ(threshold.n_trials, 200);
  EXPECT_NEAR(*figure(summary, "same_different_criterion").value, 1.154425, 1e-5);
  const StudyEstimate share = figure(summary, "same_different_different", {{"level_g", "60"}});
  EXPECT_DOUBLE_EQ(*share.value, 40);
  EXPECT_EQ(share.n_hits, 16);
  EXPECT_EQ(*figure(summary, "same_different_different", {{"level_g", "0"}}).value, 25)
      << "false alarms";
  EXPECT_THAT(readable(summary), testing::HasSubstr("Same-different: the 75 % threshold is 51 g"));
}

// Runs an up-down staircase. @param share of "different" at a difference
SessionData run_staircase(std::int64_t id, const std::function<double(double)>& share) {
  SessionData data = session(id, "p" + std::to_string(id));
  UpDownConfig config;
  config.start = 400;
  config.steps = {120, 60, 30};
  config.floor = 0;
  config.stop_reversals = 10;
  Procedure procedure("up-down", config);
  data.staircases["up-down"] = {std::make_shared<const Procedure>(procedure)};
  RandomStream stream(static_cast<std::uint64_t>(id), "answers");
  while (!procedure.finished()) {
    const double level_g = procedure.next_level(stream);
    const bool different = stream.coin(share(level_g));
    Attempt& attempt = add_comparison(data, "up-down", 200, level_g);
    attempt.answers_offered = ComparisonAnswers::same_different;
    attempt.trial.plan.condition = "C2";
    attempt.trial.outcome = different ? "difference" : "no_difference";
    procedure.respond({different, {}}, level_g);
  }
  EstimateRow row;
  row.staircase = "up-down";
  data.estimates.push_back(row);
  return data;
}

int n_with_threshold(const Summary& summary) {
  int n = 0;
  for (int id = 1; id <= 12; ++id)
    n += figure(summary, "same_different_threshold_75", {{"participant", "p" + std::to_string(id)}})
             .value.has_value();
  return n;
}

// A participant's own fit alone finds a sensitivity in some staircases of coins.
TEST(SameDifferent, RandomAnswersInStaircasesHaveNoThreshold) {
  std::vector<SessionData> random, sensitive_people;
  for (int id = 1; id <= 12; ++id) {
    random.push_back(run_staircase(id, [](double) { return 0.5; }));
    sensitive_people.push_back(
        run_staircase(id, [](double g) { return 0.02 + 0.96 * normal_cdf((g - 100) / 50); }));
  }
  const Summary summary = summarized(random);
  EXPECT_EQ(n_with_threshold(summary), 0);
  const StudyEstimate mean = figure(summary, "same_different_threshold_75", {{"participant", ""}});
  EXPECT_FALSE(mean.value.has_value());
  EXPECT_THAT(mean.why, testing::HasSubstr("random answers explain these"));
  EXPECT_GT(n_with_threshold(summarized(sensitive_people)), 6);
  for (SessionData& data : random) data.staircases.clear();
  EXPECT_GT(n_with_threshold(summarized(random)), 0) << "nothing to compare with";
}

// The goodness of fit itself is tested in tests/inference.
TEST(SameDifferent, FitsOfConstantStimuliAreJudged) {
  ConstantConfig config;
  config.levels = {0, 60, 120, 180, 240};
  config.n_per_level = 40;
  SessionData constant = judge(1, "constant", sensitive);
  SessionData lapsing =
      judge(2, "lapsing",
            {{0, {36, 4}}, {60, {24, 16}}, {120, {12, 28}}, {180, {10, 30}}, {240, {9, 31}}});
  for (SessionData* data : {&constant, &lapsing})
    data->staircases["constant"] = {std::make_shared<const Procedure>("constant", config)};
  const SessionData unknown = judge(3, "unknown", sensitive);
  const Summary summary = summarized({constant, lapsing, unknown});
  const auto p_of = [&](const char* participant) {
    return figure(summary, "same_different_fit_p", {{"participant", participant}});
  };
  EXPECT_GT(*p_of("constant").value, 0.05);
  EXPECT_LT(*p_of("lapsing").value, 0.05);
  EXPECT_EQ(p_of("unknown").why, "the procedure that chose the differences is unknown");
  EXPECT_NEAR(*figure(summary, "same_different_deviance", {{"participant", "constant"}}).value,
              0.1516150, 1e-6);
  const StudyEstimate rejected = figure(summary, "same_different_fits_rejected");
  EXPECT_EQ(rejected.value, 1);
  EXPECT_EQ(rejected.n, 2);
}

TEST(SameDifferent, OfACoinHasNoThresholdButAReason) {
  const Summary summary =
      summarized({judge(1, "coin", {{0, {20, 20}}, {80, {21, 19}}, {160, {20, 20}}})});
  const StudyEstimate threshold = figure(summary, "same_different_threshold_75");
  EXPECT_FALSE(threshold.value || threshold.low || threshold.high);
  EXPECT_THAT(threshold.why, testing::HasSubstr("no reliable sensitivity"));
}

TEST(SameDifferent, IsMeanOverParticipantsWhoHaveAThreshold) {
  const Summary summary =
      summarized({judge(1, "a", sensitive), judge(2, "b", sensitive),
                  judge(3, "always", {{0, {0, 40}}, {60, {0, 40}}, {120, {0, 40}}})});
  const StudyEstimate threshold =
      figure(summary, "same_different_threshold_75", {{"participant", ""}});
  EXPECT_NEAR(*threshold.value, 51.30688, 1e-4);
  EXPECT_EQ(threshold.n, 2);
  EXPECT_THAT(threshold.why, testing::HasSubstr("1 of 3 participants have none"));
  EXPECT_THAT(readable(summary), testing::HasSubstr("over the 2 participants that"));
}

TEST(SameDifferent, CountsEachReasonForWhichParticipantsHaveNoThreshold) {
  const Counts of_coin{{0, {20, 20}}, {160, {20, 20}}}, of_one_answer{{0, {0, 40}}, {160, {0, 40}}};
  const Summary summary = summarized({judge(1, "a", sensitive), judge(2, "always", of_one_answer),
                                      judge(3, "coin", of_coin), judge(4, "other coin", of_coin)});
  const StudyEstimate threshold =
      figure(summary, "same_different_threshold_75", {{"participant", ""}});
  EXPECT_THAT(threshold.why,
              testing::MatchesRegex("3 of 4 participants have none: no reliable sensitivity.* "
                                    "\\(2\\); all answers are the same.* \\(1\\)"));
}

TEST(SameDifferent, OneThresholdAmongPeopleHasNoInterval) {
  const Summary summary =
      summarized({judge(1, "a", sensitive), judge(2, "coin", {{0, {20, 20}}, {160, {20, 20}}})});
  const StudyEstimate threshold =
      figure(summary, "same_different_threshold_75", {{"participant", ""}});
  EXPECT_NEAR(*threshold.value, 51.30688, 1e-4);
  EXPECT_EQ(threshold.n, 1);
  EXPECT_FALSE(threshold.low || threshold.high);
}

TEST(SameDifferent, StaysOutOfThreeWayComparisons) {
  const SessionData data = judge(1, "a", sensitive);
  EXPECT_FALSE(data.attempts.front().is_usable_comparison());
  const Summary summary = summarized({data});
  EXPECT_FALSE(find_estimate(summary.estimates, "sensitivity"));
  EXPECT_FALSE(find_estimate(summary.estimates, "forced_threshold_75"));
}

}  // namespace
}  // namespace heft
