// The trials of judgments' staircases: what each answer counts as, and their charts and tables.
#include <gmock/gmock.h>

#include "analysis/Figures.h"
#include "analysis/MadeUpSessions.h"
#include "analysis/charts/Charts.h"
#include "tasks/Judgment.h"

namespace heft {
namespace {

using namespace made_up;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Judgment::Offer asked(const std::string& key, const Meanings& responses) {
  Judgment::Offer offer{{}, responses};
  offer.question.key = key;
  offer.question.kind = QuestionKind::choice;
  for (const auto& [answer, meaning] : responses)
    offer.question.choices.push_back({answer, answer});
  return offer;
}

// @param choice its place among the choices, from 1
void add_trial(SessionData& data, const std::string& block, double level_g, double choice,
               std::optional<double> reference_g = std::nullopt) {
  Attempt& attempt = add_attempt(data, "judgment", {reference_g.value_or(0) + level_g});
  attempt.trial.plan.block = block;
  attempt.trial.plan.condition = "C2";
  attempt.trial.plan.staircase = "of " + block;
  attempt.trial.plan.level_g = level_g;
  attempt.trial.plan.reference_g = reference_g;
  if (reference_g) attempt.trial.plan.reference_slot = 1;
  attempt.trial.value = choice;
  attempt.trial.outcome = "chosen";
}

SessionData judged() {
  SessionData data = session(1, "one");
  data.judgments["heavy"] = asked("feels", {{"yes", Meaning::positive}, {"no", Meaning::negative}});
  data.judgments["harder"] = asked(
      "harder", {{"left", Meaning::left}, {"right", Meaning::right}, {"same", Meaning::none}});
  add_trial(data, "heavy", 400, 1);
  add_trial(data, "heavy", 280, 2);
  for (const double choice : {1, 2, 3}) add_trial(data, "harder", 40, choice, 200);
  add_trial(data, "harder", -40, 1, 200);
  EstimateRow row;
  row.staircase = "of heavy";
  row.method = jnd_method;
  row.jnd_g = 115;
  row.n_trials = 2;
  row.n_reversals = 8;
  data.estimates.push_back(row);
  return data;
}

// "400+" chosen or positive, "400x" the lighter cube, "400-" neither
std::vector<std::string> points_of(const Track& track) {
  std::vector<std::string> points;
  for (const TrackPoint& point : track.points)
    points.push_back(std::to_string(static_cast<int>(point.level_g)) + (point.wrong    ? "x"
                                                                        : point.chosen ? "+"
                                                                                       : "-"));
  return points;
}

const Chart* chart(const std::vector<Chart>& charts, std::string_view name) {
  const auto found = std::ranges::find(charts, name, &Chart::name);
  return found == charts.end() ? nullptr : &*found;
}

TEST(JudgmentTracks, HoldEachAnswerByWhatItResponds) {
  const Summary summary = summarized({judged()});
  ASSERT_EQ(summary.all_tracks.size(), 1u);
  const auto& tracks = summary.all_tracks[0].tracks;
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_EQ(tracks[0].compared.block, "heavy");
  EXPECT_THAT(points_of(tracks[0]), ElementsAre("400+", "280-"));
  EXPECT_THAT(tracks[0].positive, ElementsAre("yes"));
  EXPECT_EQ(tracks[0].jnd_g, 115);
  EXPECT_THAT(points_of(tracks[1]), ElementsAre("40x", "40+", "40-", "-40+"));
  EXPECT_THAT(tracks[1].positive, ElementsAre("left", "right"));
}

TEST(JudgmentTracks, AreInTheTablesOfStaircases) {
  const Summary summary = summarized({judged()});
  const std::string trials = as_csv(track_table(summary.all_tracks[0]), summary.data);
  EXPECT_THAT(trials, HasSubstr("one,of heavy,,C2,2,280,0,0,0,heavy,feels,yes\n"));
  EXPECT_THAT(trials, HasSubstr("one,of harder,200,C2,1,40,1,1,0,harder,harder,\"left, right\"\n"));
  for (const Table& table : tables_at(summary, {TablePlace::csv}))
    if (table.name == "staircases") {
      EXPECT_THAT(as_csv(table, summary.data), HasSubstr("one,of heavy,,C2,115,"));
      return;
    }
  ADD_FAILURE() << "no table of staircases";
}

TEST(JudgmentTracks, AreChartedUnderTheirQuestionAndPositiveAnswer) {
  SessionData data = judged();
  const auto charts = charts_of(summarized({data}));
  const Chart* session = chart(charts, "staircases");
  ASSERT_NE(session, nullptr);
  EXPECT_THAT(session->script, HasSubstr("'heavy/feels (positive: yes), C2'"));
  EXPECT_THAT(session->script, HasSubstr("'harder at 200 g, C2'"));
  EXPECT_THAT(session->script, HasSubstr("'of heavy: threshold 115.0 g'"));
  EXPECT_THAT(session->script, HasSubstr("set ylabel 'mass (g)'"));
  EXPECT_THAT(session->script, HasSubstr("set ylabel 'difference from the reference (g)'"));
  EXPECT_THAT(session->caption, Not(HasSubstr("JND")));
  const Chart* heavy = chart(charts, "all_staircases_heavy");
  ASSERT_NE(heavy, nullptr);
  EXPECT_THAT(heavy->title, HasSubstr("Every staircase of heavy/feels (positive: yes), C2"));
  EXPECT_THAT(heavy->script, HasSubstr("filled: positive answer; open: negative"));
  EXPECT_NE(chart(charts, "all_staircases_harder_200g"), nullptr);
  add_staircase(data, "15g", 15, 100);
  EXPECT_THAT(chart(charts_of(summarized({data})), "staircases")->caption,
              HasSubstr("the paper's JND, or the threshold of the judgment"));
}

}  // namespace
}  // namespace heft
