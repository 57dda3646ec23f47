// Logs of several labs: the threshold of each lab, and how much the labs differ.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "analysis/Analysis.h"
#include "analysis/MadeUpChoosers.h"
#include "analysis/measures/Section.h"
#include "analysis/report/Tables.h"
#include "record/export/Export.h"

namespace heft {
namespace {

using namespace made_up;
using testing::ElementsAre;
using testing::HasSubstr;

void add_lab(Dataset& dataset, const std::string& lab, double threshold_g, int n_people) {
  RandomStream stream(5, lab);
  for (int i = 0; i < n_people; ++i) {
    SessionData data = session(i + 1, fmt::format("{}: P{}", lab, i));
    data.lab = lab;
    compare(data, Population{threshold_g}.draw(stream), paired_at(200), stream);
    dataset.sessions.push_back(data);
  }
}

TEST(Labs, AreNamedByTheirLogs) {
  EXPECT_THAT(lab_names({"data/lyon.db", "zurich.db"}), ElementsAre("lyon", "zurich"));
  EXPECT_THAT(lab_names({"a/heft.db", "b/heft.db", "c.db"}),
              ElementsAre("a/heft.db", "b/heft.db", "c"));
}

TEST(Labs, HaveTheirThresholdsAndRatio) {
  Dataset dataset{"a.db, b.db", {}};
  add_lab(dataset, "a", 100, 30);
  add_lab(dataset, "b", 250, 30);
  const Summary summary = summarize(dataset, "");
  for (const auto& [lab, truth_g] : {std::pair("a", 100), {"b", 250}}) {
    const StudyEstimate* one = find_estimate(summary.estimates, "lab_threshold_75", {{"lab", lab}});
    ASSERT_TRUE(one && one->value);
    EXPECT_EQ(one->n, 30);
    EXPECT_LT(*one->low, truth_g);
    EXPECT_GT(*one->high, truth_g);
  }
  const StudyEstimate* ratio = find_estimate(summary.estimates, "lab_threshold_ratio");
  ASSERT_TRUE(ratio);
  EXPECT_EQ(ratio->text_at("lab") + "/" + ratio->text_at("other_lab"), "b/a");
  EXPECT_EQ(ratio->n, 60);
  EXPECT_LT(*ratio->low, 2.5);
  EXPECT_GT(*ratio->high, 2.5);
  EXPECT_GT(*ratio->low, 1.2);
  const std::string text = readable(summary);
  EXPECT_THAT(text, HasSubstr("Thresholds of each lab"));
  EXPECT_THAT(text, HasSubstr("Differences between labs"));
}

// Where both fits are of different people, the variances of the logarithms add up.
TEST(Labs, DifferAsMuchAsTheirIntervalsAllow) {
  Dataset dataset{"a.db, b.db", {}};
  add_lab(dataset, "a", 150, 20);
  add_lab(dataset, "b", 150, 20);
  const Summary summary = summarize(dataset, "");
  double variance = 0;
  for (const StudyEstimate* one : estimates_of(summary.estimates, "lab_threshold_75"))
    variance += std::pow(std::log(*one->high / *one->low), 2);
  const StudyEstimate* ratio = find_estimate(summary.estimates, "lab_threshold_ratio");
  EXPECT_NEAR(std::log(*ratio->high / *ratio->low), std::sqrt(variance), 0.1 * std::sqrt(variance));
}

TEST(Labs, OfOneLogOrTooFewPeopleAreNotCompared) {
  Dataset dataset{"a.db", {}};
  add_lab(dataset, "", 150, 8);
  EXPECT_EQ(find_estimate(summarize(dataset, "").estimates, "lab_threshold_75"), nullptr);
  add_lab(dataset, "b", 150, 2);
  const Summary summary = summarize(dataset, "");
  EXPECT_THAT(find_estimate(summary.estimates, "lab_threshold_75", {{"lab", "b"}})->why,
              HasSubstr("too few"));
  EXPECT_EQ(find_estimate(summary.estimates, "lab_threshold_ratio"), nullptr);
}

}  // namespace
}  // namespace heft
