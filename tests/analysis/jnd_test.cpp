// JNDs by reference: the order of averaging, and the counts of staircases.
#include "analysis/dataset/Jnd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "MadeUpSessions.h"
#include "analysis/Analysis.h"
#include "analysis/Folds.h"
#include "analysis/dataset/Summary.h"
#include "analysis/dataset/Tracks.h"
#include "analysis/display/Table.h"
#include "analysis/report/Tables.h"

namespace heft {
namespace {

using namespace made_up;

TEST(Jnd, MeansSpreadAndIntervalOverParticipants) {
  std::vector<SessionData> sessions;
  for (double jnd_g : {60.0, 80.0, 100.0, 80.0}) {
    const auto id = static_cast<std::int64_t>(sessions.size()) + 1;
    sessions.push_back(session(id, std::to_string(id)));
    add_staircase(sessions.back(), "15g", 15, jnd_g);
  }
  const auto jnds = jnd_of(sessions);
  ASSERT_EQ(jnds.size(), 1);
  EXPECT_EQ(jnds[0].overall.kind, MeanKind::log_normal_mean);
  EXPECT_NEAR(*jnds[0].overall.mean, 80.0243613037, 1e-3);  // tests/golden/analysis/tobit.R
  EXPECT_NEAR(*jnds[0].overall.sd, 16.9403585679, 1e-3);
  EXPECT_NEAR(jnds[0].overall.interval->high, 119.5939855312, 1e-3);
  EXPECT_DOUBLE_EQ(*jnds[0].overall.by_paper.mean, 80);
  EXPECT_DOUBLE_EQ(*jnds[0].overall.by_paper.sd, std::sqrt(800.0 / 3));
  ASSERT_NE(jnds[0].published, nullptr);
  EXPECT_EQ(jnds[0].published->value, 172.3);
  EXPECT_EQ(jnds[0].published->sd, 72.4);
}

TEST(Jnd, StaircasesThenSessionsAreAveragedWithinAParticipant) {
  SessionData first = session(1, "a"), again = session(2, "a"), other = session(3, "b");
  add_staircase(first, "from above", 200, 100);
  add_staircase(first, "from below", 200, 200);  // session: 150
  add_staircase(again, "from above", 200, 250);  // participant: (150 + 250) / 2
  add_staircase(other, "from above", 200, 400);
  const auto jnds = jnd_of(std::vector{first, again, other});
  ASSERT_EQ(jnds.size(), 1);
  ASSERT_EQ(jnds[0].overall.participants.size(), 2);
  EXPECT_DOUBLE_EQ(jnds[0].overall.participants[0].jnd_g, 200);
  EXPECT_DOUBLE_EQ(*jnds[0].overall.mean, 300);
  EXPECT_EQ(jnds[0].n_staircases, 4);
}

SessionData with_both_starts(std::int64_t id, double above_g, double below_g) {
  SessionData data = session(id, std::to_string(id));
  add_comparison(data, "down", 200, 600);
  add_staircase(data, "down", 200, above_g);
  add_comparison(data, "up", 200, 20);
  add_staircase(data, "up", 200, below_g);
  return data;
}

TEST(Jnd, AboveAndBelowAreApart) {
  std::vector sessions{with_both_starts(1, 300, 100), with_both_starts(2, 320, 100)};
  const StartEffect both = jnd_of(sessions).at(0).starts.value();
  EXPECT_EQ(both.from_above_g.mean, 310);
  EXPECT_EQ(both.from_below_g.mean, 100);
  EXPECT_EQ(both.difference_g.mean, 210);
  EXPECT_NEAR(both.difference_g.interval->high, 210 + 12.7062047362 * 10, 1e-6);  // t, 1 df

  sessions.push_back(session(3, "3"));  // ends before one of the two
  add_comparison(sessions.back(), "up", 200, 20);
  add_staircase(sessions.back(), "up", 200, 100);
  const ReferenceJnd jnd = jnd_of(sessions).at(0);
  EXPECT_EQ(jnd.starts.value().from_above_g.missing.size(), 1);
  EXPECT_EQ(jnd.starts->difference_g.n(), 3);
  EXPECT_EQ(jnd.as_published().mean, 310);  // not 210, which is of both together

  const ReferenceJnd alone = jnd_of({&sessions.back(), 1}).at(0);
  EXPECT_FALSE(alone.starts.has_value());
  EXPECT_EQ(alone.as_published().mean, 100);
}

TEST(Jnd, TheTableHasARowForEachStart) {
  const std::vector sessions{with_both_starts(1, 300, 100), with_both_starts(2, 320, 100)};
  const auto tables = tables_at(summarize({"x.db", sessions}, ""), {TablePlace::results});
  const Table& table = *std::ranges::find(tables, "jnd", &Table::name);
  std::vector<std::string> rows;
  for (const auto& row : table.rows) rows.push_back(row[2].text + ": " + row[3].text);
  EXPECT_EQ(rows, (std::vector<std::string>{"from above: 310.0", "from below: 100.0",
                                            "above - below: 210.0"}));
  EXPECT_EQ(table.rows[0].at(12).text, "310.0");  // by the paper's rule
  EXPECT_EQ(table.rows[2].at(12).text, "210.0");
  EXPECT_EQ(table.rows[0].at(15).text, "271.5");  // published, of staircases from above
  EXPECT_EQ(table.rows[1].at(15).text, "");
}

TEST(Jnd, OneParticipantHasNoSpreadAndNoInterval) {
  SessionData data = session(1, "a");
  add_staircase(data, "800g", 800, 700);
  const auto jnds = jnd_of({&data, 1});
  EXPECT_EQ(jnds[0].overall.mean, 700);
  EXPECT_FALSE(jnds[0].overall.sd.has_value());
  EXPECT_FALSE(jnds[0].overall.interval.has_value());
}

TEST(Jnd, CountsTrialsLimitsAndBounds) {
  SessionData data = session(1, "a");
  add_staircase(data, "one", 15, 100, 18);
  add_staircase(data, "two", 15, 100, 200);
  data.estimates[0].n_floor = 3;
  data.estimates[1].n_ceiling = 2;
  data.estimates[1].reason = StopReason::trials;
  data.estimates[1].jnd_g.reset();
  const ReferenceJnd jnd = jnd_of({&data, 1}).at(0);
  EXPECT_DOUBLE_EQ(jnd.mean_trials, 109);
  EXPECT_EQ(jnd.least_trials, 18);
  EXPECT_EQ(jnd.most_trials, 200);
  EXPECT_EQ(jnd.n_trial_limit, 1);
  EXPECT_EQ(jnd.n_without_estimate, 1);
  EXPECT_EQ(jnd.n_floor, 3);
  EXPECT_EQ(jnd.n_floor_staircases, 1);
  EXPECT_EQ(jnd.n_ceiling, 2);
  EXPECT_EQ(jnd.n_ceiling_staircases, 1);
}

SessionData with_jnds(std::int64_t id, const std::vector<std::pair<double, Censored>>& jnds) {
  SessionData data = session(id, std::to_string(id));
  for (const auto& [jnd_g, censored] : jnds) {
    add_staircase(data, "s" + std::to_string(data.estimates.size()), 15, jnd_g);
    data.estimates.back().censored = censored;
  }
  return data;
}

TEST(Jnd, WhatLeansOnABoundIsCensoredAndCounted) {
  const std::vector sessions{
      with_jnds(1, {{60, Censored::none}}), with_jnds(2, {{80, Censored::none}}),
      with_jnds(3, {{70, Censored::none}}), with_jnds(4, {{65, Censored::none}}),
      with_jnds(5, {{75, Censored::none}}), with_jnds(6, {{100, Censored::above}}),
      with_jnds(7, {{40, Censored::below}})};
  const ReferenceJnd jnd = jnd_of(sessions).at(0);
  EXPECT_EQ(jnd.overall.n(), 7);
  EXPECT_EQ(jnd.overall.n_censored(Censored::above), 1);
  EXPECT_EQ(jnd.overall.n_censored(Censored::below), 1);
  EXPECT_EQ(jnd.overall.kind, MeanKind::log_normal_mean);
  EXPECT_GT(*jnd.overall.mean, 70);  // not 70, as if they were not there, nor as if 100 were exact
  EXPECT_LT(jnd.overall.interval->low, *jnd.overall.mean);
  EXPECT_GT(jnd.overall.interval->low, 0);
  EXPECT_DOUBLE_EQ(*jnd.overall.by_paper.mean, (60 + 80 + 70 + 65 + 75 + 100 + 40) / 7.0);
  EXPECT_EQ(jnd.overall.by_paper.n, 7);
}

TEST(Jnd, ThePapersMeanTakesWhatTheLogHasAndCountsIt) {
  std::vector sessions{with_jnds(1, {{60, Censored::none}}),
                       with_jnds(2, {{300, Censored::indeterminate}}),
                       with_jnds(3, {{90, Censored::above}}), with_jnds(4, {{1, Censored::none}})};
  sessions[3].estimates[0].jnd_g.reset();  // fewer reversals than are discarded
  sessions[3].estimates[0].n_reversals = 1;
  const Jnds jnds = jnd_of(sessions).at(0).overall;
  EXPECT_FALSE(jnds.mean.has_value());
  EXPECT_DOUBLE_EQ(*jnds.by_paper.mean, 150);
  EXPECT_DOUBLE_EQ(*jnds.by_paper.sd, std::sqrt((90.0 * 90 + 150.0 * 150 + 60.0 * 60) / 2));
  EXPECT_EQ(jnds.by_paper.n, 3);
}

TEST(Jnd, ThePapersMeanAveragesSessionsOfAParticipant) {
  SessionData first = with_jnds(1, {{100, Censored::none}, {300, Censored::above}});
  SessionData again = session(2, "1"), other = with_jnds(3, {{50, Censored::below}});
  add_staircase(again, "s0", 15, 400);  // participant: (200 + 400) / 2
  EXPECT_DOUBLE_EQ(*jnd_of(std::vector{first, again, other}).at(0).overall.by_paper.mean, 175);
}

TEST(Jnd, WhereHalfAreCensoredOrMissingThereIsNoMean) {
  std::vector sessions{with_jnds(1, {{60, Censored::none}}), with_jnds(2, {{80, Censored::none}}),
                       with_jnds(3, {{90, Censored::above}}), with_jnds(4, {{70, Censored::none}})};
  EXPECT_TRUE(jnd_of(sessions).at(0).overall.mean.has_value());
  sessions[3].estimates.clear();  // unfinished
  const ReferenceJnd jnd = jnd_of(sessions).at(0);
  EXPECT_FALSE(jnd.overall.mean || jnd.overall.sd || jnd.overall.interval);
  EXPECT_EQ(jnd.overall.kind, MeanKind::none);
  EXPECT_EQ(jnd.overall.missing, std::vector<std::string>{"4"});
  EXPECT_EQ(jnd.overall.n(), 4);
}

TEST(Jnd, AParticipantIsAsCensoredAsTheStaircases) {
  const ReferenceJnd one_above =
      jnd_of(std::vector{with_jnds(1, {{100, Censored::none}, {300, Censored::above}})}).at(0);
  EXPECT_EQ(one_above.overall.participants.at(0).censored, Censored::above);
  EXPECT_EQ(one_above.overall.participants.at(0).jnd_g, 200);
  const ReferenceJnd both =
      jnd_of(std::vector{with_jnds(1, {{1, Censored::below}, {300, Censored::above}})}).at(0);
  EXPECT_EQ(both.overall.missing.size(), 1);
}

TEST(Jnd, FewReversalsOrTheTrialLimitCensorTheWayTheStaircaseWent) {
  SessionData data = session(1, "a");
  add_comparison(data, "up", 15, 50);
  add_staircase(data, "up", 15, 400, 60);
  data.estimates[0].reason = StopReason::trials;
  add_comparison(data, "down", 15, 500);
  add_staircase(data, "down", 15, 20);
  data.estimates[1].n_reversals = 3;
  add_comparison(data, "few", 15, 20);
  add_staircase(data, "few", 15, 20);
  data.estimates[2].n_reversals = 3;
  const auto results = staircase_results({&data, 1});
  EXPECT_EQ(results[0].censored, Censored::above);
  EXPECT_EQ(results[0].why, "trial limit");
  EXPECT_EQ(results[0].shown_g, 400);
  EXPECT_EQ(results[1].censored, Censored::below);
  EXPECT_EQ(results[1].why, "3 reversals");
  EXPECT_EQ(results[2].censored, Censored::indeterminate);  // it ended where it began
  EXPECT_FALSE(results[2].shown_g.has_value());
}

TEST(Jnd, AStaircaseWithoutEstimateIsUnfinished) {
  SessionData data = session(1, "a");
  add_comparison(data, "15g", 15, 175);
  const ReferenceJnd jnd = jnd_of({&data, 1}).at(0);
  EXPECT_EQ(jnd.n_unfinished, 1);
  EXPECT_EQ(jnd.n_staircases, 0);
  EXPECT_EQ(jnd.least_trials, 0);
  EXPECT_FALSE(jnd.overall.mean.has_value());
}

TEST(Jnd, ConstantStimuliAreNoStaircaseThatLacksAJnd) {
  SessionData data = session(1, "a");
  add_staircase(data, "15g", 15, 100);
  add_comparison(data, "ended", 15, 40);
  add_comparison(data, "going on", 200, 40);
  data.estimates.push_back(data.estimates[0]);
  data.estimates[1].staircase = "ended";
  data.estimates[1].method = "constant";
  data.estimates[1].jnd_g.reset();
  data.without_jnd = {"ended", "going on"};
  const auto jnds = jnd_of({&data, 1});
  ASSERT_EQ(jnds.size(), 1);
  EXPECT_EQ(jnds[0].compared.reference_g, 15);
  EXPECT_EQ(jnds[0].n_staircases, 1);
  EXPECT_EQ(jnds[0].n_unfinished, 0);
  EXPECT_EQ(jnds[0].n_without_estimate, 0);
  EXPECT_EQ(jnds[0].overall.mean, 100);
  EXPECT_EQ(staircase_results({&data, 1}).size(), 1);
  const auto sessions = folded<TracksCollector>({&data, 1}).result();
  ASSERT_EQ(sessions.at(0).tracks.size(), 1u);
  EXPECT_EQ(sessions[0].tracks[0].staircase, "15g");
}

TEST(Jnd, EstimatesOfAnyProcedureAreThereWithTheirIntervals) {
  SessionData data = session(1, "a");
  add_staircase(data, "15g", 15, 100);
  add_staircase(data, "other", 15, 80, 40);
  data.estimates[1].method = "mean_of_posterior";
  data.estimates[1].low_g = 70;
  data.estimates[1].high_g = 95;
  data.estimates[1].n_reversals = 0;
  data.estimates[1].reason = StopReason::precision;
  data.estimates.push_back(data.estimates[1]);
  data.estimates[2].method = "mode_of_posterior";  // the first method stands for the staircase
  data.estimates[2].jnd_g = 60;
  const auto jnds = jnd_of({&data, 1});
  ASSERT_EQ(jnds.size(), 2);  // never averaged over methods
  EXPECT_EQ(jnds[0].compared.method, "mean_of_posterior");
  EXPECT_EQ(jnds[0].overall.mean, 80);
  EXPECT_EQ(jnds[0].n_unfinished, 0);
  EXPECT_EQ(jnds[0].published, nullptr);
  EXPECT_EQ(jnds[1].compared.method, jnd_method);
  EXPECT_EQ(jnds[1].overall.mean, 100);
  const auto results = staircase_results({&data, 1});
  ASSERT_EQ(results.size(), 2);
  EXPECT_EQ(results[1].censored, Censored::none);
  EXPECT_EQ(results[1].why, "");  // it has no reversals that could be too few
  EXPECT_EQ(results[1].low_g, 70);
  EXPECT_EQ(results[1].high_g, 95);
  data.estimates[1].reason = StopReason::trials;  // as planned
  EXPECT_EQ(staircase_results({&data, 1})[1].censored, Censored::none);
  data.estimates[1].censored = Censored::above;
  EXPECT_EQ(staircase_results({&data, 1})[1].censored, Censored::above);
}

TEST(Jnd, OfABayesianKindIsBoundedByItsIntervalOrNotIdentifiable) {
  SessionData data = session(1, "a");
  add_staircase(data, "s", 200, 80, 40);
  EstimateRow& row = data.estimates[0];
  row.method = "psi";
  row.reason = StopReason::trials;
  row.jnd_g.reset();
  row.censored = Censored::indeterminate;
  StaircaseResult result = staircase_results({&data, 1}).at(0);
  EXPECT_EQ(result.why, "not identifiable");
  EXPECT_FALSE(result.shown_g);
  row.censored = Censored::above;
  row.low_g = 350;
  result = staircase_results({&data, 1}).at(0);
  EXPECT_EQ(result.why, "beyond the largest threshold of the grid");
  EXPECT_EQ(result.shown_g, 350);
  row.censored = Censored::below;
  row.low_g.reset();
  row.high_g = 20;
  EXPECT_EQ(staircase_results({&data, 1}).at(0).shown_g, 20);
  row.jnd_g = 15;
  row.censored = Censored::none;
  result = staircase_results({&data, 1}).at(0);
  EXPECT_EQ(result.why, "");
  EXPECT_EQ(result.shown_g, 15);
}

TEST(Jnd, AProtocolSaysWhichStaircasesHaveNone) {
  const std::string block = "title = \"t\"\n[[block]]\nkind = \"comparison\"\nname = \"c\"\n";
  const std::string up_down =
      "[[block.staircase]]\nname = \"u\"\nreference_g = 15\nstart = 9\nstep = 1\nfloor = 0\n";
  const std::string constant =
      "[[block.staircase]]\nname = \"k\"\nkind = \"constant\"\nreference_g = 15\n"
      "levels = [1, 2]\nn_per_level = 3\n";
  EXPECT_EQ(staircases_without_jnd(block + up_down + constant), std::set<std::string>{"k"});
  EXPECT_TRUE(staircases_without_jnd(block + up_down).empty());
  EXPECT_TRUE(staircases_without_jnd("no protocol").empty());
}

TEST(Jnd, PublishedFiguresNeedReferenceAndConditionOfThePaper) {
  SessionData data = session(1, "a");
  add_staircase(data, "coupled", 15, 100);
  data.attempts.back().trial.plan.condition = "C1";
  add_staircase(data, "other", 100, 100);
  add_staircase(data, "paper", 800, 100);
  const auto jnds = jnd_of({&data, 1});
  ASSERT_EQ(jnds.size(), 3);
  EXPECT_EQ(jnds[0].published, nullptr);
  EXPECT_EQ(jnds[1].published, nullptr);
  EXPECT_EQ(jnds[2].published, published::jnd_at(800));
  data.published_conditions.erase("C2");  // of other parameters than the paper's
  EXPECT_EQ(jnd_of({&data, 1})[2].published, nullptr);
}

}  // namespace
}  // namespace heft
