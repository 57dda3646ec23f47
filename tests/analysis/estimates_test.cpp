// Estimates in tables, JSON and charts, for any technique and number of cubes, and which published
// figures are shown beside them.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "MadeUpSessions.h"
#include "analysis/Analysis.h"
#include "analysis/charts/Charts.h"
#include "analysis/report/Report.h"
#include "analysis/report/Tables.h"

namespace heft {
namespace {

using namespace made_up;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

// Two people who sorted and compared in each condition.
Summary study_of(const std::vector<std::string>& conditions, const std::vector<double>& masses_g,
                 const std::map<std::string, published::Condition>& of_paper = {}) {
  std::vector<SessionData> sessions;
  for (int id : {1, 2}) {
    SessionData data = session(id, std::to_string(id));
    data.published_conditions = of_paper;
    for (const std::string& condition : conditions) {
      add_sorting(data, condition, "correct").cubes = cubes(masses_g);
      add_sorting(data, condition, "incorrect").cubes = cubes(masses_g);
      add_staircase(data, "s " + condition, 200, 100.0 + id);
      choose(data.attempts.back(), true);
      data.attempts.back().trial.plan.condition = condition;
      add_comparison(data, "s " + condition, 200, 0).trial.plan.condition = condition;
    }
    sessions.push_back(data);
  }
  return summarize({"x.db", sessions}, "");
}

std::string script_of(const Summary& summary, std::string_view name) {
  for (const Chart& chart : charts_of(summary))
    if (chart.name == name) return chart.script;
  return "";
}

class AnyTechniques : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(AnyTechniques, StandInJsonTablesAndCharts) {
  const Summary summary = study_of(GetParam(), {15, 200, 800});
  const json found = json::parse(as_json(summary));
  const auto tables = filled(tables_at(summary, all_csv_places));
  std::vector<std::string> charts{"sorting",   "sorting_by_participant", "sorting_confusion",
                                  "jnd",       "choice_curves",          "hits_and_false_alarms",
                                  "staircases"};
  for (const std::string& condition : GetParam()) {
    EXPECT_EQ(found["sorting"][condition]["n_trials"], 4);
    EXPECT_EQ(found["sorting"][condition]["correct"]["mean"], 50);
    for (const char* list : {"jnd", "sensitivity", "thresholds"})
      EXPECT_THAT(found[list].dump(), HasSubstr("\"condition\":\"" + condition + '"')) << list;
    for (const Table& table : tables) {
      const bool names_conditions =
          std::ranges::any_of(table.columns, [](const auto& c) { return c.name == "condition"; });
      if (!names_conditions || table.name == "introduction") continue;
      EXPECT_THAT(as_csv(table, ""), HasSubstr(condition)) << table.name;
    }
    for (const std::string& chart : charts)
      EXPECT_THAT(script_of(summary, chart), HasSubstr(condition)) << chart;
  }
  EXPECT_EQ(found["jnd"].size(), GetParam().size());
  EXPECT_EQ(found["hypotheses"]["E1-H2"]["verdict"], "not tested");
}

INSTANTIATE_TEST_SUITE_P(Estimates, AnyTechniques,
                         testing::Values(std::vector<std::string>{"soft"},
                                         std::vector<std::string>{"C1", "C2", "soft"}));

TEST(Estimates, ChanceIsOfTheCubesThatWereSorted) {
  const Summary two = study_of({"C2"}, {100, 400}, {{"C2", published::Condition::decoupled}});
  for (const char* chart : {"sorting", "sorting_by_participant"}) {
    EXPECT_THAT(script_of(two, chart), HasSubstr("correct by chance (50.0 %)")) << chart;
    EXPECT_THAT(script_of(two, chart), Not(HasSubstr("16.7"))) << chart;
    EXPECT_THAT(script_of(study_of({"C2"}, {15, 200, 800}), chart),
                HasSubstr("correct by chance (16.7 %)"));
  }
  EXPECT_EQ(json::parse(as_json(two))["sorting"]["C2"]["chance"], 50);
}

TEST(Estimates, NothingOfThePaperStandsBesideAnotherTechnique) {
  const auto mentions = [](const Summary& summary) {
    int n = 0;
    for (const StudyEstimate& one : all_estimates(summary)) n += one.published ? 1 : 0;
    for (const Hypothesis& hypothesis : summary.hypotheses) n += hypothesis.applies() ? 1 : 0;
    return n;
  };
  const std::vector<double> masses_g{15, 200, 800};
  EXPECT_EQ(mentions(study_of({"C1", "C2"}, masses_g)), 0);
  EXPECT_GT(mentions(study_of({"C2"}, masses_g, {{"C2", published::Condition::decoupled}})), 0);
  EXPECT_EQ(script_of(study_of({"C2"}, masses_g), "beside_published"), "");
}

TEST(Estimates, AreAListOfTheirOwnInJson) {
  const json found = json::parse(as_json(study_of({"soft"}, {15, 200, 800})));
  int n_sorting = 0;
  for (const json& one : found["estimates"]) {
    EXPECT_TRUE(one["measure"].is_string());
    n_sorting += one["measure"] == "sorting_answers" && one["participant"].is_null() ? 1 : 0;
  }
  EXPECT_EQ(n_sorting, 5);  // correct, incorrect, don't know; of answered: correct, incorrect
}

TEST(PublishedConditions, AreThoseOfThePapersLawAndParameters) {
  const auto conditions = [](const std::string& more,
                             const std::vector<ProtocolSetting>& settings) {
    return published::conditions_in(
        parse_protocol("title = \"t\"\n" + more +
                           "[[block]]\nkind = \"demonstration\"\nname = \"b\"\nduration_s = 1\n",
                       "p.toml", settings));
  };
  using published::Condition;
  const std::map<std::string, Condition> paper{{"C1", Condition::coupled},
                                               {"C2", Condition::decoupled}};
  EXPECT_EQ(conditions("", {}), paper);
  EXPECT_EQ(conditions("", {{"coupling.stiffness_n_per_m", "25"}}).count("C2"), 0);
  EXPECT_EQ(conditions("[coupling]\ndamping_ratio = 0.5\n", {}).count("C2"), 0);
  const std::string gain = "gain_of_mass = [[15, 0.9], [800, 0.2]]\n";
  EXPECT_EQ(conditions("[[technique]]\nname = \"C2\"\nkind = \"gain\"\n" + gain, {}).count("C2"),
            0);
  EXPECT_EQ(conditions("[[technique]]\nname = \"mine\"\nkind = \"spring\"\n", {}).at("mine"),
            Condition::decoupled);
  EXPECT_EQ(
      conditions("[[technique]]\nname = \"soft\"\nkind = \"spring\"\nstiffness_n_per_m = 25\n", {})
          .count("soft"),
      0);
}

}  // namespace
}  // namespace heft
