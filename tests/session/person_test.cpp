// A person's session on a wall clock, with a simulated screen that is touched and a simulated
// console of the experimenter.
#include <gmock/gmock.h>

#include "SourceFolder.h"
#include "base/Error.h"
#include "experiment/ScreenTexts.h"
#include "protocol/readers/Files.h"
#include "session/MadeUpPeople.h"
#include "session/Protocols.h"
#include "session/Recorded.h"
#include "session/Runner.h"
#include "tasks/Offers.h"

namespace heft {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using testing::every_page_protocol;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::MadeUpConsole;
using testing::MadeUpScreen;
using ::testing::Not;
using testing::pages_of;
using testing::patient;
using testing::quick_protocol;
using testing::shared;
using testing::touch;

std::unique_ptr<Responder> some_hand() {
  return responder_named("simulated").make({});
}

// Pictures of a camera with or without a spare print of the effector in view.
struct FilmedHandPictures : HandPictures {
  using HandPictures::HandPictures;
  std::optional<Picture> next() override {
    auto picture = HandPictures::next();
    if (picture) picture->doubled = doubled;
    return picture;
  }
  bool doubled = false;
};

struct Session {
  explicit Session(Protocol made, MadeUpScreen::Person person = patient)
      : protocol(shared(std::move(made))), screen(std::move(person)) {}

  RunEnd run(Console* console = nullptr) {
    RunnerOptions options;
    options.console = console;
    return Runner({*protocol, engine, sink, pictures, *hand, screen, clock, true, &texts}, options)
        .run();
  }
  std::vector<Event> events(EventKind kind) const { return testing::events_of(sink, kind); }
  std::vector<FrameRow> frames() const { return testing::frames_of(sink); }

  std::shared_ptr<const Protocol> protocol;
  Engine engine{protocol, 7};
  RecordedSession sink{SessionHeader{}};
  SessionClock clock = SessionClock::wall_from(0);
  std::unique_ptr<Responder> hand = some_hand();
  FilmedHandPictures pictures{*hand, protocol->display_rate_hz};
  MadeUpScreen screen;
  ScreenTexts texts = load_texts(source_folder() + "/protocols/texts/fr.toml");
};

TEST(Person, GoesThroughAllPagesAndTrials) {
  Session session(every_page_protocol());
  EXPECT_EQ(session.run(), RunEnd::finished);
  EXPECT_THAT(
      pages_of(session.sink),
      ElementsAre("consent", "welcome", "about_you", "demonstration", "instructions_sorting",
                  "trial_sorting", "rest", "instructions_introduction", "trial_introduction",
                  "how_decided", "thanks"));
  const Event consented = session.events(event_kind<Consent>).at(0);
  const Consent& consent = *consented.as<Consent>();
  EXPECT_TRUE(consent.agreed);
  EXPECT_EQ(consent.language, "fr");
  EXPECT_EQ(consent.sha256.size(), 64U);
  EXPECT_EQ(session.engine.n_completed(), 3);
  EXPECT_GE(session.events(event_kind<BreakTaken>).at(0).as<BreakTaken>()->duration_s, 0.1);
}

TaskBlock practiced_sorting(const std::string& name) {
  TaskBlock block(Sorting::Block{name, {15, 200, 800}, {{"C2", 2}}, 0});
  block.practice = Practice{2, 0, false};
  return block;
}

TEST(Person, LearnsThatPracticeIsOverBeforeTheTrialsThatCount) {
  Protocol protocol = quick_protocol();
  protocol.blocks = {practiced_sorting("one"), practiced_sorting("other")};
  Session session(protocol);
  EXPECT_EQ(session.run(), RunEnd::finished);
  std::vector<std::string> pages = pages_of(session.sink);
  std::erase(pages, "welcome");
  const std::vector<std::string> of_block{"instructions_sorting", "trial_sorting",
                                          "instructions_after_practice", "trial_sorting"};
  std::vector<std::string> expected = of_block;
  expected.insert(expected.end(), of_block.begin(), of_block.end());
  expected.emplace_back("thanks");
  EXPECT_EQ(pages, expected);
  bool is_practice = true;
  for (const RecordedEntry& entry : session.sink.entries()) {
    const auto* recorded = std::get_if<RecordedEvent>(&entry);
    if (!recorded) continue;
    const auto* shown = recorded->event.as<TextShown>();
    if (shown && shown->page == "instructions_sorting") is_practice = true;
    if (shown && shown->page == "instructions_after_practice") is_practice = false;
    if (recorded->event.as<TrialStarted>()) {
      EXPECT_EQ(recorded->changes.trial->plan.is_practice, is_practice);
    }
  }
}

TEST(Person, WithoutPracticeOrItsPageReadsNothingOfIt) {
  const auto shows_page = [](const Protocol& protocol, bool has_text) {
    Session session(protocol);
    if (!has_text) session.texts.pages.erase("instructions_after_practice");
    EXPECT_EQ(session.run(), RunEnd::finished);
    return std::ranges::count(pages_of(session.sink), "instructions_after_practice") > 0;
  };
  EXPECT_FALSE(shows_page(quick_protocol(), true));
  Protocol protocol = quick_protocol();
  protocol.blocks = {practiced_sorting("one")};
  EXPECT_TRUE(shows_page(protocol, true));
  EXPECT_FALSE(shows_page(protocol, false)) << "texts from before it";
}

TEST(Person, WhoDoesNotAgreeTakesNoPart) {
  Protocol protocol = quick_protocol();
  protocol.screens.consent = true;
  Session session(protocol, [](const ViewFrame&, const ScreenState&) {
    return std::vector{touch(TouchKind::decline)};
  });
  EXPECT_EQ(session.run(), RunEnd::declined);
  EXPECT_EQ(session.engine.state(), SessionState::aborted);
  EXPECT_EQ(session.engine.n_attempts(), 0);
}

TEST(Person, AnswersAreLoggedAtTheTimeOfTheTouchAndShownAtOnce) {
  Session session(quick_protocol());
  session.run();
  const auto actions = session.events(event_kind<Action>);
  ASSERT_EQ(actions.size(), 8U);
  EXPECT_THAT(session.screen.screens, Contains(::testing::ResultOf(
                                          [](const ScreenState& shown) { return labels_on(shown); },
                                          ElementsAre("lightest", "intermediate", "heaviest"))));
  for (std::size_t i = 1; i < actions.size(); ++i) EXPECT_GE(actions[i].t_s, actions[i - 1].t_s);
}

TEST(Person, ATouchThatCanNotBeTakenIsKeptAsRefusedAndEndsNothing) {
  bool tried = false;
  Session session(quick_protocol(), [&](const ViewFrame& picture, const ScreenState& screen) {
    if (screen.screen == Screen::trial && screen.can_answer && !tried) {
      tried = true;
      return std::vector{touch("validate")};
    }
    return patient(picture, screen);
  });
  EXPECT_EQ(session.run(), RunEnd::finished);
  ASSERT_EQ(session.events(event_kind<ActionRefused>).size(), 1U);
  const Event refused = session.events(event_kind<ActionRefused>)[0];
  EXPECT_EQ(refused.as<ActionRefused>()->action, Action{"validate"});
  EXPECT_THAT(refused.as<ActionRefused>()->reason, HasSubstr("label"));
}

// Such as the second tap of a double tap while the page turns.
TEST(Person, ATouchOnThePageBeforeMeansNothingOnThisOne) {
  PageId before;
  int n_late = 0;
  Session session(quick_protocol(), [&](const ViewFrame& picture, const ScreenState& screen) {
    std::vector<Touch> touches = patient(picture, screen);
    if (before == PageId{}) before = screen.page();
    if (screen.page() != before && !touches.empty()) {
      Touch late = screen.screen == Screen::trial ? touch("dont_know") : touch(TouchKind::next);
      late.page = std::exchange(before, screen.page());
      ++n_late;
      return std::vector{late};
    }
    return touches;
  });
  EXPECT_EQ(session.run(), RunEnd::finished);
  EXPECT_GE(n_late, 3);
  EXPECT_EQ(session.events(event_kind<Action>).size(), 8U) << "those that were meant, and no other";
  EXPECT_THAT(session.events(event_kind<ActionRefused>), IsEmpty());
}

TEST(Person, WhatTheySayAboutThemselvesIsKept) {
  Protocol protocol = quick_protocol();
  protocol.screens.about_you = true;
  bool told = false;
  Session session(protocol, [&](const ViewFrame& picture, const ScreenState& screen) {
    if (screen.screen == Screen::about_you && !told) {
      told = true;
      Touch entry = touch(TouchKind::entry);
      entry.key = "handedness";
      entry.value = "left";
      return std::vector{entry};
    }
    return patient(picture, screen);
  });
  session.run();
  EXPECT_EQ(session.sink.header().participant_info.at("handedness"), "left");
}

TEST(Person, TheCubesGoBackAtATouch) {
  bool asked = false;
  Session session(quick_protocol(), [&](const ViewFrame& picture, const ScreenState& screen) {
    if (screen.screen == Screen::trial && screen.can_answer && !asked) {
      asked = true;
      return std::vector{touch(TouchKind::put_cubes_back)};
    }
    return patient(picture, screen);
  });
  EXPECT_EQ(session.run(), RunEnd::finished);
  ASSERT_EQ(session.events(event_kind<CubesReset>).size(), 1U);
  EXPECT_EQ(session.events(event_kind<CubesReset>)[0].as<CubesReset>()->slot, std::nullopt)
      << "all of them, by the button";
}

TEST(Person, WhoClosesTheWindowCanComeBack) {
  Session session(quick_protocol(), [](const ViewFrame& picture, const ScreenState& screen) {
    return screen.screen == Screen::trial && !picture.frame.cubes.empty()
               ? std::vector{touch(TouchKind::close)}
               : patient(picture, screen);
  });
  EXPECT_EQ(session.run(), RunEnd::stopped);
  EXPECT_EQ(session.engine.state(), SessionState::paused);
  EXPECT_EQ(session.events(event_kind<TrialVoided>).at(0).as<TrialVoided>()->reason,
            void_interrupted);
}

TEST(Person, EveryPictureHasItsTimes) {
  Session session(quick_protocol());
  session.run();
  ASSERT_THAT(session.frames(), Not(IsEmpty()));
  for (const FrameRow& frame : session.frames()) {
    EXPECT_LE(frame.capture_s, frame.detected_s.value());
    EXPECT_LE(*frame.detected_s, frame.simulated_s.value());
    EXPECT_LE(*frame.simulated_s, frame.present_s);
    EXPECT_TRUE(frame.n_dropped);
  }
  EXPECT_EQ(session.events(event_kind<CameraReport>).size(), 2U);
}

TEST(Person, PicturesWithASecondPrintOfATagAreCounted) {
  for (const bool doubled : {false, true}) {
    Session session(quick_protocol());
    session.pictures.doubled = doubled;
    session.run();
    for (const Event& event : session.events(event_kind<CameraReport>)) {
      const CameraReport& report = *event.as<CameraReport>();
      EXPECT_GT(report.n_shown, 0);
      EXPECT_EQ(report.n_doubled, doubled ? report.n_shown : 0);
    }
  }
}

// Gives its commands in order, one for each screen of a trial.
struct ScriptedConsole : MadeUpConsole {
  explicit ScriptedConsole(std::deque<ConsoleCommand> made) : to_come(std::move(made)) {
    on_show = [this](const ConsoleStatus& status) {
      if (to_come.empty() || (status.screen->screen != Screen::trial && !status.paused)) return;
      commands.push_back(to_come.front());
      to_come.pop_front();
    };
  }
  std::deque<ConsoleCommand> to_come;
};

TEST(Experimenter, HoldsTheSessionAndLetsItContinue) {
  ScriptedConsole console({{ConsoleCommandKind::pause, {}}, {ConsoleCommandKind::proceed, {}}});
  Session session(quick_protocol());
  EXPECT_EQ(session.run(&console), RunEnd::finished);
  EXPECT_EQ(session.events(event_kind<SessionPaused>).at(0).as<SessionPaused>()->reason,
            "experimenter");
  EXPECT_EQ(session.events(event_kind<SessionContinued>).size(), 1U);
  EXPECT_THAT(session.screen.screens, Contains(Field(&ScreenState::screen, Screen::paused)));
  EXPECT_THAT(pages_of(session.sink),
              ElementsAre("welcome", "instructions_sorting", "trial_sorting", "paused",
                          "trial_sorting", "thanks"));
  EXPECT_THAT(session.events(event_kind<TrialVoided>), IsEmpty());
}

// Compares every status with the screen displayed at that time.
TEST(Experimenter, SeesWhichPageItIsAndThatOnlyTrialsAreTracked) {
  Session session(every_page_protocol());
  MadeUpConsole console;
  int n_tracked = 0;
  console.on_show = [&](const ConsoleStatus& status) {
    const Screen there = session.screen.screens.back().screen;
    ASSERT_TRUE(status.screen);
    EXPECT_EQ(name_of(status.screen->screen), name_of(there));
    if (there != Screen::trial) {
      EXPECT_FALSE(status.tracking) << name_of(there);
    }
    if (status.tracking && status.tracking->tracked) ++n_tracked;
  };
  EXPECT_EQ(session.run(&console), RunEnd::finished);
  EXPECT_GT(n_tracked, 0);
}

TEST(Experimenter, SeesNothingTrackedWhileTheSessionIsHeld) {
  ScriptedConsole console({{ConsoleCommandKind::pause, {}}, {ConsoleCommandKind::proceed, {}}});
  Session session(quick_protocol());
  session.run(&console);
  const auto held = std::ranges::find_if(
      console.shown, [](const ConsoleStatus& s) { return s.screen->screen == Screen::paused; });
  ASSERT_NE(held, console.shown.end());
  EXPECT_FALSE(held->tracking);
}

class FailedCheck : public ::testing::Test {
 protected:
  // A camera that is out of order, without a hand.
  class OutOfOrder final : public PictureSource {
   public:
    explicit OutOfOrder(PictureSource& pictures, int n_failures = 1000)
        : pictures_(pictures), n_failures_(n_failures) {}
    void begin_attempt(const AttemptStart& attempt) override { pictures_.begin_attempt(attempt); }
    std::optional<Picture> next() override { return pictures_.next(); }
    void skip_to(double t_s) override { pictures_.skip_to(t_s); }
    std::vector<CheckResult> check(double) override {
      const auto board = n_failures_-- > 0 ? CheckVerdict::failed : CheckVerdict::ok;
      return {{board, "board", "not seen"}, {CheckVerdict::warning, "light", "dim"}};
    }

   private:
    PictureSource& pictures_;
    int n_failures_;
  };

  RunEnd run() {
    OutOfOrder pictures(session.pictures, n_failures);
    RunnerOptions options;
    options.console = &console;
    options.ignore_failed_checks = ignore_failed_checks;
    return Runner({*session.protocol, session.engine, session.sink, pictures, *session.hand,
                   session.screen, session.clock, true, &session.texts},
                  options)
        .run();
  }
  std::vector<std::string> notes() const {
    std::vector<std::string> texts;
    for (const Event& event : session.events(event_kind<Note>))
      texts.push_back(event.as<Note>()->text);
    return texts;
  }

  Session session{quick_protocol()};
  MadeUpConsole console;
  int n_failures = 1000;
  bool ignore_failed_checks = false;
};

TEST_F(FailedCheck, IsAskedAboutAndTheSessionBeginsWhenTheExperimenterSaysSo) {
  console.answer = ConsoleCommandKind::proceed;
  console.on_show = [&](const ConsoleStatus& status) {
    EXPECT_EQ(status.screen.has_value(), !session.screen.screens.empty());
  };
  EXPECT_EQ(run(), RunEnd::finished);
  EXPECT_THAT(console.asked, ElementsAre(HasSubstr("the participant has seen nothing")));
  EXPECT_THAT(console.said, Contains(HasSubstr("FAILED   board: not seen")));
  EXPECT_THAT(notes(), ElementsAre("failed check: board; the experimenter continues"));
  EXPECT_LE(session.events(event_kind<Note>)[0].t_s, session.events(event_kind<TextShown>)[0].t_s);
}

TEST_F(FailedCheck, LeavesTheSessionToBeResumedWhenTheyDoNot) {
  console.answer = ConsoleCommandKind::end;
  EXPECT_EQ(run(), RunEnd::stopped);
  EXPECT_THAT(session.screen.screens, IsEmpty());
  EXPECT_THAT(pages_of(session.sink), IsEmpty());
  EXPECT_THAT(notes(), ElementsAre("failed check: board; the experimenter leaves"));
  EXPECT_EQ(session.engine.state(), SessionState::paused);
}

TEST_F(FailedCheck, EndsTheSessionToBeResumedWhereNoOneCanBeAsked) {
  try {
    run();
    ADD_FAILURE() << "it went on";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("board"));
    EXPECT_THAT(error.what(), HasSubstr("--ignore-failed-checks"));
  }
  EXPECT_THAT(console.said, Contains(HasSubstr("FAILED   board: not seen")));
  EXPECT_THAT(session.events(event_kind<CheckResult>), ::testing::SizeIs(2));
  EXPECT_THAT(session.screen.screens, IsEmpty());
  EXPECT_EQ(session.engine.state(), SessionState::paused);
}

TEST_F(FailedCheck, IsIgnoredWhereNoOneCanBeAskedIfSoRequested) {
  ignore_failed_checks = true;
  EXPECT_EQ(run(), RunEnd::finished);
  EXPECT_THAT(notes(),
              ElementsAre("failed check: board; without an experimenter the session continues"));
}

TEST_F(FailedCheck, IsMadeAgainUntilItSucceeds) {
  console.answer = ConsoleCommandKind::check;
  n_failures = 3;
  EXPECT_EQ(run(), RunEnd::finished);
  EXPECT_THAT(console.asked, ::testing::SizeIs(3));
  EXPECT_THAT(session.events(event_kind<CheckResult>), ::testing::SizeIs(8)) << "each is logged";
  EXPECT_THAT(notes(), IsEmpty());
}

TEST_F(FailedCheck, CanBeLeftByClosingTheWindow) {
  class Silent : public MadeUpConsole {
    bool ask_to_continue(const std::string&) override { return true; }
  } silent;
  Session other(quick_protocol(), [](const ViewFrame&, const ScreenState&) {
    return std::vector{touch(TouchKind::close)};
  });
  OutOfOrder pictures(other.pictures);
  RunnerOptions options;
  options.console = &silent;
  EXPECT_EQ(Runner({*other.protocol, other.engine, other.sink, pictures, *other.hand, other.screen,
                    other.clock, true, &other.texts},
                   options)
                .run(),
            RunEnd::stopped);
  EXPECT_THAT(other.screen.screens, IsEmpty());
}

TEST(Experimenter, VetoesATrialAndItComesAgain) {
  ScriptedConsole console({{ConsoleCommandKind::veto, "disturbance"}});
  Session session(quick_protocol());
  EXPECT_EQ(session.run(&console), RunEnd::finished);
  ASSERT_EQ(session.events(event_kind<TrialVoided>).size(), 1U);
  EXPECT_EQ(session.events(event_kind<TrialVoided>)[0].as<TrialVoided>()->reason,
            "veto: disturbance");
  EXPECT_EQ(session.engine.n_attempts(), 3);
  EXPECT_EQ(session.engine.n_completed(), 2);
}

Protocol comparing_protocol() {
  return testing::comparing_alone(quick_protocol());
}

TEST(Experimenter, TakesTheLastAnswerBackAndItsTrialComesAgain) {
  Session session(comparing_protocol());
  MadeUpConsole console;
  bool vetoed = false;
  console.on_show = [&](const ConsoleStatus& status) {
    if (vetoed || status.n_completed != 2 || !session.engine.trial_is_open()) return;
    vetoed = true;
    console.commands.push_back({ConsoleCommandKind::veto_answer, "tapped by mistake"});
    console.commands.push_back({ConsoleCommandKind::veto_answer, "once more"});
  };
  EXPECT_EQ(session.run(&console), RunEnd::finished);
  const auto events = session.events(event_kind<AnswerVetoed>);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].as<AnswerVetoed>()->reason, "tapped by mistake");
  EXPECT_THAT(console.said, Contains(HasSubstr("presented again")));
  EXPECT_THAT(console.said, Contains(HasSubstr("no answered trial")));
  EXPECT_EQ(session.engine.n_completed(), 3);
  EXPECT_EQ(session.engine.n_attempts(), 5) << "with the one that had begun, and the one again";
}

TEST(Person, WhoDeclinesByMistakeCanTakeItBack) {
  Protocol protocol = quick_protocol();
  protocol.screens.consent = true;
  bool declined = false;
  Session session(protocol, [&](const ViewFrame& picture, const ScreenState& screen) {
    if (screen.screen == Screen::consent && !std::exchange(declined, true))
      return std::vector{touch(TouchKind::decline)};
    return patient(picture, screen);
  });
  EXPECT_EQ(session.run(), RunEnd::finished);
  EXPECT_THAT(pages_of(session.sink),
              ElementsAre("consent", "declined", "consent", "welcome", "instructions_sorting",
                          "trial_sorting", "thanks"));
  const auto consents = session.events(event_kind<Consent>);
  ASSERT_EQ(consents.size(), 2U);
  EXPECT_FALSE(consents[0].as<Consent>()->agreed);
  EXPECT_TRUE(consents[1].as<Consent>()->agreed);
}

// The same session once more, after it was left.
RunEnd continue_session(Session& session, RecordedSession& sink) {
  std::vector<Event> events;
  for (const RecordedEntry& entry : session.sink.entries())
    if (const auto* recorded = std::get_if<RecordedEvent>(&entry))
      events.push_back(recorded->event);
  session.engine.apply({session.engine.last_s(), SessionResumed{}});
  SessionParts parts{*session.protocol, session.engine, sink, session.pictures, *session.hand,
                     session.screen,    session.clock,  true, &session.texts};
  parts.before = resume_state(events, session.sink.header().participant_info);
  session.screen.screens.clear();
  return Runner(parts, {}).run();
}

TEST(Person, WhoComesBackMeetsNoPageAgainThatTheyWereThroughWith) {
  Protocol protocol = every_page_protocol();
  bool closes = true;
  const auto person = [&](const ViewFrame& picture, const ScreenState& screen) {
    if (screen.screen != Screen::about_you || !closes) return patient(picture, screen);
    closes = false;
    Touch age = touch(TouchKind::entry);
    age.key = "age";
    age.value = "25_34";
    return std::vector{age, touch(TouchKind::close)};
  };
  Session session(protocol, person);
  EXPECT_EQ(session.run(), RunEnd::stopped);
  EXPECT_THAT(pages_of(session.sink), ElementsAre("consent", "welcome", "about_you"));

  RecordedSession sink{SessionHeader{}};
  EXPECT_EQ(continue_session(session, sink), RunEnd::finished);
  EXPECT_EQ(pages_of(sink).at(0), "about_you");
  EXPECT_EQ(pages_of(sink).at(1), "demonstration");
  EXPECT_THAT(session.screen.screens.at(0).entries, ElementsAre(std::pair("age", "25_34")));
}

TEST(Person, WhoComesBackInTheMiddleOfABlockIsNotInstructedAgain) {
  Protocol protocol = comparing_protocol();
  auto second = *block_as<Comparison::Block>(protocol.blocks.front());
  second.name = "again";
  protocol.blocks.push_back(second);
  const Session* running = nullptr;
  bool closes = true;
  Session session(protocol, [&](const ViewFrame& picture, const ScreenState& screen) {
    if (running->engine.n_completed() < 2 || !std::exchange(closes, false))
      return patient(picture, screen);
    return std::vector{touch(TouchKind::close)};
  });
  running = &session;
  EXPECT_EQ(session.run(), RunEnd::stopped);
  RecordedSession sink{SessionHeader{}};
  EXPECT_EQ(continue_session(session, sink), RunEnd::finished);
  EXPECT_THAT(pages_of(sink), ElementsAre("trial_comparison", "instructions_comparison",
                                          "trial_comparison", "thanks"))
      << "of the next block they are";
}

TEST(Person, WhoLeavesAfterPracticeReadsAgainThatItHasEnded) {
  Protocol protocol = quick_protocol();
  protocol.blocks = {practiced_sorting("one")};
  bool closes = true;
  Session session(protocol, [&](const ViewFrame& picture, const ScreenState& screen) {
    if (screen.task != "after_practice" || !std::exchange(closes, false))
      return patient(picture, screen);
    return std::vector{touch(TouchKind::close)};
  });
  EXPECT_EQ(session.run(), RunEnd::stopped);
  EXPECT_EQ(session.engine.n_completed(), 2);
  RecordedSession sink{SessionHeader{}};
  EXPECT_EQ(continue_session(session, sink), RunEnd::finished);
  EXPECT_THAT(pages_of(sink),
              ElementsAre("instructions_after_practice", "trial_sorting", "thanks"));
}

TEST(Person, ReadsInstructionsAgainThatTheyWereInTheMiddleOf) {
  bool closes = true;
  Session session(comparing_protocol(), [&](const ViewFrame& picture, const ScreenState& screen) {
    if (screen.screen != Screen::instructions || !std::exchange(closes, false))
      return patient(picture, screen);
    return std::vector{touch(TouchKind::close)};
  });
  EXPECT_EQ(session.run(), RunEnd::stopped);
  RecordedSession sink{SessionHeader{}};
  EXPECT_EQ(continue_session(session, sink), RunEnd::finished);
  EXPECT_THAT(pages_of(sink), Contains("instructions_comparison"));
}

TEST(ResumeState, WhatAnotherPageCoveredForAWhileOrABreakOffEndedWasNotTurned) {
  const auto shown = [](const std::string& page) { return Event{0, TextShown{page, "en", ""}}; };
  for (const char* cover : {"paused", "setting_up"})
    EXPECT_THAT(resume_state({shown("welcome"), shown(cover)}, {}).pages, IsEmpty()) << cover;
  EXPECT_THAT(resume_state({shown("welcome"), Event{0, SessionResumed{}}, shown("rest")}, {}).pages,
              IsEmpty());
  EXPECT_THAT(resume_state({shown("welcome"), shown("rest")}, {}).pages, ElementsAre("welcome"));
}

TEST(ResumeState, ABreakIsOverWhenItWasTakenOrTheTrialIsThere) {
  const auto shown = [](const std::string& page) { return Event{0, TextShown{page, "en", ""}}; };
  const Event taken{0, BreakTaken{"asked for", 3}};
  EXPECT_TRUE(resume_state({shown("rest"), shown("paused"), {0, SessionResumed{}}}, {}).in_break);
  EXPECT_FALSE(resume_state({shown("rest"), taken}, {}).in_break);
  EXPECT_FALSE(resume_state({shown("rest"), shown("trial_sorting")}, {}).in_break);
}

TEST(Experimenter, NotesTakesABreakAndEnds) {
  ScriptedConsole console({{ConsoleCommandKind::note, "door slammed"},
                           {ConsoleCommandKind::rest, {}},
                           {ConsoleCommandKind::end, {}}});
  Session session(quick_protocol());
  EXPECT_EQ(session.run(&console), RunEnd::stopped);
  EXPECT_EQ(session.events(event_kind<Note>).at(0).as<Note>()->text, "door slammed");
  EXPECT_EQ(session.engine.state(), SessionState::paused);
}

TEST(Experimenter, GetsTheBreakThatWasAskedFor) {
  ScriptedConsole console({{ConsoleCommandKind::rest, {}}});
  Session session(quick_protocol());
  EXPECT_EQ(session.run(&console), RunEnd::finished);
  EXPECT_EQ(session.events(event_kind<BreakTaken>).at(0).as<BreakTaken>()->name, "asked for");
}

TEST(Person, WhoComesBackTakesTheBreakThatWasAskedForAndNotEnded) {
  ScriptedConsole console({{ConsoleCommandKind::rest, {}}});
  bool closes = true;
  Session session(quick_protocol(), [&](const ViewFrame& picture, const ScreenState& screen) {
    if (screen.screen != Screen::rest || !std::exchange(closes, false))
      return patient(picture, screen);
    return std::vector{touch(TouchKind::close)};
  });
  EXPECT_EQ(session.run(&console), RunEnd::stopped);
  EXPECT_THAT(session.events(event_kind<BreakTaken>), IsEmpty());
  RecordedSession sink{SessionHeader{}};
  EXPECT_EQ(continue_session(session, sink), RunEnd::finished);
  EXPECT_THAT(pages_of(sink), ElementsAre("rest", "trial_sorting", "thanks"));
  EXPECT_EQ(testing::events_of(sink, event_kind<BreakTaken>).at(0).as<BreakTaken>()->name,
            "asked for");
}

TEST(Experimenter, IsBlindUntilTheyUnblindThemselves) {
  ScriptedConsole console({{ConsoleCommandKind::unblind, {}}});
  Session session(quick_protocol());
  session.run(&console);
  EXPECT_EQ(session.events(event_kind<Unblinding>).size(), 1U);
  EXPECT_FALSE(console.shown.front().plan);
  bool saw_plan = false;
  for (const ConsoleStatus& status : console.shown) saw_plan = saw_plan || status.plan.has_value();
  EXPECT_TRUE(saw_plan);

  MadeUpConsole blind;
  Session other(quick_protocol());
  other.run(&blind);
  for (const ConsoleStatus& status : blind.shown) EXPECT_FALSE(status.plan);
}

}  // namespace
}  // namespace heft
