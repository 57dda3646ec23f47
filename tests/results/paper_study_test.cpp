// Scores of rival models against known distributions, and the files of the quick study.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "StudyFolder.h"
#include "base/Program.h"
#include "base/Random.h"
#include "results/paper/PaperStudy.h"

namespace heft {
namespace {

std::vector<PaperFigure> of_the_paper() {
  const std::string file = installed_file("protocols/examples/paper_figures.toml");
  return paper_figures(parse_figures(read_text_file(file), file));
}

TEST(PaperFigures, AreFifteenOfWhichThirteenAreIndependent) {
  const auto figures = of_the_paper();
  EXPECT_EQ(figures.size(), 15u);
  EXPECT_EQ(std::ranges::count_if(figures, &PaperFigure::independent), 13);
  EXPECT_EQ(std::ranges::count(figures, PaperExperiment::jnd, &PaperFigure::experiment), 6);
}

TEST(Rivals, AreAtLeastFourMechanismsAndSixNullModelsOfFewParameters) {
  int n_mechanisms = 0, n_nulls = 0;
  for (const Rival& rival : rivals()) {
    n_mechanisms += rival.group == RivalGroup::mechanism ? 1 : 0;
    n_nulls += rival.group == RivalGroup::null ? 1 : 0;
    EXPECT_LE(rival.free.size(), 6u) << rival.name;
    for (const RivalParameter& one : rival.free) EXPECT_TRUE(one.sorting || one.jnd) << rival.name;
  }
  EXPECT_GE(n_mechanisms, 4);
  EXPECT_GE(n_nulls, 6);
}

PaperFigure percent(double value) {
  PaperFigure figure;
  figure.value = value;
  figure.range = 100;
  return figure;
}

// Studies about 50 % with a standard deviation of 10; a score at z standard deviations from there.
TEST(FigureScore, IsTheLogDensityRelativeToAnEvenOne) {
  RandomStream stream(1, "studies");
  std::vector<double> studies;
  for (int i = 0; i < 4000; ++i) studies.push_back(50 + 10 * stream.normal());
  for (const double z : {0.0, 1.0, 1.5}) {
    const FigureScore score = score_of(percent(50 + 10 * z), studies);
    const double density = std::exp(-z * z / 2) / (10 * std::sqrt(2 * std::numbers::pi));
    EXPECT_NEAR(score.log_score, std::log(100 * density), 0.1);
    EXPECT_NEAR(score.place, 0.5 * std::erfc(-z / std::numbers::sqrt2), 0.03);
    EXPECT_TRUE(score.hit);
  }
  EXPECT_FALSE(score_of(percent(72), studies).hit);
  EXPECT_NEAR(score_of(percent(100), studies).log_score, std::log(0.01), 0.01) << "at worst";
  EXPECT_NEAR(score_of(percent(50), studies).low, 50 - 19.6, 1);
}

TEST(FigureScore, OfAFigureThatNoStudyHasIsTheWorst) {
  const FigureScore score = score_of(percent(50), {});
  EXPECT_FALSE(score.hit);
  EXPECT_NEAR(score.log_score, std::log(0.01), 1e-9);
}

TEST(FigureScore, AFigureThatNeverVariesIsHitUpToRounding) {
  EXPECT_TRUE(score_of(percent(6.2), std::vector<double>(10, 6.154)).hit);
  EXPECT_FALSE(score_of(percent(6.2), std::vector<double>(10, 6.3)).hit);
  EXPECT_EQ(score_of(percent(6.2), std::vector<double>(10, 6.154)).place, 0.5);
}

TEST(PaperStudy, QuickRunMakesEveryFile) {
  const StudyFolder study("paper");
  testing::internal::CaptureStdout();
  run_paper_study(study.options());
  EXPECT_THAT(testing::internal::GetCapturedStdout(), testing::HasSubstr("fitted to 1, coin"));
  const auto figures = study.csv("figures.csv");
  EXPECT_EQ(figures.rows.size(), 2 * 15 * rivals().size());
  for (const double place : figures.numbers("share_below")) EXPECT_TRUE(place >= 0 && place <= 1);
  for (const double score : figures.numbers("log_score")) EXPECT_GE(score, std::log(0.01) - 1e-3);
  std::set<double> paper;
  for (const double value : figures.numbers("paper")) paper.insert(value);
  EXPECT_EQ(paper.size(), 15u);
  EXPECT_FALSE(study.csv("parameters.csv").rows.empty());
  EXPECT_EQ(study.csv("totals.csv").rows.size(), 4 * rivals().size());
  EXPECT_EQ(study.csv("unreported.csv").rows.size(), 2 * 3 * rivals().size());
  EXPECT_TRUE(study.has_chart("models.svg"));
}

}  // namespace
}  // namespace heft
