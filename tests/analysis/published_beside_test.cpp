// What was found beside the paper's own figures.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "MadeUpSessions.h"
#include "analysis/Charts.h"
#include "analysis/PublishedBeside.h"

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

const PublishedFigure& named(const std::vector<PublishedFigure>& all, std::string_view what) {
  return *std::ranges::find(all, what, &PublishedFigure::what);
}

TEST(PublishedBeside, HasThePapersIntervalsAndWhatWasFound) {
  const auto all = published_beside(summary_of(15));
  const PublishedFigure& jnd = named(all, "JND at 15 g");
  EXPECT_EQ(jnd.published, 172.3);
  const double half = 2.17881282966723 * 72.4 / std::sqrt(13);  // Student's t, 12 df
  EXPECT_NEAR(jnd.published_interval->low, 172.3 - half, 1e-9);
  EXPECT_EQ(jnd.found, 110);
  EXPECT_EQ(jnd.n, 2);
  EXPECT_THAT(jnd.source, HasSubstr("Experiment 2"));

  const PublishedFigure& first_try = named(all, "introduction, first try");
  EXPECT_NEAR(first_try.published_interval->low, 100 * std::pow(0.025, 1.0 / 13), 1e-9);
  EXPECT_EQ(first_try.found, 100);

  const PublishedFigure& unsure = named(all, "C1 I don't know");
  EXPECT_FALSE(unsure.published_interval.has_value());  // the paper gives no SD
  EXPECT_EQ(named(all, "C1 correct").published_sd, 9.6);
}

TEST(PublishedBeside, IsOnlyOfWhatThePaperMeasured) {
  for (const PublishedFigure& figure : published_beside(summary_of(300)))
    EXPECT_EQ(figure.unit, "%") << figure.what;
}

TEST(PublishedBeside, AModelsFiguresSaySo) {
  EXPECT_THAT(published_chart(summary_of(15, Purpose::simulated)).script,
              HasSubstr("'simulated participants (n = 2)'"));
  EXPECT_THAT(published_chart(summary_of(15)).script, HasSubstr("'these participants (n = 2)'"));
}

}  // namespace
}  // namespace heft
