// Sorting: final labels, what was exchanged, and percentages per condition.
#include "analysis/dataset/Sorting.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <array>

#include "Figures.h"
#include "MadeUpSessions.h"
#include "base/Random.h"

namespace heft {
namespace {

using namespace made_up;
using testing::ElementsAre;

// A share of all trials, or of answered ones.
StudyEstimate share(const Summary& summary, const char* trials, const char* answer) {
  return figure(summary, "sorting_answers", {{"trials", trials}, {"answer", answer}});
}
int n_trials(const SessionData& data) {
  return share(summarized({data}), "all", "correct").n_trials;
}

using Labels = std::array<std::optional<Label>, 3>;

const Label L = "lightest", I = "intermediate", H = "heaviest";
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
  const Summary summary = summarized({a, b});
  EXPECT_EQ(share(summary, "all", "correct").n_trials, 10);
  EXPECT_DOUBLE_EQ(*share(summary, "all", "correct").value, 10);
  EXPECT_DOUBLE_EQ(*share(summary, "all", "incorrect").value, 10);
  EXPECT_DOUBLE_EQ(*share(summary, "all", "I don't know").value, 80);
  EXPECT_DOUBLE_EQ(*share(summary, "answered", "correct").value, 50);
  EXPECT_EQ(share(summary, "answered", "correct").n, 1);
  // of conditions that were run
  EXPECT_EQ(estimates_of(summary.estimates, "sorting_chance").size(), 1u);
}

TEST(Sorting, SessionsOfOneParticipantCountTogether) {
  SessionData first = session(1, "a"), again = session(2, "a");
  add_sortings(first, "C2", "correct", 5);
  add_sortings(again, "C2", "incorrect", 5);
  const StudyEstimate correct = share(summarized({first, again}), "all", "correct");
  EXPECT_EQ(correct.n, 1);
  EXPECT_DOUBLE_EQ(*correct.value, 50);
}

TEST(Sorting, OnlyCompletedTrialsCount) {
  SessionData data = session(1, "a");
  add_sorting(data, "C2", "correct");
  add_sorting(data, "C2", "incorrect").trial.status = TrialStatus::voided;
  add_sorting(data, "C2", "incorrect").trial.status = TrialStatus::open;
  EXPECT_EQ(n_trials(data), 1);
}

TEST(Sorting, CountsSwapsOfIncorrectTrials) {
  SessionData data = session(1, "a");
  add_sorting(data, "C2", "incorrect").answers = {label(1, I), label(2, L), label(3, H)};
  add_sorting(data, "C2", "correct").answers = {label(1, L), label(2, I), label(3, H)};
  const Summary summary = summarized({data});
  std::vector<double> swaps;
  for (const StudyEstimate* one : estimates_of(summary.estimates, "sorting_swapped"))
    swaps.push_back(*one->value);
  EXPECT_THAT(swaps, ElementsAre(1, 0, 0, 0));
}

TEST(Sorting, SwapsAreOfThreeCubesOnly) {
  SessionData data = session(1, "a");
  add_sorting(data, "C2", "incorrect").cubes = cubes({15, 100, 250, 800});
  const Summary of_four = summarized({data});
  EXPECT_TRUE(estimates_of(of_four.estimates, "sorting_swapped").empty());
  EXPECT_EQ(readable(of_four).find("Incorrect sortings of three cubes"), std::string::npos);
  add_sorting(data, "C2", "incorrect").answers = {label(1, I), label(2, L), label(3, H)};
  EXPECT_EQ(figure({data}, "sorting_n_incorrect").value, 1) << "of three cubes";
}

TEST(Sorting, ChanceIsOneOfTheOrdersOfAsManyCubes) {
  SessionData data = session(1, "a");
  const auto chance = [&] { return figure({data}, "sorting_chance").value; };
  EXPECT_FALSE(chance().has_value());
  add_sorting(data, "C2", "correct");
  EXPECT_DOUBLE_EQ(*chance(), 100.0 / 6);
  add_sorting(data, "C2", "correct").cubes = cubes({15, 100, 250, 800});
  EXPECT_DOUBLE_EQ(*chance(), (100.0 / 6 + 100.0 / 24) / 2);
  EXPECT_DOUBLE_EQ(chance_percent(2), 50);
  EXPECT_DOUBLE_EQ(chance_percent(5), 100.0 / 120);
}

TEST(Sorting, PublishedFiguresNeedThePublishedMasses) {
  SessionData data = session(1, "a");
  add_sorting(data, "C1", "correct");
  const auto correct = [&] { return share(summarized({data}), "all", "correct"); };
  EXPECT_EQ(correct().published, &published::sorting_coupled.correct);
  EXPECT_TRUE(correct().as_published);
  add_sorting(data, "C1", "correct").cubes = cubes({15, 250, 800});
  EXPECT_EQ(correct().published, nullptr);
  EXPECT_FALSE(correct().as_published);
}

TEST(Sorting, PublishedFiguresNeedThePublishedTechnique) {
  SessionData data = session(1, "a");
  data.published_conditions = {{"mine", published::Condition::decoupled}};
  add_sorting(data, "C2", "correct");  // here a technique of another law
  add_sorting(data, "mine", "correct");
  const auto beside = [&](const char* condition) {
    return figure({data}, "sorting_answers", {{"condition", condition}}).published;
  };
  EXPECT_EQ(beside("C2"), nullptr);
  EXPECT_EQ(beside("mine"), &published::sorting_decoupled.correct);
}

TEST(Sorting, EveryLabelIsCountedWhateverTheNumberOfCubes) {
  SessionData data = session(1, "a");
  Attempt& attempt = add_sorting(data, "C2", "incorrect");
  attempt.cubes = cubes({400, 100});
  attempt.answers = {label(1, "1"), label(2, "2")};
  const Summary summary = summarized({data});
  std::vector<double> counts;  // of the lighter cube, then of the heavier one
  for (const StudyEstimate* one : estimates_of(summary.estimates, "sorting_confusion_count"))
    counts.push_back(*one->value);
  EXPECT_THAT(counts, ElementsAre(0, 1, 1, 0));
}

}  // namespace
}  // namespace heft
