// Recordings played back, and broken recordings refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "FakeTrial.h"
#include "responders/Recording.h"

namespace heft {
namespace {
using testing::HasSubstr;

class ScriptedTest : public testing::Test {
 protected:
  ScriptedTest() {
    folder_ = std::filesystem::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~ScriptedTest() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  std::unique_ptr<Responder> make() {
    return responder_named("scripted").make({1, {}, folder_.string()});
  }
  std::string refusal() {
    try {
      make();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  std::string at(const std::string& place) { return (folder_ / place).string(); }

  std::filesystem::path folder_;
  const std::string still_ =
      "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,-0.2,0.03,1,0,0,0\n4,0.1,-0.2,0.03,1,0,0,0\n";
  const std::string header_ = "trial_number,t_s,action,slot,label\n";
};

TEST_F(ScriptedTest, PlaysBackWhatAnotherResponderDid) {
  const auto original = fake::make("simulated", 21);
  fake::TrialSetup setup;
  setup.trial_number = 7;
  const auto wanted = fake::run_trial(*original, setup);
  std::string trajectory = "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n", actions = header_;
  for (std::size_t i = 0; i < wanted.hand.size(); ++i) {
    const auto& [p, q] = wanted.hand[i];
    trajectory += fmt::format("{},{},{},{},{},{},{},{}\n", static_cast<double>(i) / 15, p.x(),
                              p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
  }
  for (const TimedAction& action : wanted.actions)
    actions += fmt::format("7,{},{},{},{}\n", action.t_s, name_of(action.kind),
                           action.slot ? std::to_string(*action.slot) : "",
                           action.label ? name_of(*action.label) : "");
  write("trial_7.csv", trajectory);
  write("actions.csv", actions);

  const auto result = fake::run_trial(*make(), setup);
  EXPECT_TRUE(result.ended);
  EXPECT_EQ(result.correct, wanted.correct);
  EXPECT_EQ(fake::said(result), fake::said(wanted));
  ASSERT_EQ(result.actions.size(), wanted.actions.size());
  for (std::size_t i = 0; i < result.actions.size(); ++i)
    EXPECT_EQ(result.actions[i].t_s, wanted.actions[i].t_s);
  ASSERT_EQ(result.hand.size(), wanted.hand.size());
  for (std::size_t i = 0; i < result.hand.size(); ++i)
    EXPECT_LT((result.hand[i].position_m - wanted.hand[i].position_m).norm(), 1e-12);
  EXPECT_EQ(result.n_pushes, wanted.n_pushes);
}

TEST_F(ScriptedTest, EndsWithItsLastActionAndPose) {
  write("trial_1.csv", still_);
  write("actions.csv", header_);
  fake::TrialSetup setup;
  const auto result = fake::run_trial(*make(), setup);
  EXPECT_FALSE(result.ended);
  EXPECT_NEAR(result.end_s, 4, 1 / 15.0 + 1e-9);

  write("actions.csv", header_ + "1,6,dont_know,,\n");
  const auto later = fake::run_trial(*make(), setup);
  EXPECT_TRUE(later.ended);
  EXPECT_EQ(later.actions.at(0).t_s, 6);
}

TEST_F(ScriptedTest, WaitsWithValidateUntilItIsOfferedButNotForever) {
  write("trial_1.csv", still_);
  write("actions.csv", header_ +
                           "1,1,label,1,heaviest\n1,2,label,2,lightest\n"
                           "1,3,label,3,intermediate\n1,3.01,validate,,\n");
  const auto result = fake::run_trial(*make(), {});
  EXPECT_TRUE(result.ended);
  EXPECT_GT(result.actions.back().t_s, 3.01);
  EXPECT_LT(result.actions.back().t_s, 3.2);

  write("actions.csv", header_ + "1,1,label,1,heaviest\n1,3,validate,,\n");
  const auto stuck = fake::run_trial(*make(), {});
  EXPECT_FALSE(stuck.ended);
  EXPECT_EQ(stuck.actions.size(), 1u);
  EXPECT_LT(stuck.end_s, 5.2);
}

TEST_F(ScriptedTest, TapsAfterAPauseWhatFellIntoIt) {
  write("trial_1.csv", still_);
  write("actions.csv", header_ + "1,2,dont_know,,\n");
  fake::TrialSetup setup;
  setup.paused_from_s = 1;
  setup.paused_to_s = 6;
  const auto result = fake::run_trial(*make(), setup);
  EXPECT_TRUE(result.ended);
  EXPECT_EQ(result.not_allowed, std::vector<std::string>{});
  EXPECT_NEAR(result.actions.at(0).t_s, 6, 1e-9);
}

TEST_F(ScriptedTest, SaysWhereTheEffectorIsOutOfView) {
  write("trial_1.csv", still_ + "5,,,,,,,\n6,0,0,0,1,0,0,0\n");
  write("actions.csv", header_);
  const auto responder = make();
  responder->begin_trial({1, 1, "sorting", fake::row_of(3)});
  EXPECT_TRUE(responder->hand(3).in_view);
  EXPECT_FALSE(responder->hand(5.5).in_view);
  EXPECT_TRUE(responder->hand(6).in_view);
}

TEST_F(ScriptedTest, EveryBadCellIsReportedAtItsPlace) {
  write("trial_1.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,zero,0,0,1,0,0,0\n");
  write("actions.csv", header_ +
                           "0,1,select,1,\n"
                           "1,soon,select,1,\n"
                           "1,1,selec,1,\n"
                           "1,1,select,left,\n"
                           "1,1,label,1,heavy\n"
                           "1,1,validate,2,\n"
                           "1,1,select,1,heaviest\n"
                           "1,1,select\n"
                           "1,3,select,1,\n"
                           "1,2,select,2,\n"
                           "4,2,select,2,\n");
  const std::string text = refusal();
  for (const char* wanted :
       {"actions.csv:2:1: trial_number is \"0\": expected a whole number from 1",
        "actions.csv:3:3: t_s is \"soon\": expected seconds",
        "actions.csv:4:5: action is \"selec\": did you mean \"select\"?",
        "actions.csv:5:12: slot is \"left\": expected a whole number from 1",
        "actions.csv:6:13: label is \"heavy\": ",
        "actions.csv:7:14: slot is \"2\": validate takes no slot",
        "actions.csv:8:14: label is \"heaviest\": select takes no label",
        "actions.csv:9:1: 3 cells, expected 5",
        "actions.csv:11:3: t_s is \"2\": comes before trial 1's action at 3 s in line 10",
        "trial_1.csv:2:3: x_m is \"zero\""})
    EXPECT_THAT(text, HasSubstr(at(wanted)));
}

TEST_F(ScriptedTest, ActionsWithoutATrajectoryAreAMistake) {
  write("trial_1.csv", still_);
  write("actions.csv", header_ + "4,2,select,2,\n");
  EXPECT_THAT(refusal(), HasSubstr("there is no trial_4.csv"));
}

TEST_F(ScriptedTest, AMissingTrialActionFileOrFolderIsNamed) {
  EXPECT_THAT(refusal(), HasSubstr(at("actions.csv")));
  write("actions.csv", header_);
  write("trial_1.csv", still_);
  const auto responder = make();
  try {
    responder->begin_trial({2, 1, "sorting", fake::row_of(3)});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("lacks trial 2: expected the file trial_2.csv"));
  }
  std::filesystem::remove_all(folder_);
  EXPECT_THAT(refusal(), HasSubstr("cannot read the recording " + folder_.string()));
}

TEST_F(ScriptedTest, ActionsThatTheTaskDoesNotOfferAreRefusedAtTheirLine) {
  write("trial_1.csv", still_);
  write("actions.csv", header_ + "1,1,validate,,\n1,2,select,3,\n");
  const auto responder = make();
  try {
    responder->begin_trial({1, 1, "comparison", fake::row_of(2)});
    FAIL();
  } catch (const InvalidFile& invalid) {
    EXPECT_THAT(invalid.what(), HasSubstr("actions.csv:2:5: a comparison trial has no action"));
    EXPECT_THAT(invalid.what(), HasSubstr("actions.csv:3:5: slot 3, but trial 1 has 2 cubes"));
  }
}

}  // namespace
}  // namespace heft
