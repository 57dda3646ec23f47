// From a log to a Dataset: joined rows, participants, purposes, and a real file read back.
#include "analysis/dataset/Dataset.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "Figures.h"
#include "MadeUpSessions.h"
#include "SourceFolder.h"
#include "analysis/Analysis.h"
#include "base/Error.h"
#include "base/files/TextFile.h"
#include "record/writer/SessionLog.h"

namespace heft {
namespace {

using namespace made_up;
using testing::ElementsAre;
using testing::HasSubstr;

class LogFile : public testing::Test {
 protected:
  LogFile() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        std::filesystem::temp_directory_path() / (std::string("heft_dataset_test_") + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~LogFile() override { std::filesystem::remove_all(folder_); }

  std::string path() const { return (folder_ / "log.db").string(); }

  /// A finished session with one sorting trial, in which light and intermediate are exchanged.
  void write_session(const std::string& participant, Purpose purpose,
                     const std::string& protocol_text = "") {
    SessionHeader header = session(0, participant, purpose).session.header;
    header.protocol_text = protocol_text;
    header.heft_version = "0.1.0";
    header.run_options = "{}";
    header.started_utc = "2026-01-01T00:00:00.000Z";
    SessionLog log = SessionLog::start(path(), header);
    Changes started;
    started.attempt_index = 1;
    TrialRow trial;
    trial.plan.task = "sorting";
    trial.attempt_index = 1;
    trial.plan.trial_number = 1;
    trial.plan.condition = "C2";
    trial.plan.masses_g = {800, 15, 200};
    started.trial = trial;
    log.append({0, TrialStarted{}}, started, Durability::acknowledged);
    Changes validated = started;
    validated.trial->status = TrialStatus::completed;
    validated.trial->outcome = "incorrect";
    validated.answers = {label(1, "heaviest"), label(2, "intermediate"), label(3, "lightest")};
    for (AnswerRow& answer : validated.answers) answer.attempt_index = 1;
    validated.state = SessionState::finished;
    log.append({9, Action{"validate"}}, validated, Durability::acknowledged);
  }

 private:
  std::filesystem::path folder_;
};

TEST(Dataset, JoinsTheRowsOfAnAttempt) {
  SessionRows rows;
  for (int index : {1, 2}) {
    TrialRow trial;
    trial.attempt_index = index;
    rows.trials.push_back(trial);
    for (int slot : {2, 1}) rows.cubes.push_back({index, slot, 100.0 * index + slot, 0, 0, {}, {}});
  }
  rows.answers.push_back({2, 1, "validate", {}, {}});
  rows.answers.push_back({7, 1, "validate", {}, {}});  // of no attempt
  rows.reversals.push_back({2, "15g", 1, 100, 50, 50});
  const SessionData data = join_rows({}, rows);
  ASSERT_EQ(data.attempts.size(), 2);
  EXPECT_THAT(data.attempts[1].masses_g(), ElementsAre(201, 202));
  EXPECT_EQ(data.attempts[0].answers.size(), 0);
  EXPECT_EQ(data.attempts[1].answers.size(), 1);
  EXPECT_FALSE(data.attempts[0].is_reversal);
  EXPECT_TRUE(data.attempts[1].is_reversal);
}

TEST(Dataset, SimulatedRespondersOfOneNameAreSeveralParticipants) {
  EXPECT_NE(session(1, "1", Purpose::simulated, "simulated").participant(),
            session(2, "1", Purpose::simulated, "coin").participant());
  EXPECT_EQ(session(1, "1", Purpose::pilot).participant(),
            session(2, "1", Purpose::main).participant());
  EXPECT_TRUE(session(1, "1", Purpose::test, "coin").simulated());
  EXPECT_FALSE(session(1, "1", Purpose::pilot, "human").simulated());
}

TEST_F(LogFile, SeveralPurposesAreRefused) {
  write_session("a", Purpose::main);
  write_session("b", Purpose::main);
  EXPECT_NO_THROW(refuse_mixed_purposes({{path()}, {}}));
  write_session("c", Purpose::pilot);
  try {
    refuse_mixed_purposes({{path()}, {}});
    FAIL() << "several purposes were not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::usage);
    EXPECT_THAT(error.what(), HasSubstr("2 of purpose \"main\", 1 of purpose \"pilot\""));
    EXPECT_THAT(error.what(), HasSubstr("--mix"));
  }
}

TEST_F(LogFile, IsReadBack) {
  write_session("P01", Purpose::main, read_text_file(source_folder() + "/protocols/sorting.toml"));
  const Summary summary = analyze({{path()}, {}, false, ""});
  EXPECT_EQ(summary.sessions.size(), 1);
  EXPECT_EQ(summary.data, "human");
  const StudyEstimate incorrect = figure(summary, "sorting_answers", {{"answer", "incorrect"}});
  EXPECT_EQ(incorrect.n_trials, 1);
  EXPECT_EQ(incorrect.value, 100);
  EXPECT_EQ(incorrect.published, &published::sorting_decoupled.incorrect);
  EXPECT_EQ(figure(summary, "sorting_swapped", {{"exchanged", "light_intermediate"}}).value, 1);
}

TEST_F(LogFile, PurposesAreMixedOnlyOnDemandAndSessionsCanBeNamed) {
  write_session("P01", Purpose::main);
  write_session("P02", Purpose::pilot);
  EXPECT_THROW(analyze({{path()}, {}, false, ""}), Error);
  EXPECT_EQ(figure(analyze({{path()}, {}, true, ""}), "sorting_chance").n_trials, 2);
  EXPECT_EQ(figure(analyze({{path()}, {2}, false, ""}), "sorting_chance").n_trials, 1);
  EXPECT_EQ(figure(analyze({{path()}, {2, 2}, false, ""}), "sorting_chance").n_trials, 1);
  EXPECT_THROW(analyze({{path()}, {3}, false, ""}), Error);
}

TEST_F(LogFile, PeopleNamedAlikeInTwoLogsAreTwo) {
  write_session("P01", Purpose::main);
  const std::string other = path() + "2";
  std::filesystem::copy(path(), other);
  const Summary summary = analyze({{path(), other}, {}, false, ""});
  EXPECT_EQ(summary.n_participants, 2);
  EXPECT_EQ(figure(summary, "sorting_answers").n, 2);
  EXPECT_EQ(summary.sessions.at(1).participant, other + ": P01");
  EXPECT_EQ(summary.database, path() + ", " + other);
  EXPECT_THROW(analyze({{path(), path()}, {}, false, ""}), Error);
  EXPECT_THROW(analyze({{path(), other}, {1}, false, ""}), Error);
}

// If someone is excluded, the log is read again for the figures of the others.
TEST_F(LogFile, WhoIsLeftOutIsInNoFigure) {
  const std::string protocol = read_text_file(source_folder() + "/protocols/sorting.toml");
  write_session("touched nothing, left out", Purpose::main,
                protocol + "\n[exclusion]\nanticipatory_responses = 0.5\n");
  write_session("touched nothing", Purpose::main, protocol);
  const Summary summary = analyze({{path()}, {}, false, ""});
  EXPECT_EQ(summary.sessions.size(), 2);
  EXPECT_TRUE(summary.participants.at(1).excluded());
  EXPECT_EQ(summary.n_participants, 1);
  EXPECT_EQ(figure(summary, "sorting_chance").n_trials, 1);
  EXPECT_EQ(summary.flow.n_analyzed, 1);
}

TEST(Dataset, PicturesAreCountedOverASessionsCameraEvents) {
  std::vector<LoggedEvent> events(3);
  events[0].event.what = CameraReport{100, 2, 1, 20};
  events[1].event.what = CameraReport{50, 0, 3};  // of a program that did not count doubles
  events[2].event.what = Note{R"({"shown":9})"};  // of another kind
  const PictureCounts counts = count_pictures(events);
  EXPECT_EQ(counts.shown, 150);
  EXPECT_EQ(counts.dropped, 2);
  EXPECT_EQ(counts.late, 4);
  EXPECT_EQ(counts.doubled, 20);
}

}  // namespace
}  // namespace heft
