// Thresholds of judgments, by block: which procedures have one.
#include <gmock/gmock.h>

#include <functional>
#include <memory>

#include "analysis/Figures.h"
#include "analysis/MadeUpSessions.h"
#include "analysis/dataset/Jnd.h"
#include "psychophysics/ProcedureKinds.h"
#include "tasks/Judgment.h"

namespace heft {
namespace {

using namespace made_up;

void add_threshold(SessionData& data, const std::string& block, std::optional<double> reference_g,
                   double jnd_g, const std::string& task = "judgment") {
  Attempt& attempt = add_attempt(data, task, {reference_g.value_or(0) + 100});
  attempt.trial.plan.block = block;
  attempt.trial.plan.staircase = block + " staircase";
  attempt.trial.plan.reference_g = reference_g;
  attempt.trial.plan.level_g = 100;
  attempt.trial.outcome = "chosen";
  attempt.trial.value = 1;
  EstimateRow row;
  row.staircase = attempt.trial.plan.staircase;
  row.method = jnd_method;
  row.jnd_g = jnd_g;
  row.n_trials = 20;
  row.n_reversals = 8;
  data.estimates.push_back(row);
}

std::optional<double> of(const Summary& summary, const char* measure, const char* block,
                         const char* reference_g, const char* participant = "") {
  return figure(summary, measure,
                {{"block", block}, {"reference_g", reference_g}, {"participant", participant}})
      .value;
}

TEST(JudgmentThreshold, IsAMeanOverPeopleApartByBlock) {
  SessionData one = session(1, "one"), other = session(2, "other"), third = session(3, "third");
  for (auto [data, g] : {std::pair(&one, 100.0), {&other, 200.0}, {&third, 400.0}}) {
    add_threshold(*data, "heavy", std::nullopt, g);
    add_threshold(*data, "harder", 200, g / 10);
    add_threshold(*data, "compared", 200, 77, "comparison");
  }
  const Summary summary = summarized({one, other, third});
  const double heavy_g = of(summary, "judgment_threshold", "heavy", "").value();
  EXPECT_GT(heavy_g, 200);  // the geometric mean, below that of the log-normal model
  EXPECT_LT(heavy_g, 300);
  EXPECT_NEAR(of(summary, "judgment_threshold", "harder", "200").value(), heavy_g / 10, 1e-6);
  EXPECT_EQ(of(summary, "judgment_threshold", "heavy", "", "third"), 400);
  EXPECT_EQ(of(summary, "judgment_threshold_n_missing", "heavy", ""), 0);
  StaircaseCollector comparisons;
  for (const SessionData& data : {one, other, third}) comparisons.add(data);
  EXPECT_EQ(comparisons.jnds().size(), 1u) << "judgments are no JNDs of comparisons";
}

TEST(JudgmentThreshold, ThatIsNotIdentifiableHasAReason) {
  SessionData one = session(1, "one"), other = session(2, "other");
  for (SessionData* data : {&one, &other}) add_threshold(*data, "heavy", std::nullopt, 100);
  other.estimates.back().n_reversals = 1;
  other.estimates.back().n_floor = 3;
  other.estimates.back().censored = Censored::below;
  const Summary summary = summarized({one, other});
  const StudyEstimate found =
      figure(summary, "judgment_threshold", {{"block", "heavy"}, {"participant", ""}});
  EXPECT_FALSE(found.value.has_value());
  EXPECT_EQ(found.why,
            "exact in 1 of 2 participants, below a limit in 1; a mean needs more than "
            "half");
  EXPECT_THAT(readable(summary),
              testing::HasSubstr("Threshold of \"heavy\" (mean of reversals): not identifiable"));
}

// Two exact thresholds of three determine no log-normal mean, however narrow its interval would be.
TEST(JudgmentThreshold, OfTwoExactAndACensoredOneSaysWhatIsMissing) {
  SessionData one = session(1, "one"), other = session(2, "other"), third = session(3, "third");
  for (auto [data, g] : {std::pair(&one, 100.0), {&other, 110.0}, {&third, 120.0}})
    add_threshold(*data, "heavy", std::nullopt, g);
  third.estimates.back().n_reversals = 1;
  third.estimates.back().n_floor = 3;
  third.estimates.back().censored = Censored::below;
  const StudyEstimate found = figure(summarized({one, other, third}), "judgment_threshold",
                                     {{"block", "heavy"}, {"participant", ""}});
  EXPECT_FALSE(found.value.has_value());
  EXPECT_EQ(found.why,
            "exact in 2 of 3 participants, below a limit in 1; a mean needs at least three that "
            "are not all equal");
}

// A threshold of 0 g has no logarithm.
TEST(JudgmentThreshold, OfZeroGramsIsNoExactOne) {
  std::vector<SessionData> people;
  for (const double g : {0.0, 0.0, 100.0, 120.0, 50.0}) {
    const auto number = static_cast<int>(people.size()) + 1;
    people.push_back(session(number, "p" + std::to_string(number)));
    add_threshold(people.back(), "heavy", std::nullopt, g);
  }
  people.back().estimates.back().n_reversals = 1;
  people.back().estimates.back().n_floor = 3;
  people.back().estimates.back().censored = Censored::below;
  const StudyEstimate found =
      figure(summarized(people), "judgment_threshold", {{"block", "heavy"}, {"participant", ""}});
  EXPECT_FALSE(found.value.has_value());
  EXPECT_EQ(found.why,
            "exact in 2 of 5 participants, below a limit in 1, 0 g in 2; a mean needs more than "
            "half");
}

TEST(JudgmentThreshold, NotesMethodsOnlyWhereThoseOfOneJudgmentDiffer) {
  SessionData one = session(1, "one"), other = session(2, "other");
  for (SessionData* data : {&one, &other}) {
    add_threshold(*data, "heavy", std::nullopt, 100);
    add_threshold(*data, "harder", 200, 20);
    data->estimates.back().method = "quest_plus";
  }
  EXPECT_TRUE(summarized({one, other}).notes.empty()) << "they answer different questions";
  other.estimates.front().method = "psi";
  EXPECT_THAT(
      summarized({one, other}).notes,
      testing::ElementsAre("Thresholds of the judgment \"heavy\" are by several methods, in "
                           "separate rows: mean_of_reversals, psi."));
  add_threshold(one, "compared", 200, 77, "comparison");
  add_threshold(other, "compared", 200, 77, "comparison");
  EXPECT_THAT(summarized({one, other}).notes, testing::SizeIs(1));
  other.estimates.back().method = "quest";
  EXPECT_THAT(summarized({one, other}).notes,
              testing::Contains("JNDs are by several methods, in separate rows: "
                                "mean_of_reversals, quest."));
}

// Runs the staircase "heavy" of single cubes. @param share of "yes" at a mass
SessionData judge_of(int id, const std::function<double(double)>& share) {
  SessionData data = session(id, "p" + std::to_string(id));
  Judgment::Offer& offer = data.judgments["heavy"];
  offer.question.choices = {{"yes", "yes"}, {"no", "no"}};
  offer.question.kind = QuestionKind::choice;
  offer.question.key = "heavy";
  offer.responses = {{"yes", Meaning::positive}, {"no", Meaning::negative}};
  UpDownConfig config;
  config.start = 400;
  config.steps = {120, 60, 30};
  config.floor = 10;
  config.stop_reversals = 8;
  Procedure procedure("of heavy", config);
  data.staircases["of heavy"] = {std::make_shared<const Procedure>(procedure)};
  RandomStream stream(static_cast<std::uint64_t>(id), "answers");
  while (!procedure.finished()) {
    const double level_g = procedure.next_level(stream);
    const bool yes = stream.coin(share(level_g));
    Attempt& attempt = add_attempt(data, "judgment", {level_g});
    attempt.trial.plan.block = "heavy";
    attempt.trial.plan.staircase = "of heavy";
    attempt.trial.plan.level_g = level_g;
    attempt.trial.outcome = "chosen";
    attempt.trial.value = yes ? 1 : 2;
    procedure.respond({yes, {}}, level_g);
  }
  EstimateRow row;
  row.staircase = "of heavy";
  row.method = jnd_method;
  row.jnd_g = procedure.estimates().front().value;
  row.n_reversals = 8;
  data.estimates.push_back(row);
  return data;
}

Summary judged_by(int n_people, const std::function<double(double)>& share) {
  std::vector<SessionData> people;
  for (int id = 1; id <= n_people; ++id) people.push_back(judge_of(id, share));
  return summarized(people);
}

TEST(JudgmentThreshold, OfRandomAnswersIsNotIdentifiable) {
  const Summary summary = judged_by(8, [](double) { return 0.5; });
  const StudyEstimate found =
      figure(summary, "judgment_threshold", {{"block", "heavy"}, {"participant", ""}});
  EXPECT_FALSE(found.value.has_value());
  EXPECT_THAT(found.why, testing::StartsWith("random answers explain these: in the same "
                                             "procedures they depend on the level as much in "));
  const StudyEstimate own =
      figure(summary, "judgment_threshold", {{"block", "heavy"}, {"participant", "p1"}});
  EXPECT_FALSE(own.value.has_value());
  EXPECT_EQ(own.why, found.why);
  EXPECT_EQ(of(summary, "judgment_threshold_n_missing", "heavy", ""), 8);
  ASSERT_EQ(summary.all_tracks.size(), 8u);
  EXPECT_FALSE(summary.all_tracks[0].tracks.at(0).jnd_g.has_value()) << "nor in the charts";
}

TEST(JudgmentThreshold, OfPeopleWhoPerceiveTheMassIsIdentifiable) {
  const Summary summary =
      judged_by(8, [](double g) { return 0.02 + 0.96 * normal_cdf((g - 110) / 20); });
  EXPECT_NEAR(of(summary, "judgment_threshold", "heavy", "").value(), 110, 20);
  EXPECT_TRUE(of(summary, "judgment_threshold", "heavy", "", "p1").has_value());
}

const std::string judgment = R"(title = "t"
[[block]]
kind = "judgment"
name = "j"
question = "a.b"
responses = RESPONSES
[[block.staircase]]
name = "s"
reference_g = 200
start = 100
step = 10
floor = FLOOR
)";

std::set<std::string> without(std::string text, const std::string& responses,
                              const std::string& floor) {
  text.replace(text.find("RESPONSES"), 9, responses);
  text.replace(text.find("FLOOR"), 5, floor);
  return staircases_without_jnd(text);
}

TEST(JudgmentThreshold, OfAForcedChoiceNeedsLevelsThatAreNeverLighter) {
  const std::string forced = R"({ l = "left", r = "right" })";
  EXPECT_TRUE(without(judgment, forced, "0").empty());
  EXPECT_EQ(without(judgment, forced, "-100"), std::set<std::string>{"s"});
  EXPECT_TRUE(without(judgment, R"({ l = "left", r = "right", n = "none" })", "0").empty());
  EXPECT_TRUE(without(judgment, R"({ y = "positive", n = "negative" })", "0").empty());
}

}  // namespace
}  // namespace heft
