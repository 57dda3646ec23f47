// The simulator `auto` in a session: resolved once, before the first trial, and kept in the log.
#include <gmock/gmock.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>

#include "apparatus/SessionSetup.h"
#include "physics/auto/Choice.h"
#include "replay/Replay.h"
#include "session/Session.h"

namespace heft {
namespace {

using ::testing::HasSubstr;

class AutoSimulator : public ::testing::Test {
 protected:
  void SetUp() override {
    request.protocol = load_protocol(std::string(HEFT_SOURCE_DIR) + "/protocols/quick.toml");
    request.setup.simulator = "auto";
    request.participant = "1";
    request.seed = 3;
    request.db = (std::filesystem::temp_directory_path() /
                  ("heft-auto-" + std::to_string(::getpid()) + ".db"))
                     .string();
  }
  void TearDown() override {
    for (const char* end : {"", "-wal", "-shm", "-lock"}) std::filesystem::remove(request.db + end);
  }

  SessionResult run_until(int n_trials) {
    std::atomic<bool> stop = false;
    RunnerOptions runner;
    runner.stop = &stop;
    runner.progress = [&](const Engine& engine) { stop = engine.n_completed() >= n_trials; };
    request.setup = in_force(request.setup, request.protocol);
    return start_session(request, runner);
  }
  LoggedSession logged() const { return load_session(LogReader(request.db), request.db, 1); }
  std::string divergence() const {
    const Verification found = verify_session(LogReader(request.db), 1, [](double) {});
    return found.n_frames == 0 ? "no frames" : found.first ? found.first->what : "";
  }

  SessionRequest request;
};

TEST_F(AutoSimulator, is_one_that_models_everything_at_its_own_rate) {
  const SimulatorPick pick = resolve_auto(request.protocol);
  EXPECT_TRUE(simulator_named(pick.simulator).for_sessions);
  EXPECT_NE(pick.simulator, "auto");
  request.protocol.simulator.rate_hz = 17;
  EXPECT_EQ(resolve_auto(request.protocol).rate_hz, pick.rate_hz);
  request.protocol.display_rate_hz = 1000;
  EXPECT_GE(resolve_auto(request.protocol).rate_hz, 1000);
}

TEST_F(AutoSimulator, takes_shorter_steps_where_the_protocols_spring_is_faster) {
  const double usual_hz = resolve_auto(request.protocol).rate_hz;
  request.protocol.coupling.stiffness_n_per_m *= 16;
  EXPECT_GT(resolve_auto(request.protocol).rate_hz, usual_hz);
}

TEST_F(AutoSimulator, is_logged_with_its_reason_and_replayed) {
  EXPECT_EQ(run_until(100).end, RunEnd::finished);
  const SimulatorPick pick = resolve_auto(request.protocol);
  const LoggedSession session = logged();
  EXPECT_EQ(session.setup.simulator, pick.simulator);
  EXPECT_EQ(session.setup.rate_hz, pick.rate_hz);
  EXPECT_THAT(session.setup.simulator_why, HasSubstr("models everything"));
  EXPECT_EQ(session.protocol->simulator.name, pick.simulator);
  EXPECT_EQ(session.protocol->simulator.rate_hz, pick.rate_hz);
  EXPECT_EQ(divergence(), "");
}

TEST_F(AutoSimulator, stays_as_the_log_says_when_the_session_goes_on_and_the_table_says_another) {
  request.setup.simulator = "bullet-lx";  // as if the table had picked it at the start
  request.setup.rate_hz = 120;
  request.setup.simulator_why = "was the best then";
  ASSERT_EQ(run_until(2).end, RunEnd::stopped);
  LoggedSession session = session_to_resume(request.db, std::nullopt);
  GivenOptions again;
  again.simulator = "auto";  // what it was started with may be said again
  change_setup(session, again);
  EXPECT_EQ(session.protocol->simulator.name, "bullet-lx");
  EXPECT_EQ(session.protocol->simulator.rate_hz, 120);
  EXPECT_EQ(session.setup, session.setups.back().setup);
  EXPECT_EQ(resume_session(session, {}).end, RunEnd::finished);
  EXPECT_EQ(logged().setup.simulator_why, "was the best then");
  EXPECT_EQ(logged().setups.size(), 1U);
  EXPECT_EQ(divergence(), "");
}

TEST_F(AutoSimulator, gives_way_to_one_that_is_named_when_the_session_goes_on) {
  ASSERT_EQ(run_until(2).end, RunEnd::stopped);
  LoggedSession session = session_to_resume(request.db, std::nullopt);
  GivenOptions again;
  again.simulator = "bullet-ea";
  change_setup(session, again);
  EXPECT_EQ(session.setup.simulator, "bullet-ea");
  EXPECT_EQ(session.setup.simulator_why, "");
  EXPECT_EQ(session.protocol->simulator.name, "bullet-ea");
  EXPECT_EQ(resume_session(session, {}).end, RunEnd::finished);
  EXPECT_EQ(logged().setups.size(), 2U);
  EXPECT_EQ(divergence(), "");
}

TEST_F(AutoSimulator, may_be_asked_for_in_the_protocol) {
  request.setup.simulator.clear();
  request.protocol.simulator.name = "auto";
  const SessionConfig resolved = in_force(request.setup, request.protocol);
  EXPECT_EQ(protocol_for(request.protocol, resolved)->simulator.name,
            resolve_auto(request.protocol).simulator);
}

TEST_F(AutoSimulator, leaves_no_trace_where_nobody_asked_for_it) {
  request.setup.simulator = "bullet";
  const SessionConfig resolved = in_force(request.setup, request.protocol);
  EXPECT_EQ(resolved.simulator_why, "");
  EXPECT_EQ(resolved.rate_hz, request.protocol.simulator.rate_hz);
  EXPECT_EQ(protocol_for(request.protocol, resolved)->simulator.name, "bullet");
}

}  // namespace
}  // namespace heft
