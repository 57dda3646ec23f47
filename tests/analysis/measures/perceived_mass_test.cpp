// Perceived mass by sorting: which orders are used, and what is printed.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "analysis/Figures.h"
#include "analysis/MadeUpSessions.h"
#include "psychophysics/ObserverModels.h"

namespace heft {
namespace {

using namespace made_up;
using testing::HasSubstr;

// Two cubes of 400 and 100 g, in this order of slots.
void sort_two(SessionData& data, const std::string& condition, bool rightly) {
  Attempt& attempt = add_sorting(data, condition, rightly ? "correct" : "incorrect");
  attempt.cubes = cubes({400, 100});
  attempt.answers = {label(1, rightly ? "2" : "1"), label(2, rightly ? "1" : "2")};
}

// Six people, of whom each sorts ten times, eight of them rightly; and other trials.
std::vector<SessionData> six_people() {
  std::vector<SessionData> all;
  for (int i = 1; i <= 6; ++i) {
    SessionData data = session(i, fmt::format("P{}", i));
    for (int k = 0; k < 10; ++k) sort_two(data, "C2", k < 8);
    add_sorting(data, "C2", "dont_know").cubes = cubes({100, 400});
    sort_two(data, "C2", false);
    data.attempts.back().trial.status = TrialStatus::voided;
    add_sorting(data, "C1", "dont_know");
    all.push_back(data);
  }
  return all;
}

TEST(PerceivedMass, IsTheNormalQuantileOfCorrectOrdersOfTwo) {
  const Summary summary = summarized(six_people());
  const StudyEstimate heavy =
      figure(summary, "perceived_mass", {{"condition", "C2"}, {"mass_g", "400"}});
  EXPECT_NEAR(*heavy.value, normal_quantile(0.8), 1e-5);
  EXPECT_LT(*heavy.low, *heavy.value);
  EXPECT_GT(*heavy.high, *heavy.value);
  EXPECT_EQ(heavy.n, 6);
  EXPECT_EQ(heavy.n_trials, 60);
  EXPECT_EQ(figure(summary, "perceived_mass", {{"condition", "C2"}, {"mass_g", "100"}}).value, 0);
  EXPECT_EQ(figure(summary, "perceived_distance", {{"condition", "C2"}}).value, heavy.value);
}

// Six people, of whom each sorts two cubes ten times in C1 and in C2.
StudyEstimate contrast_of(const std::vector<int>& n_right_in_c1,
                          const std::vector<int>& n_right_in_c2) {
  std::vector<SessionData> all;
  for (int i = 0; i < 6; ++i) {
    SessionData data = session(i + 1, fmt::format("P{}", i));
    for (int k = 0; k < 10; ++k) {
      sort_two(data, "C1", k < n_right_in_c1[static_cast<std::size_t>(i)]);
      sort_two(data, "C2", k < n_right_in_c2[static_cast<std::size_t>(i)]);
    }
    all.push_back(data);
  }
  return figure(all, "perceived_mass_contrast",
                {{"condition", "C2"}, {"other_condition", "C1"}, {"mass_g", "400"}});
}

TEST(PerceivedMass, InTwoConditionsIsComparedWithinPeople) {
  const StudyEstimate same = contrast_of({5, 6, 7, 5, 6, 7}, {7, 8, 9, 7, 8, 9});
  EXPECT_NEAR(*same.value, normal_quantile(0.8) - normal_quantile(0.6), 1e-5);
  EXPECT_GT(*same.low, 0);
  EXPECT_NEAR(*same.high - *same.value, *same.value - *same.low, 1e-9);
  EXPECT_EQ(same.n, 6);
  const StudyEstimate crossed = contrast_of({5, 6, 7, 5, 6, 7}, {9, 8, 7, 9, 8, 7});
  EXPECT_NEAR(*crossed.value, *same.value, 1e-5);
  EXPECT_GT(*crossed.high - *crossed.low, *same.high - *same.low);
}

TEST(PerceivedMass, InOneConditionHasNoContrast) {
  EXPECT_FALSE(find_estimate(summarized(six_people()).estimates, "perceived_mass_contrast"))
      << "in C1 no trial was answered";
}

TEST(PerceivedMass, OfNoAnswersIsNone) {
  const StudyEstimate none = figure(six_people(), "perceived_mass", {{"condition", "C1"}});
  EXPECT_FALSE(none.value);
  EXPECT_EQ(none.why, "no trial with this cube was answered");
}

TEST(PerceivedMass, OfFewPeopleIsNone) {
  auto people = six_people();
  people.resize(3);
  const StudyEstimate none =
      figure(people, "perceived_mass", {{"condition", "C2"}, {"mass_g", "400"}});
  EXPECT_FALSE(none.value);
  EXPECT_FALSE(none.low);
  EXPECT_THAT(none.why, HasSubstr("3 participants are too few"));
}

}  // namespace
}  // namespace heft
