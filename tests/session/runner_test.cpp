// The runner with simulated pictures and a simulated participant: void trials, an effector out of
// view, a lost camera, cubes that leave the working area, a clear start.
#include "session/Runner.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "base/Error.h"
#include "base/PoseTypes.h"
#include "session/Protocols.h"
#include "session/Recorded.h"

namespace heft {
namespace {

using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::shared;
using testing::small_protocol;

constexpr double display_rate_hz = 15;

// The effector with its tip away from the participant, at a height where it hovers.
Pose hand_at(double x_m, double y_m) {
  return upright_pose({x_m, y_m, 0.025}, std::numbers::pi / 2);
}

// Rests in front of the row, answers one second after the cubes appear.
class Resting : public Responder {
 public:
  void begin_trial(const TrialView& trial) override {
    trial_ = trial;
    seen_s_.reset();
    ++n_trials;
  }
  HandSample hand(double) override { return {hand_at(0, -0.2), true}; }
  std::vector<TimedAction> see(const DisplayedFrame& frame, const ScreenState& screen) override {
    if (frame.cubes.empty()) return {};
    if (!seen_s_) seen_s_ = frame.t_s;
    if (frame.t_s < *seen_s_ + 1) return {};
    seen_s_ = frame.t_s;
    if (trial_.task == "sorting") return {{{"dont_know", {}, {}}, frame.t_s}};
    if (trial_.task == "comparison") return {{{"no_difference", {}, {}}, frame.t_s}};
    return {{{"select", 1 + screen.n_choices % 2, {}}, frame.t_s}};
  }
  bool has_more(double) const override { return true; }

  int n_trials = 0;

 protected:
  TrialView trial_;
  std::optional<double> seen_s_;
};

// Pictures that a function of attempt and time may change.
class MadeUpPictures final : public PictureSource {
 public:
  using Change = std::function<void(int attempt, double t_s, Picture&)>;
  MadeUpPictures(Responder& responder, Change change)
      : hand_(responder, display_rate_hz), change_(std::move(change)) {}
  void begin_attempt(const AttemptStart& attempt) override {
    ++attempt_;
    hand_.begin_attempt(attempt);
  }
  std::optional<Picture> next() override {
    Picture picture = *hand_.next();
    change_(attempt_, picture.sample.t_capture_s, picture);
    return picture;
  }

 private:
  HandPictures hand_;
  Change change_;
  int attempt_ = 0;
};

class Nothing final : public ArView {
 public:
  std::optional<double> present(const ViewFrame& picture, const ScreenState&) override {
    frames.push_back(picture.frame);
    return {};
  }
  std::vector<Touch> wait(double) override { return {}; }
  std::vector<DisplayedFrame> frames;
};

// Two sorting trials and nothing else.
Protocol two_trials() {
  Protocol protocol = small_protocol();
  protocol.blocks = {Sorting::Block{"sorting", {15, 200, 800}, {{"C2", 2}}, 0}};
  return protocol;
}

struct Bench {
  explicit Bench(
      Protocol made = two_trials(), MadeUpPictures::Change change = [](int, double, Picture&) {})
      : Bench(std::move(made), std::make_unique<Resting>(), std::move(change)) {}
  Bench(Protocol made, std::unique_ptr<Responder> who, MadeUpPictures::Change change)
      : protocol(shared(std::move(made))),
        responder(std::move(who)),
        pictures(*responder, std::move(change)) {}

  RunEnd run(const RunnerOptions& options = {}) {
    return Runner({*protocol, engine, sink, pictures, *responder, view, clock}, options).run();
  }
  std::vector<Event> events(EventKind kind) const { return testing::events_of(sink, kind); }
  std::vector<FrameRow> frames() const { return testing::frames_of(sink); }
  std::vector<TrialRow> trials() const {
    std::map<int, TrialRow> rows;
    for (const RecordedEntry& entry : sink.entries())
      if (const auto* recorded = std::get_if<RecordedEvent>(&entry);
          recorded && recorded->changes.trial)
        rows[recorded->changes.trial->attempt_index] = *recorded->changes.trial;
    std::vector<TrialRow> list;
    for (const auto& [index, row] : rows) list.push_back(row);
    return list;
  }

  std::shared_ptr<const Protocol> protocol;
  Engine engine{protocol, 7};
  RecordedSession sink{SessionHeader{}};
  SessionClock clock = SessionClock::virtual_from(0);
  std::unique_ptr<Responder> responder;
  MadeUpPictures pictures;
  Nothing view;
};

TEST(Runner, RunsAWholeSessionToItsEnd) {
  Bench bench(small_protocol());
  EXPECT_EQ(bench.run(), RunEnd::finished);
  EXPECT_EQ(bench.engine.state(), SessionState::finished);
  EXPECT_EQ(bench.events(event_kind<DemonstrationShown>).size(), 1u);
  ASSERT_EQ(bench.events(event_kind<BreakTaken>).size(), 1u);
  EXPECT_EQ(bench.events(event_kind<BreakTaken>)[0].as<BreakTaken>()->duration_s, 60);
}

TEST(Runner, EveryDisplayedPictureIsAFrameAtTheDisplayRate) {
  Bench bench;
  bench.run();
  const auto frames = bench.frames();
  EXPECT_EQ(frames.size(), bench.view.frames.size());
  for (std::size_t i = 1; i < frames.size(); ++i)
    if (frames[i].attempt_index == frames[i - 1].attempt_index) {
      EXPECT_NEAR(frames[i].trial_t_s - frames[i - 1].trial_t_s, 1 / display_rate_hz, 1e-9);
    }
}

TEST(Runner, AnEffectorOutOfViewVoidsNothingAndHidesTheClone) {
  Bench bench(two_trials(), [](int, double t_s, Picture& picture) {
    picture.sample.tracked = t_s < 0.3 || t_s > 0.7;
  });
  EXPECT_EQ(bench.run(), RunEnd::finished);
  EXPECT_THAT(bench.events(event_kind<TrialVoided>), ElementsAre());
  EXPECT_EQ(bench.events(event_kind<EffectorLost>).size(), 2u);
  EXPECT_EQ(bench.events(event_kind<EffectorFound>).size(), 2u);
  for (const DisplayedFrame& frame : bench.view.frames) {
    EXPECT_EQ(frame.clone.has_value(), frame.tracked);
    EXPECT_EQ(frame.cubes.size(), 3u) << "cubes keep their state";
  }
  for (const TrialRow& row : bench.trials()) EXPECT_NEAR(row.lost_s, 0.4, 0.07);
}

TEST(Runner, AModelDoesNotWaitForEverForAnEffectorThatIsNeverSeen) {
  for (const bool is_board_lost : {false, true}) {
    Bench bench(two_trials(), [is_board_lost](int, double, Picture& picture) {
      picture.sample.tracked = false;
      if (is_board_lost) picture.trouble = "board_lost";
    });
    try {
      bench.run();
      FAIL() << "it went on";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("in no picture for 120 s"));
    }
    EXPECT_EQ(bench.engine.state(), SessionState::paused);
  }
}

TEST(Runner, AShortCameraLossPausesTheTrialAndItContinues) {
  Bench bench(two_trials(), [](int attempt, double t_s, Picture& picture) {
    if (attempt == 1 && t_s > 0.3 && t_s < 3) picture.trouble = "camera_lost";
  });
  EXPECT_EQ(bench.run(), RunEnd::finished);
  EXPECT_THAT(bench.events(event_kind<TrialVoided>), ElementsAre());
  ASSERT_EQ(bench.events(event_kind<SessionPaused>).size(), 1u);
  EXPECT_EQ(bench.events(event_kind<SessionPaused>)[0].as<SessionPaused>()->reason, "camera_lost");
  EXPECT_NEAR(bench.trials()[0].paused_s, 2.7, 0.1);
}

TEST(Runner, ALongCameraLossVoidsTheTrialAndPresentsItAgainWhenPicturesReturn) {
  Bench bench(two_trials(), [](int attempt, double t_s, Picture& picture) {
    if (attempt == 1 && t_s > 0.3 && t_s < 8) picture.trouble = "board_lost";
  });
  EXPECT_EQ(bench.run(), RunEnd::finished);
  const auto trials = bench.trials();
  ASSERT_EQ(trials.size(), 3u);
  EXPECT_EQ(trials[0].status, TrialStatus::voided);
  EXPECT_EQ(trials[0].void_reason, "board_lost");
  EXPECT_NEAR(*trials[0].ended_s - trials[0].started_s, 0.3 + bench.protocol->void_after_s, 0.2);
  EXPECT_EQ(trials[1].plan.trial_number, 1);
  EXPECT_EQ(trials[1].plan.attempt, 2);
  EXPECT_NEAR(trials[1].started_s, 8, 0.1) << "only once pictures are back";
}

TEST(Runner, ThreeVoidsOfOneTrialPauseTheSession) {
  Bench bench(two_trials(), [](int, double t_s, Picture& picture) {
    if (t_s > 0.3 && t_s < 6) picture.trouble = "camera_lost";
  });
  EXPECT_EQ(bench.run(), RunEnd::paused);
  EXPECT_EQ(bench.trials().size(), 3u);
  EXPECT_EQ(bench.engine.state(), SessionState::paused);
}

TEST(Runner, CubesAppearOnlyOnceTheEffectorIsClearOfThem) {
  Bench bench(two_trials(), [](int, double t_s, Picture& picture) {
    picture.sample.pose = hand_at(0, t_s < 1 ? -0.06 : -0.2);
  });
  bench.run();
  for (const TrialRow& row : bench.trials()) EXPECT_NEAR(*row.shown_s - row.started_s, 1, 0.07);
  for (const DisplayedFrame& frame : bench.view.frames) {
    EXPECT_EQ(frame.cubes.empty(), frame.t_s < 1);
    EXPECT_TRUE(frame.clone) << "the clone is always displayed";
  }
}

TEST(Runner, APushedCubeThatLeavesItsAreaComesBackOnceUntouched) {
  // Through the middle cube's place, 25 cm forward and back, then off to the side.
  const auto push = [](int, double t_s, Picture& picture) {
    const double y_m = t_s < 0.2 ? -0.15 : t_s < 0.6 ? -0.15 + 0.7 * (t_s - 0.2) : -0.15;
    picture.sample.pose = hand_at(0, y_m);
  };
  Protocol protocol = two_trials();
  protocol.layout.area_m = {0.4, 0.16};
  Bench bench(protocol, push);
  bench.run();
  const auto back = bench.events(event_kind<CubesReset>);
  ASSERT_FALSE(back.empty());
  EXPECT_EQ(back[0].as<CubesReset>()->slot, 2) << "out of its area, not by the button";
  const auto contacts = bench.events(event_kind<CubeTouch>);
  ASSERT_GE(contacts.size(), 2u);
  EXPECT_EQ(contacts[0].what, EventPayload(CubeTouch{2, std::nullopt})) << "it began";
  EXPECT_GT(back[0].t_s, contacts[0].t_s);
  EXPECT_NEAR(bench.view.frames.back().cubes[1].position_m.y(), 0, 1e-6);
  for (const FrameRow& frame : bench.frames())
    EXPECT_THAT(frame.contact_slot, AnyOf(std::nullopt, 2));
}

TEST(Runner, AllCubesGoBackAtOnceWhereTheProtocolSaysSo) {
  const auto push = [](int, double t_s, Picture& picture) {
    const double y_m = t_s < 0.2 ? -0.15 : t_s < 0.6 ? -0.15 + 0.7 * (t_s - 0.2) : 0.13;
    picture.sample.pose = hand_at(0, t_s < 1.2 ? y_m : -0.15);
  };
  Protocol protocol = two_trials();
  protocol.layout.area_m = {0.4, 0.16};
  protocol.layout.out_of_area = OutOfArea::together;
  Bench bench(protocol, push);
  bench.run();
  const auto back = bench.events(event_kind<CubesReset>);
  ASSERT_GE(back.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(back[static_cast<std::size_t>(i)].as<CubesReset>()->slot, i + 1);
    EXPECT_EQ(back[static_cast<std::size_t>(i)].t_s, back[0].t_s) << "in one frame";
  }
  for (const Pose& cube : bench.view.frames.back().cubes) EXPECT_NEAR(cube.position_m.y(), 0, 1e-6);
}

TEST(Runner, CubesStayWhereTheProtocolSaysSo) {
  Protocol protocol = two_trials();
  protocol.layout.area_m = {0.4, 0.16};
  protocol.layout.out_of_area = OutOfArea::stay;
  Bench bench(protocol, [](int, double t_s, Picture& picture) {
    picture.sample.pose = hand_at(0, std::min(-0.15 + 0.3 * t_s, 0.1));
  });
  bench.run();
  EXPECT_THAT(bench.events(event_kind<CubesReset>), ElementsAre());
  EXPECT_GT(bench.view.frames.back().cubes[1].position_m.y(), 0.08);
}

TEST(Runner, AnActionThatTheScreenDoesNotOfferStopsTheSessionAndIsNamed) {
  class Wrong final : public Resting {
    std::vector<TimedAction> see(const DisplayedFrame& frame, const ScreenState&) override {
      return {{{"validate", {}, {}}, frame.t_s}};
    }
  };
  Bench bench(two_trials(), std::make_unique<Wrong>(), [](int, double, Picture&) {});
  try {
    bench.run();
    FAIL() << "it must be refused";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("trial 1"));
    EXPECT_THAT(error.what(), HasSubstr("validate"));
  }
  EXPECT_EQ(bench.engine.state(), SessionState::paused);
  EXPECT_EQ(bench.trials()[0].void_reason, "interrupted");
}

TEST(Runner, AStopLeavesASessionThatCanBeResumed) {
  std::atomic<bool> stop{false};
  Bench bench(two_trials(), [&](int attempt, double t_s, Picture&) {
    if (attempt == 2 && t_s > 0.5) stop = true;
  });
  RunnerOptions options;
  options.stop = &stop;
  EXPECT_EQ(bench.run(options), RunEnd::stopped);
  EXPECT_EQ(bench.engine.state(), SessionState::paused);
  EXPECT_EQ(bench.engine.n_completed(), 1);
  stop = false;
  bench.engine.apply({bench.engine.last_s(), SessionResumed{}});
  EXPECT_EQ(bench.run(options), RunEnd::finished);
  EXPECT_EQ(bench.engine.n_completed(), 2);
}

TEST(Runner, AReshuffledIntroductionShowsNewCubesOnceTheEffectorIsClear) {
  Protocol protocol = small_protocol();
  Introduction::Block introduction{"introduction", {15, 800}};
  introduction.wrong_answer = WrongAnswer::reshuffle;
  protocol.blocks = {introduction};
  int most_shown = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Bench bench(protocol);
    bench.engine = Engine(bench.protocol, seed);
    EXPECT_EQ(bench.run(), RunEnd::finished);
    const auto n_answers = bench.events(event_kind<Action>).size();
    EXPECT_EQ(bench.events(event_kind<CubesShown>).size(), n_answers);
    most_shown = std::max(most_shown, static_cast<int>(n_answers));
  }
  EXPECT_GT(most_shown, 1) << "no seed gave a wrong first answer; the test shows nothing";
}

}  // namespace
}  // namespace heft
