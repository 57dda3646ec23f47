// A recording's answer to a trial, without its hand.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "responders/Responder.h"
#include "tasks/Offers.h"

namespace heft {
namespace {
using ::testing::ElementsAre;

class RecordedJudge : public testing::Test {
 protected:
  RecordedJudge() {
    folder_ = std::filesystem::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
    write("trial_1.csv",
          "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,-0.2,0.03,1,0,0,0\n4,0.1,-0.2,0.03,1,0,0,0\n");
    trial_.task = "sorting";
    trial_.trial_number = 1;
    trial_.stage.slots_m.resize(3);
  }
  ~RecordedJudge() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  std::optional<Answer> answer(const std::string& actions) {
    write("actions.csv", "trial_number,t_s,action,slot,label\n" + actions);
    return responder_named("scripted").make({1, {}, folder_.string()})->judge(trial_, {});
  }

  std::filesystem::path folder_;
  TrialView trial_;
};

TEST_F(RecordedJudge, LabelsThatWereMovedCountWhereTheyEnd) {
  const auto found = answer(
      "1,1,label,1,heaviest\n1,1.5,label,2,heaviest\n1,2,label,1,lightest\n"
      "1,2.5,label,3,intermediate\n1,3,validate,,\n");
  ASSERT_TRUE(found);
  TrialPlan plan;
  plan.masses_g = {1, 2, 3};
  Sorting::Trial folded({}, plan, 0);
  for (const Action& action : found->actions) folded.take(action);
  EXPECT_THAT(folded.labels(), ElementsAre("lightest", "heaviest", "intermediate"));
}

TEST_F(RecordedJudge, NotKnowingIsAnAnswerAndAnOpenTrialIsNone) {
  const auto unknown = answer("1,1,label,1,heaviest\n1,2,dont_know,,\n");
  ASSERT_TRUE(unknown);
  EXPECT_EQ(unknown->actions.back().kind, "dont_know");
  EXPECT_FALSE(answer("1,1,label,1,heaviest\n"));
  trial_.trial_number = 2;
  EXPECT_FALSE(answer("1,2,dont_know,,\n"));
}

TEST_F(RecordedJudge, AComparisonsChoiceIsItsSlot) {
  trial_.task = "comparison";
  trial_.stage.slots_m.resize(2);
  const auto chosen = answer("1,1,select,2,\n");
  ASSERT_TRUE(chosen);
  EXPECT_EQ(chosen_slot(*chosen), 2);
}

}  // namespace
}  // namespace heft
