// The people of the procedures study are as stated; its quick run writes its files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "StudyFolder.h"
#include "results/procedures/ProceduresStudy.h"

namespace heft {
namespace {

const Observer& observer_named(std::string_view name) {
  for (const Observer& observer : study_observers())
    if (observer.name == name) return observer;
  throw std::runtime_error("no observer " + std::string(name));
}

double share_of(Choice choice, const Observer& observer, double level_g, int trial,
                AnswerSet answers) {
  constexpr int n = 40'000;
  RandomStream stream(7, "answers");
  int n_chosen = 0;
  for (int i = 0; i < n; ++i)
    n_chosen += observer.answer(level_g, trial, answers, stream) == choice;
  return static_cast<double>(n_chosen) / n;
}

TEST(StudyObserver, IsCorrectInThreeQuartersOfForcedChoicesAtItsThreshold) {
  const Observer& no_lapses = observer_named("no lapses");
  EXPECT_NEAR(share_of(Choice::comparison, no_lapses, 140, 0, AnswerSet::forced_choice), 0.75,
              0.01);
  const Observer& tires = observer_named("tires: threshold 140 to 280 g");
  EXPECT_NEAR(tires.threshold_in(50), std::sqrt(140.0 * 280), 1e-9);
  EXPECT_NEAR(share_of(Choice::comparison, tires, 280, 100, AnswerSet::forced_choice),
              0.98 * 0.75 + 0.01, 0.01);
}

TEST(StudyObserver, HasTheFalseAlarmsOfItsName) {
  for (const auto& [name, share] : {std::pair{"no lapses", 0.1},
                                    {"criterion 1.28 SD (false alarms 20 %)", 0.2},
                                    {"criterion 1.96 SD (false alarms 5 %)", 0.05}}) {
    Observer observer = observer_named(name);
    observer.lapse = 0;
    EXPECT_NEAR(1 - share_of(Choice::none, observer, 0, 0, AnswerSet::three_way), share, 0.01)
        << name;
  }
  EXPECT_EQ(share_of(Choice::none, observer_named("criterion 0"), 0, 0, AnswerSet::forced_choice),
            0);
}

TEST(StudyObserver, LapsesMoreWhereItsNameSaysSo) {
  const Observer& growing = observer_named("lapses grow from 0 to 10 %");
  EXPECT_NEAR(share_of(Choice::reference, growing, 3000, 0, AnswerSet::forced_choice), 0, 1e-9);
  EXPECT_NEAR(share_of(Choice::reference, growing, 3000, 100, AnswerSet::forced_choice), 0.05,
              0.01);
}

TEST(ProceduresStudy, QuickRunMakesEveryFile) {
  const StudyFolder study("procedures");
  run_procedures_study(study.options());
  const auto figures = study.csv("observers.csv");
  // Thirteen fits, and eleven estimates by the procedures themselves: constant stimuli have none.
  EXPECT_EQ(figures.rows.size(), (13 + 11) * 6 * trials_read.size());
  for (const double share : figures.numbers("coverage")) EXPECT_TRUE(share >= 0 && share <= 1);
  EXPECT_FALSE(figures.numbers("log_rmse").empty());
  EXPECT_FALSE(figures.numbers("criterion_bias_sd").empty());
  EXPECT_TRUE(study.has_chart("failures.svg"));
  EXPECT_TRUE(study.has_chart("errors.svg"));
}

}  // namespace
}  // namespace heft
