// Scores of models against closed forms, and against the truth of simulated answers.
#include <gmock/gmock.h>

#include <cmath>

#include "base/Random.h"
#include "replay/AnswerScores.h"

namespace heft {
namespace {
using ::testing::ElementsAre;
using ::testing::Pair;
using Answers = std::map<std::string, int>;

AnswerDraws draws_of(const Answers& n_by_answer) {
  AnswerDraws draws;
  for (const auto& [answer, n] : n_by_answer)
    for (int i = 0; i < n; ++i) draws.add(answer, {});
  return draws;
}

JudgedTrial comparison(const std::string& person, double level_g, const std::string& answer,
                       const std::vector<Answers>& models) {
  JudgedTrial trial;
  trial.person = person;
  trial.task = "comparison";
  trial.condition = "C2";
  trial.reference_g = 200;
  trial.level_g = level_g;
  trial.has_difference = level_g != 0;
  trial.n_answers = 3;
  trial.detects = true;
  trial.answer = answer;
  for (const Answers& model : models) trial.models.push_back(draws_of(model));
  return trial;
}

TEST(AnswerScores, AreClosedFormsOfTheDraws) {
  const JudgedTrial trial = comparison("1", 50, "none", {{{"comparison", 7}, {"none", 3}}});
  EXPECT_DOUBLE_EQ(log_score(trial, 0), std::log(3.5 / 11.5));
  EXPECT_DOUBLE_EQ(log_score_of_own(trial, 0),
                   (7 * std::log(6.5 / 10.5) + 3 * std::log(2.5 / 10.5)) / 10);
  EXPECT_DOUBLE_EQ(agreement(trial, 0), 0.3);
  EXPECT_DOUBLE_EQ(agreement_with_own(trial, 0), (7.0 * 6 + 3 * 2) / (10 * 9));
  EXPECT_DOUBLE_EQ(probability_of(trial.models[0], "reference", 3), 0.5 / 11.5);
}

TEST(AnswerScores, OfAModelsOwnAnswersAreThoseThatItExpects) {
  RandomStream stream(20261127, "own answers");
  const auto draw = [&](double p_none) {
    return stream.coin(p_none) ? "none" : stream.coin(0.8) ? "comparison" : "reference";
  };
  const int n = 20000;
  double sum = 0, sum_squared = 0, sum_agreement = 0;
  for (int i = 0; i < n; ++i) {
    const double p_none = stream.uniform();
    Answers drawn;
    for (int k = 0; k < 60; ++k) ++drawn[draw(p_none)];
    const JudgedTrial trial = comparison("1", 50, draw(p_none), {drawn});
    const double beyond = log_score(trial, 0) - log_score_of_own(trial, 0);
    sum += beyond;
    sum_squared += beyond * beyond;
    sum_agreement += agreement(trial, 0) - agreement_with_own(trial, 0);
  }
  EXPECT_NEAR(sum / n, 0, 3 * std::sqrt(sum_squared) / n);
  EXPECT_NEAR(sum_agreement / n, 0, 0.01);
}

TEST(AnswerScores, CountEachPersonOnce) {
  const Answers sure{{"none", 10}};
  std::vector<JudgedTrial> trials{comparison("1", 50, "none", {sure})};
  for (int i = 0; i < 3; ++i) trials.push_back(comparison("2", 50, "comparison", {sure}));
  const GroupScores all = scores_of(trials, 1, ScoreGroups::all).front();
  EXPECT_EQ(all.n_trials, 4);
  EXPECT_EQ(all.n_people, 2);
  const std::vector<double> people{std::log(10.5 / 11.5), std::log(0.5 / 11.5)};
  EXPECT_DOUBLE_EQ(all.models[0].log_score.value, *mean(people));
  EXPECT_DOUBLE_EQ(all.models[0].log_score.interval->low, student_t_interval(people)->low);
  EXPECT_DOUBLE_EQ(all.models[0].agreement.value, 0.5);
  EXPECT_DOUBLE_EQ(all.chance.value, -std::log(3.0));
  trials.resize(1);
  EXPECT_FALSE(scores_of(trials, 1, ScoreGroups::all).front().models[0].log_score.interval);
}

TEST(AnswerScores, ComparesModelsByPerson) {
  const Answers none{{"none", 10}}, half{{"none", 5}, {"comparison", 5}};
  const std::vector<JudgedTrial> trials{comparison("1", 50, "none", {half, none}),
                                        comparison("2", 50, "none", {half, none}),
                                        comparison("3", 50, "comparison", {half, none})};
  const GroupScores all = scores_of(trials, 2, ScoreGroups::all).front();
  const double gain = std::log(10.5 / 5.5), loss = std::log(0.5 / 5.5);
  EXPECT_DOUBLE_EQ(all.models[1].difference.value, (2 * gain + loss) / 3);
  EXPECT_EQ(all.models[1].n_people_better, 2);
  EXPECT_EQ(all.models[0].difference.value, 0);
  EXPECT_EQ(all.models[0].n_people_better, 0);
  EXPECT_THAT(all.models[0].answers,
              ElementsAre(Pair(Pair("comparison", "comparison"), 0.5),
                          Pair(Pair("comparison", "none"), 0.5),
                          Pair(Pair("none", "comparison"), 1), Pair(Pair("none", "none"), 1)));
}

TEST(AnswerScores, FromFramesIsZeroForAModelThatGivesEachTrialTheSame) {
  const Answers same{{"none", 7}, {"comparison", 3}};
  std::vector<JudgedTrial> trials;
  for (const char* person : {"1", "2"})
    for (const char* answer : {"none", "comparison", "reference"})
      trials.push_back(comparison(person, 50, answer, {same}));
  const GroupScores all = scores_of(trials, 1, ScoreGroups::all).front();
  EXPECT_NEAR(all.models[0].from_frames->value, 0, 1e-12);
  EXPECT_LT(all.models[0].log_score.value, all.chance.value) << "for it is sure, without reason";
}

TEST(AnswerScores, FromFramesComparesTheAnswersOfOnePersonAndReference) {
  const Answers none{{"none", 10}}, any{{"none", 5}, {"comparison", 5}};
  std::vector<JudgedTrial> trials{
      comparison("1", 50, "none", {none}), comparison("1", 90, "comparison", {any}),
      comparison("1", 90, "comparison", {any}), comparison("2", 50, "comparison", {none})};
  trials.push_back(comparison("1", 50, "reference", {none}));
  trials.back().reference_g = 15;
  const GroupScores all = scores_of(trials, 1, ScoreGroups::all).front();
  EXPECT_NEAR(all.models[0].from_frames->value, (std::log(10.5) - std::log(0.5)) / 3, 1e-12);
  EXPECT_FALSE(all.models[0].from_frames->interval) << "the other person has one trial";
  trials.erase(trials.begin(), trials.begin() + 3);
  EXPECT_FALSE(scores_of(trials, 1, ScoreGroups::all).front().models[0].from_frames);
}

// The other trials' answers, with half a count each: of 3 "none" beside this one's, 1 "comparison".
TEST(AnswerScores, SharesLeaveTheTrialOut) {
  const Answers any{{"none", 2}};
  std::vector<JudgedTrial> trials;
  for (const char* answer : {"none", "none", "none", "none", "comparison"})
    trials.push_back(comparison("1", 50, answer, {any}));
  const GroupScores all = scores_of(trials, 1, ScoreGroups::all).front();
  EXPECT_DOUBLE_EQ(all.shares.value, (4 * std::log(3.5 / 5.5) + std::log(0.5 / 5.5)) / 5);
}

// Four people; d' and jackknife computed by hand from their hits and false alarms.
TEST(AnswerScores, SensitivityHasTheJackknifesIntervalOverPeople) {
  const std::vector<std::pair<int, int>> hits_and_alarms{{9, 1}, {8, 3}, {10, 2}, {6, 4}};
  std::vector<JudgedTrial> trials;
  for (std::size_t person = 0; person < 4; ++person)
    for (int i = 0; i < 20; ++i) {
      const auto [hits, alarms] = hits_and_alarms[person];
      const bool yes = i < 10 ? i < hits : i - 10 < alarms;
      trials.push_back(comparison(std::to_string(person), i < 10 ? 50 : 0,
                                  yes ? "comparison" : "none",
                                  {{{yes ? "comparison" : "none", 4}}}));
    }
  const GroupScores all = scores_of(trials, 1, ScoreGroups::all).front();
  const auto d_prime = [](double hits, double alarms, double n) {
    return normal_quantile((hits + 0.5) / (n + 1)) - normal_quantile((alarms + 0.5) / (n + 1));
  };
  EXPECT_DOUBLE_EQ(all.person->d_prime, d_prime(33, 10, 40));
  std::vector<double> without;
  for (const auto& [hits, alarms] : hits_and_alarms)
    without.push_back(d_prime(33 - hits, 10 - alarms, 30));
  double sum_squared = 0;
  for (const double one : without) sum_squared += std::pow(one - *mean(without), 2);
  const double reach = 3.182446305 * std::sqrt(0.75 * sum_squared);
  EXPECT_NEAR(all.person->d_prime_interval->high - all.person->d_prime, reach, 1e-8);
  EXPECT_NEAR(all.person->d_prime - all.person->d_prime_interval->low, reach, 1e-8);
  const auto z = [](double n) { return normal_quantile((n + 0.5) / 161); };
  EXPECT_DOUBLE_EQ(all.models[0].detection->d_prime, z(4 * 33) - z(4 * 10))
      << "a model that answers the same in each of 4 draws";
}

TEST(AnswerScores, SensitivityOfTwoPeopleHasAnInterval) {
  std::vector<JudgedTrial> trials;
  for (const char* person : {"1", "2"})
    for (const double level_g : {0, 50})
      trials.push_back(comparison(person, level_g, "none", {{{"none", 2}}}));
  EXPECT_TRUE(scores_of(trials, 1, ScoreGroups::all).front().person->d_prime_interval);
  trials.resize(2);
  EXPECT_FALSE(scores_of(trials, 1, ScoreGroups::all).front().person->d_prime_interval);
}

// One catch trial among 40: with the rates of trials, (0.1 + 1/2) / 2 would be its false alarms.
TEST(AnswerScores, AModelThatDoesNotLookHasNoSensitivity) {
  std::vector<JudgedTrial> trials;
  for (int i = 0; i < 40; ++i)
    trials.push_back(comparison(std::to_string(i % 4), i == 0 ? 0 : 50, "none",
                                {{{"none", 9000}, {"comparison", 1000}}}));
  const GroupScores all = scores_of(trials, 1, ScoreGroups::all).front();
  EXPECT_NEAR(all.models[0].detection->d_prime, 0, 0.001);
  EXPECT_NEAR(all.models[0].detection->criterion, -normal_quantile(0.1), 0.001);
}

TEST(AnswerScores, LevelsAreComparedWithTheCatchTrialsOfTheirReference) {
  const Answers any{{"none", 2}};
  std::vector<JudgedTrial> trials{
      comparison("1", 0, "none", {any}), comparison("1", 0, "comparison", {any}),
      comparison("1", 50, "comparison", {any}), comparison("1", 90, "none", {any})};
  trials.push_back(comparison("1", 0, "comparison", {any}));
  trials.back().reference_g = 15;
  const auto levels = scores_of(trials, 1, ScoreGroups::levels);
  ASSERT_EQ(levels.size(), 4u);
  EXPECT_EQ(levels[2].level_g, 50);
  EXPECT_EQ(levels[2].n_trials, 1);
  EXPECT_DOUBLE_EQ(levels[2].person->d_prime, detection({1, 1, 2, 1})->d_prime);
  EXPECT_DOUBLE_EQ(levels[3].person->d_prime, detection({1, 0, 2, 1})->d_prime);
  EXPECT_FALSE(levels[1].person) << "trials without difference alone";
  EXPECT_EQ(scores_of(trials, 1, ScoreGroups::references).size(), 2u);
}

TEST(AnswerScores, LabelsAreCountedByCube) {
  JudgedTrial trial = comparison("1", 50, "heaviest lightest", {});
  trial.task = "sorting";
  trial.labels = {"heaviest", "lightest"};
  trial.models.emplace_back();
  trial.models[0].add("heaviest lightest", {"heaviest", "lightest"});
  trial.models[0].add("none none", {"none", "none"});
  const GroupScores all = scores_of({trial}, 1, ScoreGroups::all).front();
  EXPECT_FALSE(all.person) << "sorting does not state whether the cubes differ";
  EXPECT_TRUE(all.models[0].answers.empty());
  EXPECT_EQ((all.models[0].labels.at({"heaviest", "none"})), 0.5);
  EXPECT_EQ((all.models[0].labels.at({"lightest", "lightest"})), 0.5);
}

}  // namespace
}  // namespace heft
