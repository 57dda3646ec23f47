// Screens when no trial is due, and tasks that are not listed.
#include <gmock/gmock.h>

#include "engine/Engine.h"
#include "tasks/Introduction.h"

namespace heft {
namespace {

// A library user's task: one tap per trial.
struct Tapping {
  static constexpr std::array actions{ActionSpec{.kind = "tap"}};
  static constexpr std::array<std::string_view, 1> outcomes{"tapped"};
  static constexpr TaskDeclaration task{
      .name = "tapping", .about = "One tap a trial", .actions = actions, .outcomes = outcomes};
  struct Block {
    using OfTask = Tapping;
    std::string name;
    int n_trials = 2;
    int most_cubes() const { return 1; }
  };
  struct Run : TaskRun {
    Run(const Block& its, std::uint64_t) : block(its) {}
    TrialPlan plan(const TrialKey& key) const override {
      TrialPlan plan = key.plan(block.name, task.name, "C2");
      plan.masses_g = {100};
      return plan;
    }
    bool finished() const override { return n >= block.n_trials; }
    void complete(const TrialRow&, Changes&) override { ++n; }
    Block block;
    int n = 0;
  };
  struct Trial : TaskTrial {
    Trial(const Block&, const TrialPlan& plan, std::uint64_t) : TaskTrial(task, plan) {}
    void take(const Action&) override { result_.outcome = "tapped"; }
    void show(ScreenState&) const override {}
    std::string answer() const override { return "tapped"; }
  };
};

struct Tapped {
  Changes tell(EventPayload what) { return engine.apply({++t_s, std::move(what)}); }
  Engine engine;
  double t_s = 0;
};

TEST(OwnTask, RunsWithoutBeingListed) {
  SessionPlan plan;
  plan.blocks = {Tapping::Block{"taps", 2}};
  Tapped session{Engine(std::make_shared<const SessionPlan>(plan), 7)};
  for (int n = 0; n < 2; ++n) {
    session.tell(TrialStarted{});
    session.tell(CubesShown{});
    EXPECT_THAT(session.engine.admit({session.t_s, Action{"select", 1}}).refusal,
                ::testing::HasSubstr("a tapping trial has no action \"select\""));
    EXPECT_EQ(session.tell(Action{"tap"}).trial->outcome, "tapped");
  }
  EXPECT_EQ(session.engine.next().kind, Next::Kind::finish);
}

TEST(LastPage, IsThanksAfterLastBlockAndAfterEnd) {
  SessionPlan plan;
  plan.blocks = {Tapping::Block{"taps", 1}};
  Tapped session{Engine(std::make_shared<const SessionPlan>(plan), 7)};
  EXPECT_EQ(session.engine.screen().screen, Screen::trial);
  session.tell(TrialStarted{});
  session.tell(CubesShown{});
  session.tell(Action{"tap"});
  EXPECT_EQ(session.engine.screen().screen, Screen::thanks) << "before it is told that it ended";
  session.tell(SessionEnded{});
  EXPECT_EQ(session.engine.screen().screen, Screen::thanks);

  Tapped aborted{Engine(std::make_shared<const SessionPlan>(plan), 7)};
  aborted.tell(SessionEnded{Ending::aborted});
  EXPECT_EQ(aborted.engine.next().kind, Next::Kind::over);
  EXPECT_EQ(aborted.engine.screen().screen, Screen::thanks);
}

}  // namespace
}  // namespace heft
