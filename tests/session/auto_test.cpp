// The simulator `auto` in a session: resolved once, before the first trial, and kept in the log.
#include <gmock/gmock.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>

#include "SourceFolder.h"
#include "apparatus/configuration/ResolvedConfig.h"
#include "physics/auto/Choice.h"
#include "replay/Replay.h"
#include "session/Session.h"

namespace heft {
namespace {

using ::testing::HasSubstr;

class AutoSimulator : public ::testing::Test {
 protected:
  void SetUp() override {
    options.responder = Plug{"simulated"};
    options.simulator = "auto";
  }
  void TearDown() override {
    for (const char* end : {"", "-wal", "-shm", "-lock"}) std::filesystem::remove(db + end);
  }

  SessionResult run_until(int n_trials) { return run_until(n_trials, resolved()); }
  SessionResult run_until(int n_trials, const ResolvedConfig& config) {
    std::atomic<bool> stop = false;
    RunnerOptions runner;
    runner.stop = &stop;
    runner.progress = [&](const Engine& engine) { stop = engine.n_completed() >= n_trials; };
    return start_session({config, "1", db}, runner);
  }
  LoggedSession logged() const { return load_session(LogReader(db), db, 1); }
  std::string divergence() const {
    const Verification found = verify_session(LogReader(db), 1, [](double) {});
    return found.n_frames == 0 ? "no frames" : found.first ? found.first->what : "";
  }

  ResolvedConfig resolved() const { return resolve(options, protocol, 3); }
  // Resumed with another simulator.
  static ResolvedConfig resumed(const LoggedSession& session, const std::string& simulator) {
    SessionOptions again;
    again.simulator = simulator;
    return resolve(again, session.setup, *session.protocol, session.row.header.seed);
  }

  Protocol protocol = load_protocol(source_folder() + "/protocols/quick.toml");
  SessionOptions options;
  const std::string db =
      (std::filesystem::temp_directory_path() / ("heft-auto-" + std::to_string(::getpid()) + ".db"))
          .string();
};

TEST_F(AutoSimulator, IsOneThatModelsEverythingAtItsOwnRate) {
  const SimulatorPick pick = resolve_auto(protocol);
  EXPECT_TRUE(simulator_named(pick.simulator).for_sessions);
  EXPECT_NE(pick.simulator, "auto");
  protocol.simulator.rate_hz = 17;
  EXPECT_EQ(resolve_auto(protocol).rate_hz, pick.rate_hz);
  protocol.display_rate_hz = 1000;
  EXPECT_GE(resolve_auto(protocol).rate_hz, 1000);
}

TEST_F(AutoSimulator, TakesShorterStepsWhereTheProtocolsSpringIsFaster) {
  const double usual_hz = resolve_auto(protocol).rate_hz;
  protocol.coupling.stiffness_n_per_m *= 16;
  EXPECT_GT(resolve_auto(protocol).rate_hz, usual_hz);
}

TEST_F(AutoSimulator, IsLoggedWithItsReasonAndReplayed) {
  EXPECT_EQ(run_until(100).end, RunEnd::finished);
  const SimulatorPick pick = resolve_auto(protocol);
  const LoggedSession session = logged();
  EXPECT_EQ(session.setup.simulator, pick.simulator);
  EXPECT_EQ(session.setup.rate_hz, pick.rate_hz);
  EXPECT_THAT(session.setup.simulator_reason, HasSubstr("models everything"));
  EXPECT_EQ(session.protocol->simulator.name, pick.simulator);
  EXPECT_EQ(session.protocol->simulator.rate_hz, pick.rate_hz);
  EXPECT_EQ(divergence(), "");
}

TEST_F(AutoSimulator, StaysAsTheLogSaysWhenTheSessionContinuesAndTheTableSaysAnother) {
  SessionConfig earlier = resolved()->config;
  earlier.simulator = "bullet-lx";  // as if the table had picked it at the start
  earlier.rate_hz = 120;
  earlier.simulator_reason = "was the best then";
  ASSERT_EQ(run_until(2, resolve({}, earlier, protocol, 3)).end, RunEnd::stopped);
  const LoggedSession session = session_to_resume(db, std::nullopt);
  // Repeating the option of the start is allowed.
  const ResolvedConfig config = resumed(session, "auto");
  EXPECT_EQ(config->protocol->simulator.name, "bullet-lx");
  EXPECT_EQ(config->protocol->simulator.rate_hz, 120);
  EXPECT_EQ(config->config, session.setups.back().setup);
  EXPECT_EQ(resume_session(session, config, {}).end, RunEnd::finished);
  EXPECT_EQ(logged().setup.simulator_reason, "was the best then");
  EXPECT_EQ(logged().setups.size(), 1U);
  EXPECT_EQ(divergence(), "");
}

TEST_F(AutoSimulator, GivesWayToOneThatIsNamedWhenTheSessionContinues) {
  ASSERT_EQ(run_until(2).end, RunEnd::stopped);
  const LoggedSession session = session_to_resume(db, std::nullopt);
  const ResolvedConfig config = resumed(session, "bullet-ea");
  EXPECT_EQ(config->config.simulator, "bullet-ea");
  EXPECT_EQ(config->config.simulator_reason, "");
  EXPECT_EQ(config->protocol->simulator.name, "bullet-ea");
  EXPECT_EQ(resume_session(session, config, {}).end, RunEnd::finished);
  EXPECT_EQ(logged().setups.size(), 2U);
  EXPECT_EQ(divergence(), "");
}

TEST_F(AutoSimulator, MayBeAskedForInTheProtocol) {
  options.simulator.reset();
  protocol.simulator.name = "auto";
  EXPECT_EQ(resolved()->protocol->simulator.name, resolve_auto(protocol).simulator);
}

TEST_F(AutoSimulator, LeavesNoTraceWhereNoOneAskedForIt) {
  options.simulator = "bullet";
  const ResolvedConfig config = resolved();
  EXPECT_EQ(config->config.simulator_reason, "");
  EXPECT_EQ(config->config.rate_hz, protocol.simulator.rate_hz);
  EXPECT_EQ(config->protocol->simulator.name, "bullet");
}

}  // namespace
}  // namespace heft
