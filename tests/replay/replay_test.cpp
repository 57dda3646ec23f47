// Verifies sessions that were run in memory and stored.
#include "replay/Replay.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "SourceFolder.h"
#include "apparatus/TrialWorld.h"
#include "apparatus/configuration/ResolvedConfig.h"
#include "base/Clock.h"
#include "base/Pose.h"
#include "base/PoseTypes.h"
#include "base/Program.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"
#include "replay/WhatIf.h"
#include "session/Protocols.h"
#include "session/Recorded.h"
#include "session/Runner.h"
#include "tasks/Tasks.h"

namespace heft {
namespace {

// Pushes the middle cube to and fro, and answers every trial `delay_s` after a picture.
class LateAnswers final : public Responder {
 public:
  explicit LateAnswers(double delay_s) : delay_s_(delay_s) {}
  void begin_trial(const TrialView& trial) override { task_ = trial.task; }
  HandSample hand(double t_s) override {
    const double y_m = -0.15 + 0.09 * (1 - std::cos(2 * t_s));
    return {upright_pose({-0.04, y_m, 0.025}, std::numbers::pi / 2), true};
  }
  std::vector<TimedAction> see(const DisplayedFrame& frame, const ScreenState& screen) override {
    const double t_s = frame.t_s + delay_s_;
    if (frame.cubes.empty() || frame.t_s < 2) return {};
    if (task_ == "introduction") return {{{"select", 1 + screen.n_choices % 2}, t_s}};
    if (task_ == "comparison") return {{{"no_difference"}, t_s}};
    if (frame.t_s > 9) return {{{"dont_know"}, t_s}};
    return {
        {{"label", 1, Label(Sorting::labels.at(static_cast<std::size_t>(screen.n_choices % 3)))},
         t_s}};
  }
  bool has_more(double) const override { return true; }

 private:
  double delay_s_;
  Task task_ = "sorting";
};

class Replay : public ::testing::Test {
 protected:
  void SetUp() override {
    protocol = load_protocol(source_folder() + "/protocols/quick.toml");
    path = std::filesystem::temp_directory_path() /
           ("heft-replay-" + std::to_string(::getpid()) + ".db");
  }
  void TearDown() override {
    for (const char* end : {"", "-wal", "-shm", "-lock", ".v2", ".v3", ".v4", ".v5", ".v6", ".v7"})
      std::filesystem::remove(path.string() + end);
  }

  Verification run_and_verify(Responder& responder) {
    SessionHeader header;
    header.participant = "1";
    header.protocol_name = protocol.name;
    header.protocol_text = protocol.text;
    header.protocol_sha256 = protocol.sha256;
    header.seed = 5;
    header.heft_version = "test";
    header.build = build_name();
    SessionOptions model;
    model.responder = Plug{"simulated"};
    SessionConfig setup = resolve(model, protocol, header.seed)->config;
    setup.tracker = {"camera", "0"};  // whose pictures and touches keep no common beat
    header.purpose = Purpose::test;
    header.responder = "late";
    header.started_utc = utc_now();
    RecordedSession recorded(header);
    Engine engine(std::make_shared<const Protocol>(protocol), header.seed);
    const Event told{0, setup};
    recorded.append(told, engine.apply(told), Durability::buffered);
    HandPictures pictures(responder, protocol.display_rate_hz);
    const auto view = view_named("headless").make({});
    SessionClock clock = SessionClock::virtual_from(0);
    Runner({protocol, engine, recorded, pictures, responder, *view, clock}, {}).run();
    frames = testing::frames_of(recorded);
    const std::int64_t id = SessionArchive(path.string()).store(recorded);
    return verify_session(LogReader(path.string()), id, [](double) {});
  }

  void see_through(const std::string& keys) {
    protocol = parse_protocol(protocol.text + "\n[physics]\n" + keys, "quick");
    protocol.name = "quick";
  }

  Protocol protocol;
  std::filesystem::path path;
  std::vector<FrameRow> frames;
};

TEST_F(Replay, LogsOfOlderVersionsAreVerified) {
  for (const int version : {5, 6}) {
    const test::TemporaryFolder folder;
    const std::string file = folder.file("older.db");
    test::copy_older_log(file, version);
    const LogReader reader(file);
    for (const SessionRow& session : reader.sessions()) {
      const Verification found = verify_session(reader, session.session_id, [](double) {});
      EXPECT_FALSE(found.first) << "session " << session.session_id << ": " << found.first->what
                                << ", logged " << found.first->logged << ", came out "
                                << found.first->replayed;
      // Poses of another build must agree within 1e-6 m.
      EXPECT_LE(found.largest_difference_m, 1e-6) << "session " << session.session_id;
      if (found.n_other_edition == 0) {
        EXPECT_EQ(found.largest_of_other_edition_m, 0);
      }
    }
  }
}

TEST_F(Replay, AColumnThatTheUpgradeAddedMustHoldWhatItWrites) {
  test::copy_older_log(path);
  const LogReader upgraded(path.string());
  SQLite::Database(path.string(), SQLite::OPEN_READWRITE)
      .exec("UPDATE answer SET value = 3 WHERE answer_id = 1");
  const Verification found = verify_session(LogReader(path.string()), 1, [](double) {});
  ASSERT_TRUE(found.first);
  EXPECT_EQ(found.first->what, "answer: answer 1, value");
  EXPECT_EQ(found.first->replayed, "NULL");
}

TEST_F(Replay, AnswersLaterThanTheNextPicturesAreReplayedExactly) {
  for (double delay_s : {0.0, 0.05, 0.07, 0.2}) {
    LateAnswers responder(delay_s);
    const Verification found = run_and_verify(responder);
    EXPECT_GT(found.n_frames, 100);
    EXPECT_EQ(found.n_other_build, 0);
    EXPECT_FALSE(found.first) << delay_s << " s: " << found.first->what << ", logged "
                              << found.first->logged << ", came out " << found.first->replayed;
    TearDown();
  }
}

// The log has the measured pose, from which the prediction is recomputed.
TEST_F(Replay, APredictionToWhenItIsSeenIsReplayedExactly) {
  see_through("input = \"extrapolate\"\npredict_s = 0.05\n");
  LateAnswers responder(0.05);
  const Verification found = run_and_verify(responder);
  EXPECT_GT(found.n_frames, 100);
  EXPECT_EQ(found.n_other_build, 0);
  EXPECT_FALSE(found.first) << found.first->what << ", logged " << found.first->logged
                            << ", came out " << found.first->replayed;
  for (const FrameRow& frame : frames)
    EXPECT_EQ(frame.effector.position_m, responder.hand(frame.trial_t_s).pose.position_m);
}

// No cube appears where the effector is, and the clone is at the predicted pose.
TEST(SeeThrough, TheCloneIsAheadAndTheEffectorAsMeasured) {
  Protocol protocol = testing::small_protocol();
  protocol.simulator.input.predict_s = 0.1;
  TrialPlan plan;
  plan.masses_g = {15, 200, 800};
  TrialWorld world(protocol, plan);
  TargetSample sample = sample_of(0, upright_pose({0, -0.04, 0.021}, std::numbers::pi / 2));
  sample.velocity.linear_m_s = {0, -0.2, 0};
  const DisplayedFrame frame = world.advance(sample).frame;
  EXPECT_EQ(frame.effector.position_m, sample.pose.position_m);
  ASSERT_TRUE(frame.clone);
  EXPECT_NEAR(frame.clone->position_m.y(), -0.06, 1e-12);
  EXPECT_TRUE(frame.cubes.empty());
  // Captured within the clear distance, but predicted beyond it.
  sample.t_capture_s = 0.1;
  sample.pose.position_m.y() = -0.075;
  EXPECT_EQ(world.advance(sample).frame.cubes.size(), 3u);
}

TEST_F(Replay, WhatAnotherPredictionWouldHaveShown) {
  LateAnswers responder(0.05);
  run_and_verify(responder);
  const LogReader reader(path.string());
  const auto session = load_session(reader, path.string(), reader.sessions().front().session_id);
  const auto clone_rms_m = [&](double predict_s) {
    const Protocol other = parse_protocol(
        protocol.text, "quick",
        std::vector<ProtocolSetting>{{"physics.predict_s", std::to_string(predict_s)}});
    double largest_m = 0;
    for (const PathDifference& difference : compare_paths(reader, session, other))
      largest_m = std::max(largest_m, difference.clone_rms_m);
    return largest_m;
  };
  EXPECT_EQ(clone_rms_m(0), 0);
  // The hand's speed is 0.18 m/s at most.
  EXPECT_GT(clone_rms_m(0.05), 0.003);
  EXPECT_LT(clone_rms_m(0.05), 0.05 * 0.18);
  EXPECT_GT(clone_rms_m(0.1), 1.5 * clone_rms_m(0.05));
}

}  // namespace
}  // namespace heft
