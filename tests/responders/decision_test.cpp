// From percepts to answers.
#include "responders/decision/Decision.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tasks/Offers.h"

namespace heft {
namespace {
using testing::ElementsAre;
using testing::IsEmpty;

// Nothing but the criterion: no noise, lapse or guess.
ResponderParameters certain() {
  ResponderParameters parameters;
  parameters.criterion_mm = 4;
  parameters.criterion_fraction = 0.1;
  return parameters;
}

Answer decide(const ResponderParameters& parameters, Task task, std::vector<double> percepts_mm,
              std::vector<int> wrong_slots = {}, int trial = 1) {
  return Decision(parameters, 7, {trial, 1, std::move(task), {}}).decide(percepts_mm, wrong_slots);
}

TEST(Decision, TheCriterionGrowsWithTheLargerPercept) {
  // 4 mm + a tenth of the larger one.
  EXPECT_EQ(chosen_slot(decide(certain(), "comparison", {16.1, 10})), 1);
  EXPECT_EQ(chosen_slot(decide(certain(), "comparison", {10, 15.4})), std::nullopt);
  EXPECT_EQ(chosen_slot(decide(certain(), "comparison", {100, 106})), std::nullopt);
  EXPECT_EQ(chosen_slot(decide(certain(), "comparison", {100, 116})), 2);
  EXPECT_EQ(chosen_slot(decide(certain(), "comparison", {0, 0})), std::nullopt);
}

TEST(Decision, SortingLabelsByPerceptOrGivesUp) {
  EXPECT_THAT(given_labels(decide(certain(), "sorting", {30, 2, 90})),
              ElementsAre("intermediate", "lightest", "heaviest"));
  EXPECT_THAT(given_labels(decide(certain(), "sorting", {1, 2, 3})), IsEmpty());
}

TEST(Decision, GuessesAsOftenAsItsParameterSays) {
  ResponderParameters parameters = certain();
  parameters.judgment_noise_mm = 0.1;
  parameters.guess_probability = 0.3;
  int n_guesses = 0;
  for (int trial = 1; trial <= 1000; ++trial)
    n_guesses += given_labels(decide(parameters, "sorting", {0, 0, 0}, {}, trial)).empty() ? 0 : 1;
  EXPECT_NEAR(n_guesses, 300, 60);  // four standard deviations
}

TEST(Decision, ALapseAnswersAnythingEquallyOften) {
  ResponderParameters parameters = certain();
  parameters.lapse_rate = 1;
  std::array<int, 3> counts{};
  for (int trial = 1; trial <= 3000; ++trial)
    ++counts[static_cast<std::size_t>(
        chosen_slot(decide(parameters, "comparison", {0, 90}, {}, trial)).value_or(0))];
  for (int count : counts) EXPECT_NEAR(count, 1000, 105);  // four standard deviations
}

TEST(Decision, TheIntroductionAlwaysNamesACubeAndNotTheOneJustFoundWrong) {
  EXPECT_EQ(chosen_slot(decide(certain(), "introduction", {0, 0.1})), 2);
  EXPECT_EQ(chosen_slot(decide(certain(), "introduction", {0, 0.1}, {2})), 1);
  EXPECT_EQ(chosen_slot(decide(certain(), "introduction", {0, 0.1}, {2, 1})), 2)
      << "shuffled since";
}

RC_GTEST_PROP(HeaviestSlot, IsTheLargestThatIsNotRuledOut, ()) {
  const auto values =
      *rc::gen::nonEmpty(rc::gen::container<std::vector<double>>(rc::gen::arbitrary<double>()));
  const int n = static_cast<int>(values.size());
  const auto wrong = *rc::gen::container<std::vector<int>>(rc::gen::inRange(1, n + 1));
  const int slot = heaviest_slot(values, wrong);
  RC_ASSERT(slot >= 1 && slot <= n);
  const auto recent =
      std::span(wrong).last(std::min(wrong.size(), static_cast<std::size_t>(n - 1)));
  const auto ruled_out = [&](int s) { return std::ranges::find(recent, s) != recent.end(); };
  RC_ASSERT(!ruled_out(slot));
  for (int other = 1; other <= n; ++other)
    RC_ASSERT(ruled_out(other) || values[static_cast<std::size_t>(other - 1)] <=
                                      values[static_cast<std::size_t>(slot - 1)]);
}

// Words for three cubes, ranks for any other number: what the screen offers.
TEST(Decision, LabelsAreThoseThatATrialOfSoManyCubesHas) {
  EXPECT_THAT(labels_in_order(std::vector{3.0, 1.0}), ElementsAre("2", "1"));
  EXPECT_THAT(labels_in_order(std::vector{3.0, 1.0, 2.0}),
              ElementsAre("heaviest", "lightest", "intermediate"));
  EXPECT_THAT(labels_in_order(std::vector{6.0, 1.0, 5.0, 2.0, 4.0, 3.0}),
              ElementsAre("6", "1", "5", "2", "4", "3"));
}

}  // namespace
}  // namespace heft
