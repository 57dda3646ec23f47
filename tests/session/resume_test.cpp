// Sessions that are resumed with a changed configuration, and logs that may not be resumed.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <atomic>
#include <optional>

#include "SourceFolder.h"
#include "analysis/dataset/Dataset.h"
#include "base/files/TextFile.h"
#include "experiment/ScreenTexts.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"
#include "replay/Replay.h"
#include "session/MadeUpPeople.h"
#include "session/Session.h"

namespace heft {
namespace {

using ::testing::HasSubstr;
using testing::MadeUpScreen;
using testing::patient;

SessionOptions a_model(const std::string& name) {
  SessionOptions given;
  given.responder = Plug{name};
  given.view = Plug{"headless"};
  return given;
}

class Resumed : public ::testing::Test {
 protected:
  RunnerOptions until(int n_trials) {
    RunnerOptions runner;
    stop = false;
    runner.stop = &stop;
    runner.progress = [this, n_trials](const Engine& engine) {
      stop = engine.n_completed() >= n_trials;
    };
    return runner;
  }
  void start() { ASSERT_EQ(start_session(request, until(2)).end, RunEnd::stopped); }

  // Starts a person's session at a simulated window; the person leaves after two trials.
  void start_as_a_person(const std::string& asked = "") {
    SessionOptions person;
    person.tracker = Plug{"hand"};
    person.language = folder.file("texts.toml");
    const std::string words = read_text_file(source_folder() + "/protocols/texts/en.toml");
    replace_text_file(*person.language, words + asked);
    request.config = resolve(person, protocol, seed);
    SessionHeader header;
    header.participant = request.participant;
    header.protocol_name = protocol.name;
    header.protocol_text = protocol.text;
    header.protocol_sha256 = protocol.sha256;
    header.seed = seed;
    header.started_utc = "2026-01-01T00:00:00.000Z";
    header.responder = "human";
    Engine engine(request.config->protocol, seed);
    const Event told{0, request.config->config};
    SessionLog log = SessionLog::start(request.db, header, RecordedEvent{told, engine.apply(told)});
    SessionClock clock = SessionClock::wall_from(0);
    const auto hand = request.config->model.responder(seed);
    HandPictures pictures(*hand, protocol.display_rate_hz);
    MadeUpScreen screen(patient);
    Runner runner({*request.config->protocol, engine, log, pictures, *hand, screen, clock, true,
                   &request.config->texts},
                  until(2));
    ASSERT_EQ(runner.run(), RunEnd::stopped);
    log.flush();
  }

  static ResolvedConfig resolved(const LoggedSession& session, const SessionOptions& again) {
    return resolve(again, session.setup, *session.protocol, session.row.header.seed);
  }
  SessionResult continue_with(const SessionOptions& again, int n_trials) {
    const LoggedSession session = session_to_resume(request.db, std::nullopt);
    return resume_session(session, resolved(session, again), until(n_trials));
  }

  // The responders that answered the trials, in order, without repetitions in a row.
  std::vector<std::string> responders() const {
    const LogReader reader(request.db);
    const LoggedSession session = load_session(reader, request.db, 1);
    std::vector<std::string> names;
    for (const TrialRow& trial : reader.trials(1))
      if (const std::string name = to_text(session.setup_of(trial).responder);
          trial.status == TrialStatus::completed && (names.empty() || names.back() != name))
        names.push_back(name);
    return names;
  }
  void expect_verified() const {
    const Verification found = verify_session(LogReader(request.db), 1, [](double) {});
    EXPECT_FALSE(found.first) << found.first->what << ", logged " << found.first->logged
                              << ", came out " << found.first->replayed;
    EXPECT_GT(found.n_frames, 0);
    EXPECT_TRUE(found.ended);
  }
  SessionData analysed() const {
    std::optional<SessionData> first;
    LoggedSessions({request.db}, {}).each([&](const SessionData& data) {
      if (!first) first = data;
    });
    return first.value();
  }
  void change(const std::string& sql) const {
    SQLite::Database(request.db, SQLite::OPEN_READWRITE).exec(sql);
  }

  static constexpr std::uint64_t seed = 3;
  const test::TemporaryFolder folder;
  const Protocol protocol = load_protocol(source_folder() + "/protocols/quick.toml");
  SessionRequest request{resolve(a_model("simulated"), protocol, seed), "1", folder.file("log.db")};
  std::atomic<bool> stop = false;
};

// The questionnaire's text as it was read when the session began.
constexpr const char* questionnaire = R"([questionnaire.effort]
title = "Effort"
[[questionnaire.effort.question]]
key = "effort"
kind = "slider"
text = "How hard was it?"
low = "Easy"
high = "Hard"
)";

TEST_F(Resumed, AModelThatContinuesAPersonsSessionIsNotTakenForAPerson) {
  start_as_a_person();
  EXPECT_FALSE(analysed().simulated());
  EXPECT_EQ(continue_with(a_model("simulated"), 1000).end, RunEnd::finished);
  expect_verified();
  EXPECT_THAT(responders(), ::testing::ElementsAre("human", "simulated"));
  EXPECT_TRUE(analysed().simulated());
  EXPECT_EQ(analysed().participant(), "1 (simulated)");
}

TEST_F(Resumed, WhatPeopleReadStaysWithItsQuestionnairesWhateverElseChanges) {
  start_as_a_person(questionnaire);
  SessionOptions display, board, words;
  display.display = NamedDisplay{1};
  board.board_file = source_folder() + "/protocols/apparatus/board_letter.toml";
  words.language = source_folder() + "/protocols/texts/fr.toml";
  const LoggedSession session = session_to_resume(request.db, std::nullopt);
  for (const SessionOptions& given : {display, board}) {
    const SessionConfig config = resolved(session, given)->config;
    EXPECT_EQ(config.texts, request.config->config.texts);
    EXPECT_THAT(config.texts.text, HasSubstr("[questionnaire.effort]"));
  }
  EXPECT_EQ(resolved(session, words)->config.language, "fr") << "but for words that are given";
}

TEST_F(Resumed, OneModelFollowsTheOther) {
  start();
  ASSERT_EQ(continue_with(a_model("coin"), 4).end, RunEnd::stopped);
  EXPECT_EQ(continue_with(a_model("simulated"), 1000).end, RunEnd::finished);
  expect_verified();
  EXPECT_THAT(responders(), ::testing::ElementsAre("simulated", "coin", "simulated"));
  EXPECT_TRUE(analysed().simulated());
}

TEST_F(Resumed, AnotherSimulatorIsInForceFromThereOn) {
  start();
  SessionOptions given;
  given.simulator = "bullet-ea";
  EXPECT_EQ(continue_with(given, 1000).end, RunEnd::finished);
  expect_verified();
  const auto setups = LogReader(request.db).setups(1);
  ASSERT_EQ(setups.size(), 2U);
  EXPECT_EQ(setups[0].setup.simulator, request.config->config.simulator);
  EXPECT_EQ(setups[1].setup.simulator, "bullet-ea");
  EXPECT_EQ(changes_between(setups[0].setup, setups[1].setup).front().column, "simulator");
}

TEST_F(Resumed, WhatIsGivenAgainUnchangedIsNotLoggedAgain) {
  start();
  SessionOptions given = a_model("simulated");
  given.simulator = request.config->config.simulator;
  EXPECT_EQ(continue_with(given, 1000).end, RunEnd::finished);
  EXPECT_EQ(LogReader(request.db).setups(1).size(), 1U);
  expect_verified();
}

// After a crash right after the start, the log must have the configuration.
TEST_F(Resumed, TheFirstSetupIsInTheFileAsSoonAsTheSession) {
  Engine engine(request.config->protocol, seed);
  const Event told{0, request.config->config};
  SessionHeader header;
  header.protocol_text = protocol.text;
  header.protocol_name = protocol.name;
  const SessionLog log =
      SessionLog::start(request.db, header, RecordedEvent{told, engine.apply(told)});
  EXPECT_EQ(load_session(LogReader(request.db), request.db, 1).setup, request.config->config);
  EXPECT_EQ(LogReader(request.db).first_broken_digest(1), std::nullopt);
}

TEST_F(Resumed, ASessionWithoutATrialSaysWhatItIsRunWith) {
  ASSERT_EQ(start_session(request, until(0)).end, RunEnd::stopped);
  EXPECT_EQ(load_session(LogReader(request.db), request.db, 1).setup, request.config->config);
  EXPECT_EQ(continue_with({}, 1000).end, RunEnd::finished);
  expect_verified();
}

// Another program locks the database when the last event has been written.
TEST_F(Resumed, FinishedSessionInALockedLogIsSealedAndOneThatWasLeftIsByTheNext) {
  std::optional<SQLite::Database> other;
  const auto run_until_locked = [&](RunnerOptions runner, SessionState locked_in) {
    runner.progress = [&other, locked_in, this, before = runner.progress](const Engine& engine) {
      if (before) before(engine);
      if (engine.state() != locked_in) return;
      other.emplace(request.db, SQLite::OPEN_READWRITE);
      other->exec("BEGIN IMMEDIATE");
    };
    SessionResult result = start_session(request, runner);
    other.reset();
    EXPECT_EQ(LogReader(request.db).session(1).state, locked_in);
    return result;
  };
  const SessionResult finished = run_until_locked({}, SessionState::finished);
  EXPECT_EQ(finished.end, RunEnd::finished);
  EXPECT_EQ(finished.head, LogReader(request.db).head());
  EXPECT_NE(finished.head, "");
  std::filesystem::remove(request.db);
  EXPECT_EQ(run_until_locked(until(2), SessionState::paused).head, "");
  EXPECT_TRUE(LogReader(request.db).seals().empty());
  request.participant = "another";
  EXPECT_NE(start_session(request, {}).head, "");
  EXPECT_EQ(LogReader(request.db).seals().front().session_id, 1);
  EXPECT_EQ(fault_of_structure(LogReader(request.db)), std::nullopt);
}

TEST_F(Resumed, IsNoLogThatIsNotAsItWasWritten) {
  for (const char* sql : {"UPDATE session SET run_options = '{}'", "CREATE TABLE loot (text TEXT)",
                          "CREATE VIEW loot AS SELECT 1 AS one",
                          "CREATE TRIGGER loot AFTER INSERT ON event BEGIN DELETE FROM answer; END",
                          "DELETE FROM event WHERE event_id = (SELECT max(event_id) FROM event)"}) {
    std::filesystem::remove(request.db);
    start();
    change(sql);
    const std::size_t n_events = LogReader(request.db).events(1).size();
    try {
      continue_with({}, 1000);
      ADD_FAILURE() << "it went on after " << sql;
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), ExitCode::diverged) << sql;
      EXPECT_THAT(error.what(), HasSubstr("the log was changed")) << sql;
      if (std::string_view(sql).starts_with("CREATE")) {
        EXPECT_THAT(error.what(), HasSubstr("loot"));
      }
    }
    EXPECT_EQ(LogReader(request.db).events(1).size(), n_events) << sql;
  }
}

}  // namespace
}  // namespace heft
