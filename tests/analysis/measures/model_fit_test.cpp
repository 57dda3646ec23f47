// What the report says of a model that predicts the data, and of one that does not.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "analysis/Analysis.h"
#include "analysis/MadeUpChoosers.h"
#include "analysis/report/Methods.h"
#include "analysis/report/Notes.h"
#include "analysis/report/Report.h"
#include "analysis/report/Tables.h"

namespace heft {
namespace {

using namespace made_up;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Summary summary_of_twelve() {
  RandomStream stream(51, "checked");
  return summarize({"x.db", study(12, Population{150, 0.3, 1}, {paired_at(200)}, stream)}, "");
}

std::string findings_in_a_line(const Summary& summary) {
  return fmt::format("{}", fmt::join(findings_of(summary), " "));
}

std::string methods_in_a_line(const Summary& summary) {
  return fmt::format("{}", fmt::join(methods_of(summary).paragraphs, " "));
}

TEST(ModelFit, ThatHoldsIsNamedAfterTheThresholds) {
  const Summary summary = summary_of_twelve();
  EXPECT_THAT(findings_in_a_line(summary),
              AllOf(HasSubstr(" at 200 g. Predictive check of the indecision model: passed"),
                    Not(HasSubstr("Doubt"))));
  EXPECT_THAT(methods_in_a_line(summary),
              HasSubstr("The model was checked in 500 simulated studies, in which people of the "
                        "fitted population ran the participants' staircases: its predictions agree "
                        "with the data (smallest p = 0."));
  const auto json = nlohmann::json::parse(as_json(summary));
  EXPECT_GT(json["model_fit"].at(0)["p"], 0.05);
  EXPECT_EQ(json["model_fit"].at(0)["n_studies"], 500);
}

TEST(ModelFit, ThatDoesNotHoldCastsDoubtWhereverThresholdsStand) {
  Summary summary = summary_of_twelve();
  for (StudyEstimate& one : summary.estimates)
    if (one.measure->name == "predictive_p") one.value = 0.002;
  const std::string doubt =
      "Doubt these thresholds: the indecision model does not predict what was seen (p = 0.002): ";
  EXPECT_THAT(findings_in_a_line(summary), HasSubstr(" at 200 g. " + doubt));
  EXPECT_THAT(readable(summary), HasSubstr("Doubt these thresholds"));
  EXPECT_THAT(first_screen(summary, {}), HasSubstr("Doubt these thresholds"));
  EXPECT_THAT(methods_in_a_line(summary),
              HasSubstr("it does not predict the data at 200 g in C2 (smallest p = 0.002"));
}

}  // namespace
}  // namespace heft
