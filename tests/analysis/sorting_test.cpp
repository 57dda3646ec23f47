// Sorting: final labels, what was exchanged, and percentages per condition.
#include "analysis/Sorting.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <array>

#include "MadeUpSessions.h"
#include "base/Random.h"

namespace heft {
namespace {

using namespace made_up;
using testing::ElementsAre;
using Labels = std::array<std::optional<Label>, 3>;

constexpr Label L = "lightest", I = "intermediate", H = "heaviest";
constexpr std::array masses_g{15.0, 200.0, 800.0};

std::optional<Swap> swapped(Label light, Label intermediate, Label heavy) {
  return swap_of(masses_g, Labels{light, intermediate, heavy});
}

TEST(Swap, EachOfTheSixOrders) {
  EXPECT_EQ(swapped(L, I, H), std::nullopt);
  EXPECT_EQ(swapped(I, L, H), Swap::light_intermediate);
  EXPECT_EQ(swapped(L, H, I), Swap::intermediate_heavy);
  EXPECT_EQ(swapped(H, I, L), Swap::light_heavy);
  EXPECT_EQ(swapped(I, H, L), Swap::all_three);
  EXPECT_EQ(swapped(H, L, I), Swap::all_three);
}

TEST(Swap, NeedsThreeDifferentLabels) {
  EXPECT_EQ(swap_of(masses_g, Labels{I, std::nullopt, H}), std::nullopt);
  EXPECT_EQ(swap_of(masses_g, Labels{I, I, L}), std::nullopt);
  EXPECT_EQ(swap_of(std::array{15.0, 800.0}, std::array<std::optional<Label>, 2>{H, L}),
            std::nullopt);
}

RC_GTEST_PROP(Swap, DoesNotDependOnWhereTheCubesStand, ()) {
  std::array<std::size_t, 3> places{0, 1, 2};
  RandomStream stream(*rc::gen::arbitrary<std::uint64_t>(), "places");
  stream.shuffle(std::span<std::size_t>(places));
  std::array<Label, 3> given{L, I, H};
  stream.shuffle(std::span<Label>(given));
  std::array<double, 3> moved_g{};
  Labels moved;
  for (std::size_t i = 0; i < 3; ++i) {
    moved_g.at(places.at(i)) = masses_g.at(i);
    moved.at(places.at(i)) = given.at(i);
  }
  RC_ASSERT(swap_of(moved_g, moved) == swapped(given[0], given[1], given[2]));
}

TEST(FinalLabels, AUsedLabelMovesAndAnUnlabelRemoves) {
  AnswerRow unlabel;
  unlabel.action = "unlabel";
  unlabel.slot = 3;
  const std::vector<AnswerRow> answers{label(1, L), label(2, L), label(3, I), unlabel, label(1, H)};
  EXPECT_THAT(final_labels(answers, 3),
              ElementsAre(std::optional(H), std::optional(L), std::nullopt));
}

TEST(Sorting, PercentagesOverAllAndOverAnsweredTrials) {
  SessionData a = session(1, "a"), b = session(2, "b");
  add_sortings(a, "C1", "correct", 1);
  add_sortings(a, "C1", "incorrect", 1);
  add_sortings(a, "C1", "dont_know", 3);
  add_sortings(b, "C1", "dont_know", 5);  // answered none
  const auto sorting = sorting_of(std::vector{a, b});
  EXPECT_EQ(sorting[0].n_trials, 10);
  EXPECT_DOUBLE_EQ(*sorting[0].correct.mean_percent, 10);
  EXPECT_DOUBLE_EQ(*sorting[0].incorrect.mean_percent, 10);
  EXPECT_DOUBLE_EQ(*sorting[0].none.mean_percent, 80);
  EXPECT_DOUBLE_EQ(*sorting[0].answered_correct.mean_percent, 50);
  EXPECT_EQ(sorting[0].answered_correct.n_participants, 1);
  EXPECT_EQ(sorting.size(), 1);  // of conditions that were run
}

TEST(Sorting, SessionsOfOneParticipantCountTogether) {
  SessionData first = session(1, "a"), again = session(2, "a");
  add_sortings(first, "C2", "correct", 5);
  add_sortings(again, "C2", "incorrect", 5);
  const auto sorting = sorting_of(std::vector{first, again});
  EXPECT_EQ(sorting[0].n_participants, 1);
  EXPECT_DOUBLE_EQ(*sorting[0].correct.mean_percent, 50);
}

TEST(Sorting, OnlyCompletedTrialsCount) {
  SessionData data = session(1, "a");
  add_sorting(data, "C2", "correct");
  add_sorting(data, "C2", "incorrect").trial.status = TrialStatus::voided;
  add_sorting(data, "C2", "incorrect").trial.status = TrialStatus::open;
  EXPECT_EQ(sorting_of({&data, 1})[0].n_trials, 1);
}

TEST(Sorting, CountsSwapsOfIncorrectTrials) {
  SessionData data = session(1, "a");
  add_sorting(data, "C2", "incorrect").answers = {label(1, I), label(2, L), label(3, H)};
  add_sorting(data, "C2", "correct").answers = {label(1, L), label(2, I), label(3, H)};
  EXPECT_THAT(sorting_of({&data, 1})[0].swaps, ElementsAre(1, 0, 0, 0));
}

TEST(Sorting, ChanceIsOneOfTheOrdersOfAsManyCubes) {
  SessionData data = session(1, "a");
  EXPECT_TRUE(sorting_of({&data, 1}).empty());
  add_sorting(data, "C2", "correct");
  EXPECT_DOUBLE_EQ(*sorting_of({&data, 1})[0].chance_percent(), 100.0 / 6);
  add_sorting(data, "C2", "correct").cubes = cubes({15, 100, 250, 800});
  EXPECT_DOUBLE_EQ(*sorting_of({&data, 1})[0].chance_percent(), (100.0 / 6 + 100.0 / 24) / 2);
  EXPECT_DOUBLE_EQ(chance_percent(2), 50);
  EXPECT_DOUBLE_EQ(chance_percent(5), 100.0 / 120);
}

TEST(Sorting, PublishedFiguresNeedThePublishedMasses) {
  SessionData data = session(1, "a");
  add_sorting(data, "C1", "correct");
  EXPECT_EQ(sorting_of({&data, 1})[0].published, published::Condition::coupled);
  add_sorting(data, "C1", "correct").cubes = cubes({15, 250, 800});
  EXPECT_FALSE(sorting_of({&data, 1})[0].published.has_value());
}

TEST(Sorting, PublishedFiguresNeedThePublishedTechnique) {
  SessionData data = session(1, "a");
  data.published_conditions = {{"mine", published::Condition::decoupled}};
  add_sorting(data, "C2", "correct");  // here a technique of another law
  add_sorting(data, "mine", "correct");
  const auto sorting = sorting_of({&data, 1});
  EXPECT_FALSE(sorting.at(0).published.has_value());
  EXPECT_EQ(sorting.at(1).published, published::Condition::decoupled);
}

TEST(Sorting, EveryLabelIsCountedWhateverTheNumberOfCubes) {
  SessionData data = session(1, "a");
  Attempt& attempt = add_sorting(data, "C2", "incorrect");
  attempt.cubes = cubes({400, 100});
  attempt.answers = {label(1, "1"), label(2, "2")};
  EXPECT_THAT(sorting_of({&data, 1}).at(0).labels.at(2),
              ElementsAre(ElementsAre(0, 1), ElementsAre(1, 0)));
}

}  // namespace
}  // namespace heft
