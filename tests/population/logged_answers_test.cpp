// Populations fitted to the single answers of a log.
#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "SourceFolder.h"
#include "base/Error.h"
#include "base/files/TextFile.h"
#include "population/LoggedAnswers.h"
#include "population/ResponderFit.h"
#include "session/Simulation.h"

namespace heft {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

TrialRow trial(const std::string& outcome, std::optional<bool> correct, double level_g) {
  TrialRow row;
  row.status = TrialStatus::completed;
  row.plan.task = "comparison";
  row.plan.block = "b";
  row.plan.condition = "C2";
  row.plan.reference_g = 200;
  row.plan.level_g = level_g;
  row.outcome = outcome;
  row.choice_correct = correct;
  return row;
}

TEST(LoggedAnswers, AreCountedByWhatWasShown) {
  AnswerCounts counts;
  EXPECT_TRUE(add_answer(trial("difference", true, 50), counts));
  EXPECT_TRUE(add_answer(trial("difference", false, 50), counts));
  EXPECT_TRUE(add_answer(trial("no_difference", {}, 50), counts));
  EXPECT_TRUE(add_answer(trial("no_difference", {}, 50), counts));
  EXPECT_TRUE(add_answer(trial("difference", {}, 0), counts));
  ASSERT_EQ(counts.size(), 2u);
  const auto& at_50 = counts.at({"b", "C2", 200.0, 50.0});
  EXPECT_THAT(at_50, UnorderedElementsAre(std::pair(LoggedAnswer{"difference", true}, 1),
                                          std::pair(LoggedAnswer{"difference", false}, 1),
                                          std::pair(LoggedAnswer{"no_difference", {}}, 2)));
  EXPECT_THAT(counts.at({"b", "C2", 200.0, 0.0}),
              UnorderedElementsAre(std::pair(LoggedAnswer{"difference", {}}, 1)));
}

TEST(LoggedAnswers, WhatIsNoAnswerIsLeftOut) {
  AnswerCounts counts;
  TrialRow voided = trial("difference", true, 50), practice = voided, other = voided;
  voided.status = TrialStatus::voided;
  practice.plan.is_practice = true;
  other.plan.task = "estimation";
  for (const TrialRow& row : {voided, practice, other}) EXPECT_FALSE(add_answer(row, counts));
  EXPECT_TRUE(counts.empty());
}

// By hand: 2 of 4 drawn answers and 1 of 4, each with half an answer more, of 4 + 3/2.
TEST(LoggedAnswers, LikelihoodIsOfTheSharesThatWereDrawn) {
  const Stimulus shown{"b", "C2", 200, 50};
  const AnswerCounts logged{
      {shown, {{{"same", {}}, 3}, {{"different", {}}, 1}, {{"never", {}}, 1}}}};
  const AnswerCounts drawn{
      {shown, {{{"same", {}}, 2}, {{"different", {}}, 1}, {{"other", {}}, 1}}}};
  EXPECT_NEAR(log_likelihood(logged, drawn),
              3 * std::log(2.5 / 5.5) + std::log(1.5 / 5.5) + std::log(0.5 / 5.5), 1e-12);
}

class LogFitTest : public ::testing::Test {
 protected:
  LogFitTest() { fs::create_directories(folder_); }
  ~LogFitTest() override { fs::remove_all(folder_); }

  // @param people a model's file; empty: the default's
  static ResolvedConfig config(const Protocol& protocol, const std::string& people = "") {
    SessionOptions given;
    given.responder = Plug{"simulated", people};
    given.tracker = Plug{"surrogate"};
    return resolve(given, protocol, 20261127);
  }
  std::string simulated(const std::string& protocol, int n, const std::string& people = "") {
    const std::string file = folder_ + "/people.toml", db = folder_ + "/log.db";
    replace_text_file(file, people);
    const std::atomic<bool> never = false;
    SimulationRequest request{
        config(load_protocol(source_folder() + "/protocols/" + protocol + ".toml"), file), db, n,
        2};
    simulate(
        request, [](int) {}, never);
    return db;
  }

  std::string folder_ =
      (fs::temp_directory_path() / ("heft-log-fit-test-" + std::to_string(::getpid()))).string();
};

// Every stimulus of the log, and no other one, as often as it is asked for.
TEST_F(LogFitTest, RepeatsTheStimuliOfTheLog) {
  for (const char* protocol : {"paper", "quick", "examples/forced_choice"}) {
    const std::string db = simulated(protocol, 2);
    const LoggedPeople logged = logged_people(LogReader(db), db);
    EXPECT_EQ(logged.people.size(), 2u);
    std::set<Stimulus> shown;
    for (const AnswerCounts& person : logged.people)
      for (const auto& [stimulus, answers] : person) shown.insert(stimulus);
    const ResolvedConfig again = config(repeated_stimuli(logged, 3));
    const std::string repeated = folder_ + "/repeated.db";
    const std::atomic<bool> never = false;
    simulate(
        {again, repeated, 1}, [](int) {}, never);
    std::map<Stimulus, int> n;
    const AnswerCounts answers = logged_people(LogReader(repeated), repeated).people.front();
    for (const auto& [stimulus, by] : answers)
      for (const auto& [answer, count] : by) n[stimulus] += count;
    EXPECT_EQ(n.size(), shown.size()) << protocol;
    for (const auto& [stimulus, count] : n) {
      EXPECT_TRUE(shown.contains(stimulus)) << protocol;
      EXPECT_EQ(count, 3) << protocol;
    }
    fs::remove(db);
    fs::remove(repeated);
  }
}

TEST_F(LogFitTest, FindsTheCriterionOfThePeopleWhoAnswered) {
  const std::string db =
      simulated("jnd", 10, "criterion_mm.median = 12\ncriterion_mm.spread = 0.4\n");
  const LoggedPeople logged = logged_people(LogReader(db), db);
  const std::atomic<bool> stop = false;
  const Bank bank = *Bank::simulate(
      {config(repeated_stimuli(logged, 12)),
       {{"criterion_mm", 2, 40}, {"criterion_mm.spread", 0.1, 1}},
       {},
       150,
       2,
       logged.people},
      [](double) {}, stop);
  const ResponderFit fit = fit_responder_to_answers(bank);
  EXPECT_NEAR(std::log(fit.parameters[0].value / 12), 0, 0.35);
  ASSERT_TRUE(fit.parameters[0].identified());
  EXPECT_LT(*fit.parameters[0].low, 12);
  EXPECT_GT(*fit.parameters[0].high, 12);
  EXPECT_LT(fit.fitted, 0);
  EXPECT_GT(fit.fitted / logged.n_trials, -std::log(3.0)) << "better than chance";
}

TEST_F(LogFitTest, TwoProtocolsInALogAreRefused) {
  const std::string db = simulated("quick", 1);
  simulated("jnd", 1);
  try {
    logged_people(LogReader(db), db);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("expected one protocol"));
  }
}

TEST_F(LogFitTest, ALogWithoutSuchAnswersIsRefused) {
  const std::string db = simulated("examples/estimation", 1);
  EXPECT_THROW(logged_people(LogReader(db), db), Error);
}

}  // namespace
}  // namespace heft
