// Another process locks the database during answers, vetoes and pauses of a person's session: what
// is logged folds again, nothing is lost, and the screen acknowledges only what is on disk. The
// seed of a failure is printed.
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "SourceFolder.h"
#include "base/Error.h"
#include "base/Random.h"
#include "protocol/readers/Files.h"
#include "session/MadeUpPeople.h"
#include "session/Protocols.h"
#include "session/Recorded.h"
#include "session/Runner.h"
#include "session/TappedScreen.h"
#include "tasks/Offers.h"

namespace heft {
namespace {

using ::testing::Contains;
using testing::events_of;
using ::testing::HasSubstr;
using testing::made_up_s;
using testing::MadeUpConsole;
using testing::touch;

// Keeps events while the database is locked, as SessionLog does.
class BusySink final : public EventSink {
 public:
  BusySink(std::shared_ptr<const Protocol> protocol, RecordedSession& disk)
      : disk_(disk), on_disk_(std::move(protocol), 7) {}

  void append(const Event& event, const Changes& changes, Durability durability) override {
    if (const auto* contact = event.as<CubeTouch>()) is_touching = !contact->ended_after_s;
    waiting_.push_back({event, changes});
    // Buffered events become due, too.
    if (durability == Durability::acknowledged || locks_buffered) write(event);
  }
  void add_frame(const FrameRow&) override {}
  void add_info(const std::string& key, const std::string& value) override {
    waiting_info_[key] = value;
    write({0, Note{}});
  }
  void flush() override { write({0, Note{}}); }

  /// Discards what a killed process loses.
  void forget_waiting() {
    waiting_.clear();
    waiting_info_.clear();
  }

  /// The state that a resume would find.
  const Engine& on_disk() const { return on_disk_; }

  /// Asked at each attempt to write; `event` is the newest.
  std::function<bool(const Event& event)> is_locked = [](const Event&) { return false; };
  bool locks_buffered = false;
  bool is_touching = false;  ///< the newest contact is not over

 private:
  void write(const Event& event) {
    if (is_locked(event)) throw LogBusy("locked");
    for (const RecordedEvent& recorded : std::exchange(waiting_, {})) {
      on_disk_.apply(recorded.event);  // refused: what was applied is not what can be resumed
      disk_.append(recorded.event, recorded.changes, Durability::acknowledged);
    }
    for (const auto& [key, value] : std::exchange(waiting_info_, {})) disk_.add_info(key, value);
  }

  RecordedSession& disk_;
  Engine on_disk_;
  std::vector<RecordedEvent> waiting_;
  std::map<std::string, std::string> waiting_info_;
};

// A screen with simulated time. What it displays must be on disk.
class WatchedScreen final : public ArView {
 public:
  using Person = std::function<std::vector<Touch>(const ViewFrame&, const ScreenState&)>;
  WatchedScreen(const BusySink& sink, Person person) : sink_(sink), person_(std::move(person)) {}

  std::optional<double> present(const ViewFrame& picture, const ScreenState& screen) override {
    picture_ = picture;
    screen_ = screen;
    is_new_ = true;
    const Engine& disk = sink_.on_disk();
    if (screen.screen == Screen::trial) {
      const ScreenState saved = disk.screen();
      EXPECT_EQ(screen.trial_number, saved.trial_number);
      EXPECT_EQ(screen.attempt, saved.attempt);
      EXPECT_EQ(screen.n_choices, saved.n_choices) << "an answer is shown that is not on disk";
      EXPECT_EQ(labels_on(screen), labels_on(saved));
    }
    if (screen.screen == Screen::thanks) {
      EXPECT_EQ(disk.state(), SessionState::finished);
    }
    return made_up_s += 0.004;
  }
  std::vector<Touch> wait(double seconds) override {
    made_up_s += std::max(seconds, 1e-3);
    if (!is_new_) return {};  // it was answered
    std::vector<Touch> touches = person_(picture_, screen_);
    is_new_ = touches.empty();
    for (Touch& touch : touches) {
      touch.monotonic_s = made_up_s;
      touch.page = screen_.page();
      n_actions += touch.kind == TouchKind::action ? 1 : 0;
    }
    return touches;
  }

  std::size_t n_actions = 0;

 private:
  const BusySink& sink_;
  Person person_;
  ViewFrame picture_;
  ScreenState screen_;
  bool is_new_ = false;
};

// Two sorting trials, three comparisons.
constexpr int n_trials_to_complete = 5;
Protocol sorting_and_comparing() {
  Protocol protocol = testing::quick_protocol();
  protocol.display_rate_hz = 15;
  protocol.blocks.push_back(testing::short_comparison(3));
  return protocol;
}

struct BusySession {
  explicit BusySession(Protocol made = sorting_and_comparing())
      : protocol(testing::shared(std::move(made))) {}

  RunEnd run() {
    RunnerOptions options;
    options.console = &console;
    WatchedScreen screen(sink, person);
    const auto hand = responder_named("simulated").make({});
    HandPictures pictures{*hand, protocol->display_rate_hz};
    SessionClock clock = SessionClock::wall_from(engine.last_s(), testing::made_up_monotonic);
    const RunEnd end =
        Runner({*protocol, engine, sink, pictures, *hand, screen, clock, true, &texts}, options)
            .run();
    n_actions = screen.n_actions;
    return end;
  }

  // Resumes what is on disk, as a new process does. @return false: the session has ended
  bool resume() {
    Engine resumed(protocol, 7);
    for (const RecordedEvent& recorded : recorded_events()) resumed.apply(recorded.event);
    const bool continues = resumed.next().kind != Next::Kind::over;
    if (resumed.trial_is_open())
      add(resumed, {resumed.last_s(), TrialVoided{std::string(void_interrupted)}});
    if (continues) add(resumed, {resumed.last_s(), SessionResumed{"", 0}});
    engine = std::move(resumed);
    return continues;
  }
  void add(Engine& resumed, const Event& event) {
    const Changes changes = resumed.apply(event);
    sink.append(event, changes, Durability::acknowledged);
  }

  std::vector<RecordedEvent> recorded_events() const {
    std::vector<RecordedEvent> events;
    for (const RecordedEntry& entry : disk.entries()) events.push_back(std::get<0>(entry));
    return events;
  }

  // Folds each event again: its changes must equal those that were written with it.
  void expect_to_fold_again() const {
    Engine again(protocol, 7);
    for (const auto& [event, written] : recorded_events()) {
      const Changes changes = again.apply(event);
      EXPECT_EQ(changes.attempt_index, written.attempt_index);
      EXPECT_EQ(changes.state, written.state);
      EXPECT_EQ(changes.answers.size(), written.answers.size());
      EXPECT_EQ(changes.reversals.size(), written.reversals.size());
      EXPECT_EQ(changes.estimates.size(), written.estimates.size());
      ASSERT_EQ(changes.trial.has_value(), written.trial.has_value());
      if (!changes.trial) continue;
      EXPECT_EQ(changes.trial->status, written.trial->status);
      EXPECT_EQ(changes.trial->outcome, written.trial->outcome);
      EXPECT_EQ(changes.trial->plan.trial_number, written.trial->plan.trial_number);
      EXPECT_EQ(changes.trial->paused_s, written.trial->paused_s);
    }
    EXPECT_EQ(again.n_completed(), engine.n_completed());
    EXPECT_EQ(again.state(), engine.state());
  }

  std::shared_ptr<const Protocol> protocol;
  // Answers while a cube is touched.
  WatchedScreen::Person person = [this](const ViewFrame& picture, const ScreenState& screen) {
    const bool waits = screen.screen == Screen::trial && !sink.is_touching;
    return waits ? std::vector<Touch>{} : testing::patient(picture, screen);
  };
  Engine engine{protocol, 7};
  RecordedSession disk{SessionHeader{}};
  BusySink sink{protocol, disk};
  MadeUpConsole console;
  ScreenTexts texts = load_texts(source_folder() + "/protocols/texts/fr.toml");
  std::size_t n_actions = 0;
};

template <typename Payload>
std::size_t n_of(const BusySession& session) {
  return events_of(session.disk, event_kind<Payload>).size();
}

bool is_about_the_lock(const ConsoleStatus& status) {
  return status.trouble.find("locked") != std::string::npos;
}

// Locks the database for a while, from the first contact that an answer ends, or else from the
// answer.
struct LockDuringAnAnswer {
  LockDuringAnAnswer(BusySession& session, bool from_contact) {
    session.sink.locks_buffered = true;
    session.sink.is_locked = [this, from_contact](const Event& event) {
      const auto* contact = event.as<CubeTouch>();
      const bool ends = contact && contact->ended_after_s;
      if (n_left_ < 0 && (from_contact ? ends : event.is<Action>())) n_left_ = 20;
      return n_left_ > 0 && n_left_-- > 0;
    };
  }
  int n_left_ = -1;
};

class AnswerInALockedDatabase : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(From, AnswerInALockedDatabase, ::testing::Bool(), [](const auto& from) {
  return from.param ? "its_last_contact" : "itself";
});

TEST_P(AnswerInALockedDatabase, IsKeptAndTheSessionPausesAndSaysSo) {
  BusySession session;
  const LockDuringAnAnswer lock(session, GetParam());
  EXPECT_EQ(session.run(), RunEnd::finished);
  EXPECT_EQ(lock.n_left_, 0) << "it was never locked";
  session.expect_to_fold_again();
  ASSERT_EQ(n_of<SessionPaused>(session), 1U);
  EXPECT_EQ(events_of(session.disk, event_kind<SessionPaused>)[0].as<SessionPaused>()->reason,
            "database locked by another process");
  EXPECT_EQ(n_of<SessionContinued>(session), 1U);
  EXPECT_EQ(n_of<Action>(session) + n_of<ActionRefused>(session), session.n_actions);
  EXPECT_THAT(session.console.said,
              Contains(HasSubstr("Database locked by another process; retrying.")));
  EXPECT_TRUE(std::ranges::any_of(session.console.shown, [](const ConsoleStatus& status) {
    return is_about_the_lock(status) && status.paused_itself;
  }));
}

TEST_P(AnswerInALockedDatabase, CanBeVetoedMeanwhile) {
  for (const auto veto : {ConsoleCommandKind::veto, ConsoleCommandKind::veto_answer}) {
    BusySession session;
    const LockDuringAnAnswer lock(session, GetParam());
    bool vetoed = false;
    session.console.on_show = [&](const ConsoleStatus& status) {
      if (is_about_the_lock(status) && !std::exchange(vetoed, true))
        session.console.commands.push_back({veto, "disturbance"});
    };
    EXPECT_EQ(session.run(), RunEnd::finished);
    EXPECT_TRUE(vetoed);
    session.expect_to_fold_again();
    EXPECT_EQ(session.engine.n_completed(), n_trials_to_complete);
  }
}

// The first failing write is a periodic one; the screen still shows the trial, and is touched.
TEST(LockedDatabase, TakesAnAnswerFromBeforeThePauseAfterItUnlessItsTrialIsOver) {
  for (const bool is_vetoed : {false, true}) {
    BusySession session;
    int n_left = -1;
    session.sink.is_locked = [&](const Event& event) {
      if (n_left < 0 && event.is<Note>() && session.sink.is_touching) n_left = 20;
      return n_left > 0 && n_left-- > 0;
    };
    session.person = [&](const ViewFrame& picture, const ScreenState& screen) {
      const bool waits = screen.screen == Screen::trial && n_left < 0;
      return waits ? std::vector<Touch>{} : testing::patient(picture, screen);
    };
    bool vetoed = !is_vetoed;
    session.console.on_show = [&](const ConsoleStatus& status) {
      if (is_about_the_lock(status) && !std::exchange(vetoed, true))
        session.console.commands.push_back({ConsoleCommandKind::veto, "disturbance"});
    };
    EXPECT_EQ(session.run(), RunEnd::finished);
    EXPECT_EQ(n_left, 0) << "it was never locked";
    session.expect_to_fold_again();
    EXPECT_EQ(n_of<Action>(session) + n_of<ActionRefused>(session), session.n_actions);
    EXPECT_EQ(n_of<ActionRefused>(session), is_vetoed ? 3U : 0U) << "three labels";
  }
}

TEST(LockedDatabase, CanBeHeldByTheExperimenterUntilAfterTheLock) {
  BusySession session;
  const LockDuringAnAnswer lock(session, false);
  int n_held = 0;
  session.console.on_show = [&](const ConsoleStatus& status) {
    if (is_about_the_lock(status) && n_held == 0) {
      session.console.commands.push_back({ConsoleCommandKind::pause, {}});
      ++n_held;
    } else if (n_held > 0 && status.paused && !status.paused_itself && ++n_held == 60) {
      session.console.commands.push_back({ConsoleCommandKind::proceed, {}});
    }
  };
  EXPECT_EQ(session.run(), RunEnd::finished);
  EXPECT_GE(n_held, 60) << "longer than the lock";
  EXPECT_EQ(n_of<SessionContinued>(session), 1U);
  session.expect_to_fold_again();
}

TEST(LockedDatabase, NeverReportsAsDoneWhatIsNotSaved) {
  BusySession session;
  const LockDuringAnAnswer lock(session, false);
  bool noted = false;
  session.console.on_show = [&](const ConsoleStatus& status) {
    if (is_about_the_lock(status) && !std::exchange(noted, true))
      session.console.commands.push_back({ConsoleCommandKind::note, "while it was locked"});
  };
  EXPECT_EQ(session.run(), RunEnd::finished);
  EXPECT_THAT(session.console.said, Contains("noted; not saved yet"));
  EXPECT_EQ(n_of<Note>(session), 1U);
}

struct Killed {};

// A participant who answers at random times, an experimenter who intervenes at random times, more
// often while the database is locked, and a process that may be killed meanwhile.
class RandomMoments {
 public:
  RandomMoments(BusySession& session, std::uint64_t seed)
      : session_(session), random_(seed, "busy") {
    session.sink.locks_buffered = random_.coin(0.5);
    session.sink.is_locked = [this](const Event&) { return locks(); };
    session.person = [this](const ViewFrame& picture, const ScreenState& screen) {
      if (locked_left_ > 0 && may_kill_ && random_.coin(0.02)) throw Killed{};
      const bool waits = screen.screen == Screen::trial && !session_.sink.is_touching;
      return random_.coin(waits ? 0.003 : 0.1) ? answer(picture, screen) : std::vector<Touch>{};
    };
    session.console.on_show = [this](const ConsoleStatus& status) { intervene(status); };
  }

  void never_kill_again() { may_kill_ = false; }
  int n_locked = 0;

 private:
  bool locks() {
    if (locked_left_ == 0 && random_.coin(0.02)) {
      locked_left_ = 1 + static_cast<int>(random_.below(30));
      ++n_locked;
    }
    return locked_left_ > 0 && locked_left_-- > 0;
  }
  std::vector<Touch> answer(const ViewFrame& picture, const ScreenState& screen) {
    std::vector<Touch> touches = testing::patient(picture, screen);
    if (screen.screen == Screen::trial && screen.task == "comparison" && !touches.empty() &&
        random_.coin(0.5))
      return {touch("select", 1 + static_cast<int>(random_.below(2)))};
    return touches;
  }
  void intervene(const ConsoleStatus& status) {
    auto& commands = session_.console.commands;
    if (status.paused && !status.paused_itself && random_.coin(0.3))
      return commands.push_back({ConsoleCommandKind::proceed, {}});
    if (n_interventions_ >= 8 || !random_.coin(is_about_the_lock(status) ? 0.1 : 0.003)) return;
    ++n_interventions_;
    constexpr std::array kinds{ConsoleCommandKind::veto, ConsoleCommandKind::veto_answer,
                               ConsoleCommandKind::pause, ConsoleCommandKind::note,
                               ConsoleCommandKind::rest};
    commands.push_back({kinds[random_.below(kinds.size())], "made up"});
  }

  BusySession& session_;
  RandomStream random_;
  int locked_left_ = 0, n_interventions_ = 0;
  bool may_kill_ = true;
};

TEST(LockedDatabase, At200RandomMomentsLeavesALogThatResumes) {
  int n_locked = 0, n_killed = 0;
  std::size_t n_vetoed = 0;
  for (std::uint64_t seed = 1; n_locked < 200 || seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    BusySession session;
    RandomMoments moments(session, seed);
    RunEnd end = RunEnd::stopped;
    for (int n_runs = 0; end != RunEnd::finished && n_runs < 200; ++n_runs) {
      if (n_runs == 10) moments.never_kill_again();
      try {
        end = n_runs > 0 && !session.resume() ? RunEnd::finished : session.run();
      } catch (const Killed&) {
        ++n_killed;
        session.sink.forget_waiting();
      } catch (const LogBusy&) {  // while it resumed
        session.sink.forget_waiting();
      }
    }
    ASSERT_EQ(end, RunEnd::finished);
    EXPECT_EQ(session.engine.n_completed(), n_trials_to_complete);
    session.expect_to_fold_again();
    n_locked += moments.n_locked;
    n_vetoed += n_of<TrialVoided>(session) + n_of<AnswerVetoed>(session);
    if (HasFailure()) return;
  }
  EXPECT_GT(n_killed, 10);
  EXPECT_GT(n_vetoed, 20U);
}

}  // namespace
}  // namespace heft
