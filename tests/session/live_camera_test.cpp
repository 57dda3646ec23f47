// A person's session with a live camera: a simulated device delivers rendered pictures, freezes,
// fails and returns, with a real grabbing thread and a real clock.
#include <gmock/gmock.h>

#include <atomic>

#include "SourceFolder.h"
#include "apparatus/ShippedApparatus.h"
#include "apparatus/sources/FilmedPictures.h"
#include "experiment/ScreenTexts.h"
#include "protocol/readers/Files.h"
#include "record/schema/EventRow.h"
#include "record/temporary_folder.h"
#include "session/MadeUpPeople.h"
#include "session/Protocols.h"
#include "session/Recorded.h"
#include "session/Runner.h"
#include "tracking/camera/ImageFile.h"
#include "tracking/camera/LiveCamera.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::IsEmpty;
using testing::MadeUpConsole;
using testing::MadeUpScreen;
using ::testing::Not;
using testing::patient;
using testing::quick_protocol;
using testing::shared;
using ::testing::SizeIs;

constexpr double rate_hz = 30;
constexpr int n_pictures = 4;  // that differ by their noise

std::vector<Image> rendered(std::optional<Pose> effector) {
  SyntheticCamera camera(shipped_apparatus(), {}, 1);
  std::vector<Image> pictures;
  for (std::uint64_t i = 0; i < n_pictures; ++i)
    pictures.push_back(camera.picture([&](double) { return effector; }, 0, i));
  return pictures;
}

// High above the table, so that cubes appear.
const std::vector<Image>& with_effector() {
  static const auto pictures = rendered(Pose{{0, -0.05, 0.12}, Eigen::Quaterniond::Identity()});
  return pictures;
}
const std::vector<Image>& without_effector() {
  static const auto pictures = rendered({});
  return pictures;
}

const std::vector<Image>& without_board() {
  static const auto pictures = [] {
    std::vector<Image> blank = without_effector();
    std::uint8_t shade = 128;  // equal ones would be a frozen camera's
    for (Image& picture : blank) std::ranges::fill(picture.pixels, shade++);
    return blank;
  }();
  return pictures;
}

enum class Does { film, film_no_effector, film_no_board, freeze, fail };

class MadeUpDevice {
 public:
  std::optional<GrabbedPicture> grab() {
    std::this_thread::sleep_for(std::chrono::duration<double>(1 / rate_hz));
    if (does == Does::fail) return std::nullopt;
    if (does != Does::freeze) ++number_;
    const auto& pictures = does == Does::film_no_effector ? without_effector()
                           : does == Does::film_no_board  ? without_board()
                                                          : with_effector();
    return GrabbedPicture{pictures[number_ % n_pictures], monotonic_s()};
  }
  std::atomic<Does> does = Does::film;

 private:
  std::size_t number_ = 0;
};

struct LiveSession {
  LiveSession(double void_after_s, MadeUpScreen::Person person, Protocol made = quick_protocol())
      : screen(std::move(person)) {
    with_effector(), without_board();  // rendered before the clock runs
    made.display_rate_hz = rate_hz;
    made.void_after_s = void_after_s;
    protocol = shared(std::move(made));
    engine.emplace(protocol, 7);
  }

  RunEnd run(Console* console = nullptr) {
    RunnerOptions options;
    options.ignore_failed_checks = true;  // a busy machine is no camera that fails
    options.console = console;
    const auto open = [&] {
      return std::make_unique<LiveCamera>(
          [this] { return device.grab(); },
          CameraMode{640, 480, rate_hz, "YUYV", {"exposure 4.0 ms"}, {}});
    };
    CameraPictures pictures(open, {*protocol, *hand, shipped_apparatus(), "", clock, 0, ""});
    return Runner({*protocol, *engine, sink, pictures, *hand, screen, clock, answers_themselves,
                   answers_themselves ? &texts : nullptr},
                  options)
        .run();
  }
  void resume() {
    const Event resumed{log_time(clock.now_s()), SessionResumed{}};
    sink.append(resumed, engine->apply(resumed), Durability::buffered);
  }
  std::vector<Event> events(EventKind kind) const { return testing::events_of(sink, kind); }

  std::shared_ptr<const Protocol> protocol;
  std::optional<Engine> engine;
  RecordedSession sink{SessionHeader{}};
  SessionClock clock = SessionClock::wall_from(0);
  std::unique_ptr<Responder> hand = responder_named("simulated").make({});
  MadeUpDevice device;
  MadeUpScreen screen;
  ScreenTexts texts = load_texts(source_folder() + "/protocols/texts/en.toml");
  bool answers_themselves = true;  // otherwise `hand` answers, before no screen
};

bool can_answer(const ScreenState& screen) {
  return screen.screen == Screen::trial && screen.can_answer;
}

// A person who answers as soon as possible, but in the first trial causes an incident of the camera
// and waits until it is over.
class Incident {
 public:
  using IsOver = std::function<bool(LiveSession&)>;
  Incident(Does what, IsOver is_over) : what_(what), is_over_(std::move(is_over)) {}

  std::vector<Touch> operator()(const ViewFrame& picture, const ScreenState& screen) {
    if (!began_ && can_answer(screen)) {
      began_ = true;
      session->device.does = what_;
    }
    if (began_ && !over_) over_ = is_over_(*session);
    if (began_ && !over_) return {};
    return patient(picture, screen);
  }
  LiveSession* session = nullptr;

 private:
  Does what_;
  IsOver is_over_;
  bool began_ = false, over_ = false;
};

std::unique_ptr<LiveSession> session_with(Does what, Incident::IsOver is_over,
                                          double void_after_s) {
  const auto incident = std::make_shared<Incident>(what, std::move(is_over));
  auto session = std::make_unique<LiveSession>(
      void_after_s, [incident](const ViewFrame& picture, const ScreenState& screen) {
        return (*incident)(picture, screen);
      });
  incident->session = session.get();
  return session;
}

// Films again after this event, which ends the incident.
Incident::IsOver films_again_after(EventKind kind) {
  return [kind](LiveSession& session) {
    if (session.events(kind).empty()) return false;
    session.device.does = Does::film;
    return true;
  };
}

std::vector<FrameRow> frames_between(const LiveSession& session, double from_s, double to_s) {
  std::vector<FrameRow> found;
  for (const FrameRow& frame : testing::frames_of(session.sink))
    if (frame.t_s > from_s && frame.t_s < to_s) found.push_back(frame);
  return found;
}

void expect_void_and_again(Does what) {
  const auto session = session_with(what, films_again_after(event_kind<TrialVoided>), 0.3);
  EXPECT_EQ(session->run(), RunEnd::finished);
  const auto paused = session->events(event_kind<SessionPaused>),
             continued = session->events(event_kind<SessionContinued>),
             voided = session->events(event_kind<TrialVoided>);
  ASSERT_THAT(paused, SizeIs(1));
  ASSERT_THAT(continued, SizeIs(1));
  ASSERT_THAT(voided, SizeIs(1));
  EXPECT_EQ(paused[0].as<SessionPaused>()->reason, "camera_lost");
  EXPECT_EQ(voided[0].as<TrialVoided>()->reason, "camera_lost");
  EXPECT_GE(voided[0].t_s - paused[0].t_s, 0.3);
  EXPECT_GE(continued[0].t_s, voided[0].t_s);
  EXPECT_THAT(frames_between(*session, paused[0].t_s, continued[0].t_s), IsEmpty());
  EXPECT_THAT(session->screen.screens, Contains(Field(&ScreenState::screen, Screen::paused)));
  EXPECT_THAT(testing::pages_of(session->sink),
              ElementsAre("setting_up", "welcome", "instructions_sorting", "trial_sorting",
                          "paused", "trial_sorting", "thanks"));
  EXPECT_EQ(session->engine->n_completed(), 2);
  EXPECT_EQ(session->engine->n_attempts(), 3);
}

TEST(LiveCamera, ThatFreezesPausesTheTrialThenVoidsItAndItComesAgain) {
  expect_void_and_again(Does::freeze);
}

TEST(LiveCamera, ThatIsUnpluggedDoesTheSame) {
  expect_void_and_again(Does::fail);
}

TEST(LiveCamera, ThatIsBackSoonVoidsNothing) {
  const auto session = session_with(Does::freeze, films_again_after(event_kind<SessionPaused>), 5);
  EXPECT_EQ(session->run(), RunEnd::finished);
  EXPECT_THAT(session->events(event_kind<SessionPaused>), SizeIs(1));
  EXPECT_THAT(session->events(event_kind<SessionContinued>), SizeIs(1));
  EXPECT_THAT(session->events(event_kind<TrialVoided>), IsEmpty());
  EXPECT_EQ(session->engine->n_attempts(), 2);
}

TEST(LiveCamera, ThatDoesNotSeeTheEffectorPausesNothing) {
  const auto lost_and_found = [](LiveSession& session) {
    if (!session.events(event_kind<EffectorLost>).empty()) session.device.does = Does::film;
    return !session.events(event_kind<EffectorFound>).empty();
  };
  const auto session = session_with(Does::film_no_effector, lost_and_found, 0.3);
  EXPECT_EQ(session->run(), RunEnd::finished);
  EXPECT_THAT(session->events(event_kind<EffectorFound>), SizeIs(1));
  EXPECT_THAT(session->events(event_kind<SessionPaused>), IsEmpty());
  EXPECT_THAT(session->events(event_kind<TrialVoided>), IsEmpty());
  EXPECT_EQ(session->engine->n_attempts(), 2);
}

// No pictures are requested while pages are read or the session is left; this must not count as a
// silent camera.
TEST(LiveCamera, IsNotLostBecauseNoOneAskedIt) {
  LiveSession session(5, patient);
  session.clock.restart(1000);
  EXPECT_EQ(session.run(), RunEnd::finished);
  EXPECT_THAT(session.events(event_kind<SessionPaused>), IsEmpty());
}

std::vector<std::string> reasons_of_pauses(const LiveSession& session) {
  std::vector<std::string> reasons;
  for (const Event& event : session.events(event_kind<SessionPaused>))
    reasons.push_back(event.as<SessionPaused>()->reason);
  return reasons;
}

constexpr double out_of_view_s = 0.7;  // for longer the board is lost

// The board is out of view while a page is read, and shortly afterwards.
TEST(LiveCamera, CountsALostBoardFromTheTrialsStartOn) {
  Protocol protocol = quick_protocol();
  const Sorting::Block one{"sorting", {15, 200, 800}, {{"C2", 1}}, 0};
  protocol.blocks = {one, BreakBlock{"break", out_of_view_s}, one};
  block_as<Sorting::Block>(protocol.blocks[2])->name = "again";
  LiveSession* running = nullptr;
  std::size_t n_frames = 0;
  LiveSession session(
      5,
      [&](const ViewFrame& picture, const ScreenState& screen) {
        const std::size_t n = testing::frames_of(running->sink).size();
        if (screen.screen == Screen::rest) {
          running->device.does = Does::film_no_board;
          n_frames = n;
        } else if (n > n_frames || !running->events(event_kind<SessionPaused>).empty()) {
          running->device.does = Does::film;
        }
        return patient(picture, screen);
      },
      protocol);
  running = &session;
  EXPECT_EQ(session.run(), RunEnd::finished);
  EXPECT_THAT(reasons_of_pauses(session), IsEmpty());
  ASSERT_GT(testing::frames_of(session.sink).size(), n_frames);
  EXPECT_EQ(testing::frames_of(session.sink)[n_frames].n_dropped, 0);
}

// The same while the experimenter holds the trial; pictures of that time do not count as dropped.
TEST(LiveCamera, CountsALostBoardAndDropsFromTheEndOfAPauseOn) {
  double held_since_s = 0;
  std::size_t n_frames = 0;
  bool is_over = false;
  LiveSession session(5, [&](const ViewFrame& picture, const ScreenState& screen) {
    return can_answer(screen) && !is_over ? std::vector<Touch>{} : patient(picture, screen);
  });
  MadeUpConsole console;
  console.on_show = [&](const ConsoleStatus& status) {
    const std::size_t n = testing::frames_of(session.sink).size();
    if (held_since_s == 0 && n > 2) {
      held_since_s = monotonic_s();
      console.commands.push_back({ConsoleCommandKind::pause, {}});
      session.device.does = Does::film_no_board;
    } else if (n_frames == 0 && status.paused && monotonic_s() - held_since_s > out_of_view_s) {
      n_frames = n;
      console.commands.push_back({ConsoleCommandKind::proceed, {}});
    } else if (n_frames > 0 &&
               (n > n_frames || session.events(event_kind<SessionPaused>).size() > 1)) {
      session.device.does = Does::film;
      is_over = true;
    }
  };
  EXPECT_EQ(session.run(&console), RunEnd::finished);
  EXPECT_THAT(reasons_of_pauses(session), ElementsAre("experimenter"));
  EXPECT_THAT(session.events(event_kind<TrialVoided>), IsEmpty());
  ASSERT_GT(testing::frames_of(session.sink).size(), n_frames);
  EXPECT_EQ(testing::frames_of(session.sink)[n_frames].n_dropped, 0);
}

// The camera freezes until three attempts are void; after a check it freezes once more, briefly.
TEST(LiveCamera, ThatVoidedATrialThreeTimesMayHiccupAfterAResume) {
  LiveSession* running = nullptr;
  bool resumed = false, hiccuped = false;
  std::size_t n_voided = 0;
  LiveSession session(0.3, [&](const ViewFrame& picture, const ScreenState& screen) {
    const auto films_after = resumed ? event_kind<SessionPaused> : event_kind<TrialVoided>;
    const std::size_t n = running->events(films_after).size();
    if (n > n_voided) {
      running->device.does = Does::film;
      n_voided = n;
      hiccuped = resumed;
    }
    if (!hiccuped && can_answer(screen)) {
      running->device.does = Does::freeze;
      return std::vector<Touch>{};
    }
    return patient(picture, screen);
  });
  running = &session;
  EXPECT_EQ(session.run(), RunEnd::paused);
  EXPECT_THAT(session.events(event_kind<TrialVoided>), SizeIs(3));
  session.device.does = Does::film;
  session.resume();
  resumed = true;
  n_voided = session.events(event_kind<SessionPaused>).size();
  EXPECT_EQ(session.run(), RunEnd::finished);
  EXPECT_TRUE(hiccuped);
  EXPECT_EQ(session.engine->n_completed(), 2);
}

// As --tracker camera:N with a model, which sees the frames, but whose hand is not filmed.
TEST(LiveCamera, FilmsWhileAModelAnswers) {
  LiveSession session(5, patient);
  session.hand = responder_named("coin").make({});
  session.answers_themselves = false;
  EXPECT_EQ(session.run(), RunEnd::finished);
  EXPECT_THAT(session.events(event_kind<SessionPaused>), IsEmpty());
  EXPECT_EQ(session.engine->n_completed(), 2);
}

std::vector<std::string> names_of(const std::vector<CheckResult>& results) {
  std::vector<std::string> names;
  for (const CheckResult& result : results) names.push_back(result.name);
  return names;
}

TEST(LiveCamera, IsCheckedBeforeTheSessionAndThatIsLogged) {
  LiveSession session(5, patient);
  session.run();
  std::vector<std::string> checks;
  for (const Event& event : session.events(event_kind<CheckResult>))
    checks.push_back(event.as<CheckResult>()->name);
  for (const char* what :
       {"camera", "frame rate", "exposure", "print scale", "light", "board", "effector", "latency"})
    EXPECT_THAT(checks, Contains(what));
}

// A file is checked completely before the session, which then has all of its pictures.
TEST(FileOfPictures, IsCheckedBeforeTheSessionToo) {
  const test::TemporaryFolder folder;
  for (std::size_t i = 0; i < n_pictures; ++i)
    write_image(folder.file(std::to_string(i) + ".png"), with_effector()[i]);
  const auto protocol = shared(quick_protocol());
  const SessionClock clock = SessionClock::wall_from(0);
  const auto hand = responder_named("simulated").make({});
  const auto pictures = tracker_named("frames").make(
      {*protocol, *hand, shipped_apparatus(), folder.path(), clock, 0, ""});
  const auto names = names_of(pictures->check(15));
  EXPECT_THAT(names, Contains("board"));
  EXPECT_THAT(names, Contains("effector"));
  EXPECT_THAT(names, Not(Contains("frame rate")));  // of a file it says nothing of a camera's
  pictures->begin_attempt({});
  for (int i = 0; i < n_pictures; ++i) {
    const auto picture = pictures->next();
    ASSERT_TRUE(picture) << i;
    EXPECT_NEAR(picture->sample.t_capture_s, i / 30.0, 1e-9);
  }
  EXPECT_TRUE(pictures->ended());
}

TEST(RenderedPictures, AreCheckedAsACameras) {
  const auto protocol = shared(quick_protocol());
  const SessionClock clock = SessionClock::wall_from(0);
  const auto hand = responder_named("simulated").make({});
  const auto pictures =
      tracker_named("synthetic").make({*protocol, *hand, shipped_apparatus(), "", clock, 0, ""});
  for (const CheckResult& result : pictures->check(15))
    if (result.name == "board" || result.name == "effector" || result.name == "light") {
      EXPECT_EQ(result.verdict, CheckVerdict::ok) << result.finding;
    }
}

TEST(PicturesOfAModelsHand, CountThoseThatCameTooLateToBeMade) {
  const Protocol protocol = quick_protocol();
  const auto hand = responder_named("simulated").make({});
  hand->begin_trial({1, 1, "sorting", stage_of(protocol, 3)});
  HandPictures pictures(*hand, 10);
  pictures.begin_attempt({});
  EXPECT_EQ(pictures.next()->n_dropped, 0);
  pictures.skip_to(0.15);  // the next one, of 0.1 s, is not over yet
  EXPECT_EQ(pictures.next()->n_dropped, 0);
  pictures.skip_to(0.55);
  const auto after = pictures.next();
  EXPECT_DOUBLE_EQ(after->sample.t_capture_s, 0.5);
  EXPECT_EQ(after->n_dropped, 3);
  EXPECT_EQ(pictures.next()->n_dropped, 0);
}

// Names of verdicts are the same in the log.
TEST(Check, IsLoggedByItsVerdictsName) {
  EXPECT_EQ(row_of({0, CheckResult{CheckVerdict::warning, "light", "too dark"}}).detail,
            R"({"name":"light","verdict":"warning","finding":"too dark"})");
}

}  // namespace
}  // namespace heft
