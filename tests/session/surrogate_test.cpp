// Sessions of straight strokes without pictures: complete, replayable, and close to full sessions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "SourceFolder.h"
#include "analysis/Analysis.h"
#include "analysis/dataset/Dataset.h"
#include "analysis/dataset/Summary.h"
#include "protocol/readers/Files.h"
#include "record/temporary_folder.h"
#include "replay/Replay.h"
#include "session/Simulation.h"

namespace heft {
namespace {
using ::testing::HasSubstr;

ResolvedConfig resolved(const std::string& protocol, const std::string& tracker,
                        const std::string& responder = "simulated") {
  SessionOptions given;
  given.responder = Plug{responder};
  given.tracker = Plug{tracker};
  return resolve(given, load_protocol(source_folder() + "/protocols/" + protocol, {}), 11);
}

void simulate_some(const ResolvedConfig& config, const std::string& db, int participants) {
  const std::atomic<bool> stop = false;
  SimulationRequest request{config, db, participants, 2};
  ASSERT_EQ(simulate(
                request, [](int) {}, stop),
            participants);
}

class SurrogateOf : public ::testing::TestWithParam<const char*> {};

TEST_P(SurrogateOf, ATaskFinishesAndReplays) {
  const test::TemporaryFolder folder;
  for (const char* responder : {"simulated", "coin"}) {
    const std::string db = folder.file(std::string(responder) + ".db");
    simulate_some(resolved(GetParam(), "surrogate", responder), db, 2);
    const LogReader log(db);
    for (const SessionRow& session : log.sessions()) {
      EXPECT_EQ(session.state, SessionState::finished);
      EXPECT_FALSE(verify_rows(log, session.session_id).first) << responder;
      EXPECT_EQ(load_session(log, db, session.session_id).setup.simulator, "push");
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Protocols, SurrogateOf,
                         ::testing::Values("quick.toml", "sorting.toml", "paper.toml",
                                           "examples/forced_choice.toml",
                                           "examples/adjustment.toml"));

double mean_jnd_g(const std::string& db, double reference_g) {
  const Summary summary = analyze({{db}, {}, false, "test"});
  for (const StudyEstimate& one : summary.estimates)
    if (one.participant.empty() && one.measure->name == "jnd" && one.reference_g == reference_g &&
        one.value)
      return *one.value;
  return 0;
}

// The same 24 people: their answers differ trial by trial, but their mean hardly.
TEST(Surrogate, GivesAboutTheFiguresOfFullSessions) {
  const test::TemporaryFolder folder;
  simulate_some(resolved("jnd.toml", "surrogate"), folder.file("surrogate.db"), 24);
  simulate_some(resolved("jnd.toml", "hand"), folder.file("hand.db"), 24);
  const double full_g = mean_jnd_g(folder.file("hand.db"), 200);
  ASSERT_GT(full_g, 20);
  EXPECT_NEAR(mean_jnd_g(folder.file("surrogate.db"), 200) / full_g, 1, 0.15);
}

TEST(Surrogate, IsForModelsAndHasItsOwnSimulator) {
  const auto why = [](const SessionOptions& given) -> std::string {
    try {
      resolve(given, load_protocol(source_folder() + "/protocols/quick.toml", {}), 1);
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), ExitCode::usage);
      return error.what();
    }
    return "";
  };
  SessionOptions given;
  given.tracker = Plug{"surrogate"};
  given.view = Plug{"headless"};
  EXPECT_THAT(why(given), HasSubstr("expected a model as --responder"));
  given.responder = Plug{"simulated"};
  EXPECT_EQ(why(given), "");
  given.simulator = "boxes";
  EXPECT_THAT(why(given), HasSubstr("expected no --simulator"));
}

}  // namespace
}  // namespace heft
