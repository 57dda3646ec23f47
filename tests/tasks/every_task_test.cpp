// Every task of the list: simulated, interrupted and resumed, vetoed, replayed, judged, exported.
// Each needs a shipped protocol. Screens are tested in tests/view.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "SourceFolder.h"
#include "base/Error.h"
#include "base/files/TextFile.h"
#include "record/export/Export.h"
#include "replay/OfflineResponder.h"
#include "replay/Replay.h"
#include "replay/StoredSession.h"
#include "responders/decision/Decision.h"
#include "tasks/Tasks.h"

namespace heft {
namespace {
namespace fs = std::filesystem;
using testing::StoredSession;

bool has_task(const Protocol& protocol, std::string_view task) {
  return std::ranges::any_of(protocol.blocks, [&](const Block& block) {
    const auto* trials = std::get_if<TaskBlock>(&block);
    return trials && trials->task().name == task;
  });
}

/// A task, and the shipped protocol that shows it; empty: the shortest one.
struct Shown {
  std::string_view task, file = {};
};

// Of the list, and tasks in another form.
std::vector<Shown> shown_tasks() {
  std::vector<Shown> all;
  for (const std::string_view task : words_of<Task>()) all.push_back({task});
  all.push_back({"judgment", "judgment_staircase"});
  all.push_back({"comparison", "real_reference"});
  return all;
}

void PrintTo(const Shown& shown, std::ostream* out) {
  *out << shown.task << ' ' << shown.file;
}

Protocol protocol_with(const Shown& shown) {
  const std::string_view task = shown.task;
  if (!shown.file.empty()) return testing::shipped_protocol(fmt::format("examples/{}", shown.file));
  for (const char* file : {"quick", "examples/estimation"})
    if (Protocol found = testing::shipped_protocol(file); has_task(found, task)) return found;
  for (const char* folder : {"/protocols", "/protocols/examples"})
    for (const auto& entry : fs::directory_iterator(source_folder() + std::string(folder)))
      if (entry.path().extension() == ".toml") try {
          if (Protocol found = load_protocol(entry.path().string()); has_task(found, task))
            return found;
        } catch (const Error&) {  // not a protocol
        }
  throw Error("no protocol in protocols/ or protocols/examples/ shows this task");
}

class EveryTask : public ::testing::TestWithParam<Shown> {
 protected:
  ~EveryTask() override {
    for (const char* end : {"", "-wal", "-shm", "-lock"}) fs::remove(log_ + end);
    fs::remove_all(folder_);
  }
  void expect_verified(const LogReader& reader, std::int64_t id) {
    const Verification verified = verify_session(reader, id, [](double) {});
    EXPECT_FALSE(verified.first) << verified.first->what << ": " << verified.first->logged
                                 << " instead of " << verified.first->replayed;
  }

  void continue_after_kill(const std::string& responder);

  std::string_view task() const { return GetParam().task; }

  Protocol protocol_ = protocol_with(GetParam());
  std::string log_ =
      (fs::temp_directory_path() / ("heft-task-" + std::to_string(::getpid()))).string();
  std::string folder_ = log_ + "-export";
};

TEST_P(EveryTask, IsSimulatedReplayedJudgedAndExported) {
  for (const std::string responder :
       {"simulated", "ideal", "coin", "always_yes", "always_no", "start_anchored", "weber"}) {
    SCOPED_TRACE(responder);
    const bool touches = responder_named(responder).touches_cubes;
    const StoredSession stored(protocol_, responder, 5);
    int n = 0;
    for (const TrialRow& trial : stored.reader().trials(stored.id()))
      if (trial.plan.task == task() && trial.status == TrialStatus::completed) ++n;
    EXPECT_GT(n, 0);
    expect_verified(stored.reader(), stored.id());

    const Judgments judgments = judge_session(stored.reader(), stored.session(),
                                              {{Plug{responder}}, 4}, nullptr, [](double) {});
    const auto n_left_out = [&](std::string_view why) {
      return std::ranges::count(judgments.left_out, why, &LeftOutTrial::why);
    };
    EXPECT_EQ(std::ssize(judgments.trials) + n_left_out(is_practice) + n_left_out(is_untouched) +
                  n_left_out(is_a_number),
              stored.n_completed());
    EXPECT_EQ(judgments.trials.empty(), !touches) << "the others touch no cube";
    const auto of_task =
        std::ranges::count(judgments.trials, task(),
                           [](const JudgedTrial& trial) -> std::string_view { return trial.task; });
    const bool all_scored = touches && n_left_out(is_a_number) == 0;
    EXPECT_EQ(of_task, all_scored ? n : 0);

    if (responder != "simulated") continue;
    export_logs({{stored.session().db}, ExportFormat::csv, folder_}, [](double) {});
    EXPECT_THAT(read_text_file(folder_ + "/trials.csv"),
                ::testing::HasSubstr(',' + std::string(task()) + ','));
    const std::string dictionary = read_text_file(folder_ + "/dictionary.csv");
    for (const std::string_view outcome : task_named(task()).outcomes)
      EXPECT_THAT(dictionary, ::testing::HasSubstr(std::string(outcome)));
  }
}

std::vector<std::string> answers_of(const std::vector<TrialRow>& trials) {
  std::vector<std::string> answers;
  for (const TrialRow& trial : trials)
    if (trial.status == TrialStatus::completed)
      answers.push_back(fmt::format("{} {} {}", *trial.outcome, trial.chosen_slot.value_or(0),
                                    trial.value.value_or(0)));
  return answers;
}

// The program is killed in a trial of the task; the log is resumed to its end, with the answers
// that the whole session had.
TEST_P(EveryTask, ContinuesAfterKill) {
  for (const char* responder : {"coin", "start_anchored", "weber", "ideal"}) {
    SCOPED_TRACE(responder);
    continue_after_kill(responder);
  }
}

void EveryTask::continue_after_kill(const std::string& responder) {
  SessionOptions model;
  model.responder = Plug{responder};
  const RecordedSession whole = compute_session({resolve(model, protocol_, 11), "1"}, {});
  const auto& entries = whole.entries();
  const auto in_task = [&](const RecordedEntry& entry) {
    const auto* recorded = std::get_if<RecordedEvent>(&entry);
    return recorded && recorded->event.as<CubesShown>() && recorded->changes.trial &&
           recorded->changes.trial->plan.task == task();
  };
  const auto cut = std::ranges::find_if(entries, in_task);
  ASSERT_NE(cut, entries.end());
  std::vector<TrialRow> trials;
  for (const RecordedEntry& entry : entries)
    if (const auto* recorded = std::get_if<RecordedEvent>(&entry);
        recorded && recorded->changes.trial)
      trials.push_back(*recorded->changes.trial);
  RecordedSession killed(whole.header());
  for (auto entry = entries.begin(); entry <= cut; ++entry)
    if (const auto* recorded = std::get_if<RecordedEvent>(&*entry))
      killed.append(recorded->event, recorded->changes, Durability::buffered);
    else
      killed.add_frame(std::get<FrameRow>(*entry));
  const std::int64_t id = SessionArchive(log_).store(killed);
  {
    const LogReader before(log_);
    const LoggedSession session = load_session(before, log_, id);
    const ResolvedConfig config = resolve({}, session.setup, *session.protocol, 11);
    EXPECT_EQ(resume_session(session, config, {}).end, RunEnd::finished);
  }
  const LogReader reader(log_);
  EXPECT_EQ(reader.session(id).state, SessionState::finished);
  expect_verified(reader, id);
  EXPECT_EQ(answers_of(reader.trials(id)), answers_of(trials));
}

// Every answer is vetoed once: its trial comes again, and the block has no further trials.
TEST_P(EveryTask, IsPresentedAgainAfterVeto) {
  const auto plan = std::make_shared<const Protocol>(protocol_);
  Engine engine(plan, 3);
  double t_s = 0;
  const auto tell = [&](EventPayload what) { return engine.apply({++t_s, std::move(what)}); };
  const auto run_trial = [&] {
    tell(TrialStarted{});
    tell(CubesShown{});
    const TrialPlan trial = *engine.next().plan;
    for (int slot = 1; plan->require_contact && slot <= trial.n_slots(); ++slot)
      tell(CubeTouch{slot});
    Changes last;
    for (int wrong = 0; engine.trial_is_open();
         ++wrong) {  // the introduction asks until the answer is correct
      if (!engine.screen().can_answer) tell(CubesShown{});
      RandomStream stream(3, "answer", static_cast<std::uint64_t>(trial.trial_number),
                          static_cast<std::uint64_t>(wrong));
      const std::vector<int> wrong_slots(static_cast<std::size_t>(wrong), 1);
      const TrialView view{
          trial.trial_number, trial.attempt, trial.task, {}, engine.screen().offer};
      const WithoutPercepts unseen{trial.n_slots(), true, wrong_slots};
      for (const Action& action : blind_answer(view, unseen, stream).actions) last = tell(action);
    }
    return last;
  };
  int n_vetoed = 0, n_presented = 0;
  while (engine.next().kind != Next::Kind::finish) {
    if (engine.next().kind == Next::Kind::demonstration) {
      tell(DemonstrationShown{});
      continue;
    }
    const TrialRow answered = *run_trial().trial;
    if (answered.plan.task != task()) continue;
    const int n_completed = engine.n_completed();
    const TrialRow vetoed = *tell(AnswerVetoed{"by mistake"}).trial;
    EXPECT_EQ(vetoed.attempt_index, answered.attempt_index);
    EXPECT_FALSE(vetoed.outcome || vetoed.value) << "it counts for nothing";
    EXPECT_EQ(engine.n_completed(), n_completed - 1);
    ++n_vetoed;
    const TrialRow again = *run_trial().trial;
    EXPECT_EQ(again.plan.trial_number, answered.plan.trial_number);
    EXPECT_EQ(again.plan.attempt, answered.plan.attempt + 1);
    ++n_presented;
  }
  EXPECT_GT(n_vetoed, 0);
  EXPECT_EQ(n_presented, n_vetoed);
}

INSTANTIATE_TEST_SUITE_P(Each, EveryTask, ::testing::ValuesIn(shown_tasks()),
                         [](const auto& shown) {
                           return std::string(shown.param.file.empty() ? shown.param.task
                                                                       : shown.param.file);
                         });

std::vector<TrialRow> comparisons_in(const StoredSession& stored) {
  std::vector<TrialRow> completed = stored.reader().trials(stored.id());
  std::erase_if(completed, [](const TrialRow& trial) {
    return trial.plan.task != "comparison" || trial.status != TrialStatus::completed;
  });
  return completed;
}

std::vector<JudgedTrial> judged_comparisons(const StoredSession& stored,
                                            const std::string& responder) {
  std::vector<JudgedTrial> judged =
      judge_session(stored.reader(), stored.session(), {{Plug{responder}}, 4}, nullptr, [](double) {
      }).trials;
  std::erase_if(judged, [](const JudgedTrial& trial) { return trial.task != "comparison"; });
  return judged;
}

// A comparison without "no difference": every model names a cube, and the log is verified.
TEST(ForcedChoice, IsSimulatedReplayedAndJudgedWithoutThirdAnswer) {
  for (const std::string responder : {"simulated", "coin", "always_no"}) {
    SCOPED_TRACE(responder);
    const StoredSession stored(testing::shipped_protocol("examples/forced_choice"), responder, 5);
    int n = 0;
    for (const TrialRow& trial : comparisons_in(stored)) {
      EXPECT_EQ(trial.outcome, "difference");
      EXPECT_TRUE(trial.chosen_slot);
      ++n;
    }
    EXPECT_GE(n, 24 + 6);
    EXPECT_FALSE(verify_session(stored.reader(), stored.id(), [](double) {}).first);
    for (const JudgedTrial& trial : judged_comparisons(stored, responder)) {
      EXPECT_EQ(trial.n_answers, 2);
      EXPECT_FALSE(trial.detects);
      EXPECT_EQ(trial.models.at(0).n_of("none"), 0);
    }
  }
}

// A comparison by "same" and "different": no model names a cube, and the log is verified.
TEST(SameDifferent, IsSimulatedReplayedAndJudgedWithoutCube) {
  for (const std::string responder : {"simulated", "coin", "always_yes", "always_no"}) {
    SCOPED_TRACE(responder);
    const StoredSession stored(testing::shipped_protocol("examples/same_different"), responder, 5);
    std::map<std::string, int> n;
    for (const TrialRow& trial : comparisons_in(stored)) {
      EXPECT_FALSE(trial.chosen_slot);
      ++n[std::string(*trial.outcome)];
    }
    EXPECT_EQ(n["difference"] + n["no_difference"], 32 + 4);
    EXPECT_EQ(n["difference"] > 0, responder != "always_no");
    EXPECT_EQ(n["no_difference"] > 0, responder != "always_yes");
    EXPECT_FALSE(verify_session(stored.reader(), stored.id(), [](double) {}).first);
    for (const JudgedTrial& trial : judged_comparisons(stored, responder)) {
      EXPECT_EQ(trial.n_answers, 2);
      EXPECT_TRUE(trial.detects);
      EXPECT_EQ(trial.models.at(0).n_of("none") + trial.models.at(0).n_of("different"), 4);
    }
  }
}

// Mass and friction varied apart: in the log, in the lag that is displayed, and in a replay.
TEST(OwnFriction, OfCubesIsLoggedDisplayedAndReplayed) {
  const StoredSession stored(testing::shipped_protocol("examples/friction"), "simulated", 5);
  const LogReader& reader = stored.reader();
  EXPECT_FALSE(verify_session(reader, stored.id(), [](double) {}).first);
  std::map<int, std::string> tasks;
  for (const TrialRow& trial : reader.trials(stored.id())) {
    tasks[trial.attempt_index] = trial.plan.task;
    const bool own = !trial.plan.is_practice && trial.plan.task != "introduction";
    EXPECT_EQ(trial.plan.table_friction.size(), own ? trial.plan.masses_g.size() : 0);
  }
  std::map<int, std::vector<double>> lags_mm;  // by friction times mass
  for (const CubeRow& cube : reader.cubes(stored.id())) {
    if (!cube.table_friction || !cube.peak_lag_m) continue;
    const double product_g = *cube.table_friction * cube.mass_g;
    if (tasks[cube.attempt_index] == "sorting") {
      EXPECT_NEAR(product_g, 80, 1e-9);
    }
    lags_mm[static_cast<int>(std::lround(product_g))].push_back(1e3 * *cube.peak_lag_m);
  }
  ASSERT_TRUE(lags_mm.contains(20) && lags_mm.contains(80) && lags_mm.contains(320));
  EXPECT_LT(std::ranges::max(lags_mm[20]), std::ranges::min(lags_mm[80]));
  EXPECT_LT(std::ranges::max(lags_mm[80]), std::ranges::min(lags_mm[320]));
}

}  // namespace
}  // namespace heft
