// Estimates beside the paper's figures.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "MadeUpSessions.h"
#include "analysis/Analysis.h"
#include "analysis/charts/Charts.h"
#include "analysis/report/Tables.h"

namespace heft {
namespace {

using namespace made_up;
using testing::HasSubstr;

Summary summary_of(double reference_g, Purpose purpose = Purpose::main) {
  std::vector<SessionData> sessions;
  for (const double jnd_g : {100.0, 120.0}) {
    const auto id = static_cast<std::int64_t>(sessions.size()) + 1;
    const char* responder = purpose == Purpose::main ? "human" : "simulated";
    SessionData data = session(id, std::to_string(id), purpose, responder);
    add_introduction(data, 1);
    add_sortings(data, "C1", "correct", 2);
    add_staircase(data, "s", reference_g, jnd_g);
    sessions.push_back(data);
  }
  return summarize({"x.db", sessions}, "");
}

const StudyEstimate& named(const Summary& summary, std::string_view what) {
  const auto all = published_among(summary.estimates);
  return **std::ranges::find_if(all, [&](const auto* one) { return one->published->what == what; });
}

TEST(PublishedBeside, HasThePapersIntervalsAndWhatWasFound) {
  const Summary summary = summary_of(15);
  const StudyEstimate& jnd = named(summary, "JND at 15 g");
  EXPECT_EQ(jnd.published->value, 172.3);
  const double half = 2.17881282966723 * 72.4 / std::sqrt(13);  // Student's t, 12 df
  EXPECT_NEAR(interval_of(*jnd.published)->low, 172.3 - half, 1e-9);
  EXPECT_EQ(jnd.value, 110);
  EXPECT_EQ(jnd.n, 2);
  EXPECT_THAT(std::string(jnd.published->source), HasSubstr("Experiment 2"));

  const StudyEstimate& first_try = named(summary, "introduction, first try");
  EXPECT_NEAR(interval_of(*first_try.published)->low, 100 * std::pow(0.025, 1.0 / 13), 1e-9);
  EXPECT_EQ(first_try.value, 100);

  const StudyEstimate& unsure = named(summary, "C1 I don't know");
  EXPECT_FALSE(interval_of(*unsure.published).has_value());  // the paper gives no SD
  EXPECT_EQ(named(summary, "C1 correct").published->sd, 9.6);
}

// JNDs of 50, 160 and 300 g; Heft's mean is that of a log-normal distribution.
TEST(PublishedBeside, ThePapersArithmeticMeanStandsBesideOurs) {
  std::vector<SessionData> sessions;
  for (const double jnd_g : {50.0, 160.0, 300.0}) {
    const auto id = static_cast<std::int64_t>(sessions.size()) + 1;
    sessions.push_back(session(id, std::to_string(id), Purpose::main, "human"));
    add_staircase(sessions.back(), "s", 200, jnd_g);
  }
  const Summary summary = summarize({"x.db", sessions}, "");
  const auto figures_of = [&](std::string_view name) {
    return fmt::format(
        "{}",
        fmt::join(std::ranges::find(summary.hypotheses, name, &Hypothesis::name)->figures, "\n"));
  };
  const double ours = *find_estimate(summary.estimates, "jnd", {{"reference_g", "200"}})->value;
  EXPECT_GT(std::abs(ours - 170), 1);
  EXPECT_THAT(figures_of("E2-H1"), HasSubstr(fmt::format("JND at 200 g: {:.1f} g", ours)));
  EXPECT_THAT(figures_of("E2-H1"), HasSubstr("arithmetic mean 170.0, published "));
  EXPECT_THAT(figures_of("E2-H2"), HasSubstr("arithmetic mean 0.85, published "));
}

TEST(PublishedBeside, FiguresFrom1000GramsHaveNoDecimals) {
  std::vector<SessionData> sessions;
  for (const double jnd_g : {1010.3, 1620.7, 3030.9}) {
    const auto id = static_cast<std::int64_t>(sessions.size()) + 1;
    sessions.push_back(session(id, std::to_string(id), Purpose::main, "human"));
    add_staircase(sessions.back(), "s", 200, jnd_g);
  }
  const Summary summary = summarize({"x.db", sessions}, "");
  const auto found = std::ranges::find(summary.hypotheses, "E2-H1", &Hypothesis::name);
  EXPECT_THAT(found->figures.at(0), HasSubstr("arithmetic mean 1890, published 271.5 g"));
}

TEST(PublishedBeside, IsOnlyOfWhatThePaperMeasured) {
  const Summary summary = summary_of(300);
  for (const StudyEstimate* one : published_among(summary.estimates))
    EXPECT_EQ(one->measure->unit, "%") << one->published->what;
}

std::string chart_of(const Summary& summary) {
  const auto charts = charts_of(summary);
  return std::ranges::find(charts, "beside_published", &Chart::name)->script;
}

// Otherwise all other values would be at 0.
TEST(PublishedBeside, CutsIntervalsThatAreMuchLongerThanAllValues) {
  Summary summary = summary_of(15);
  const auto chart = [&](std::string_view name) {
    const auto charts = charts_of(summary);
    return *std::ranges::find(charts, name, &Chart::name);
  };
  const auto set_high = [&](double high_g) {
    for (StudyEstimate& one : summary.estimates)
      if (one.published && one.measure->unit == "g") {
        one.value = 100;
        one.low = 50;
        one.high = high_g;
      }
  };
  set_high(300);
  EXPECT_THAT(chart("beside_published").script, HasSubstr("set xrange [0:*]"));
  EXPECT_THAT(chart("jnd").script, HasSubstr("set yrange [0:*]"));
  set_high(40000);
  for (const char* name : {"beside_published", "jnd"}) {
    const Chart cut = chart(name);
    EXPECT_THAT(cut.script, Not(HasSubstr("range [0:*]")));
    EXPECT_THAT(cut.caption, HasSubstr("Intervals that reach the frame extend beyond it."));
  }
}

TEST(PublishedBeside, AModelsFiguresSaySo) {
  EXPECT_THAT(chart_of(summary_of(15, Purpose::simulated)),
              HasSubstr("'simulated participants (n = 2)'"));
  EXPECT_THAT(chart_of(summary_of(15)), HasSubstr("'these participants (n = 2)'"));
}

}  // namespace
}  // namespace heft
