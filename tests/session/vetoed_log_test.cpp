// A log with vetoed answers: written, read, verified.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>

#include "SourceFolder.h"
#include "apparatus/configuration/ResolvedConfig.h"
#include "base/Program.h"
#include "record/schema/EventRow.h"
#include "record/writer/SessionLog.h"
#include "replay/Replay.h"
#include "session/Session.h"

namespace heft {
namespace {

// A session without pictures: only the events given to the engine.
class ToldSession {
 public:
  explicit ToldSession(const Protocol& made)
      : protocol(std::make_shared<const Protocol>(made)), recorded(header(made)) {
    tell(setup);
  }

  Changes tell(EventPayload what) {
    const Event event{++t_s, std::move(what)};
    Changes changes = engine.apply(event);
    recorded.append(event, changes, Durability::buffered);
    return changes;
  }
  Changes run_trial(bool yes) {
    tell(TrialStarted{});
    tell(CubesShown{});
    const TrialPlan plan = *engine.next().plan;
    if (plan.task == "sorting") return tell(Action{"dont_know"});
    if (plan.task == "comparison" && !yes) return tell(Action{"no_difference"});
    return tell(Action{"select", plan.masses_g[0] > plan.masses_g[1] ? 1 : 2});
  }
  bool compares() const { return engine.next().plan && engine.next().plan->task == "comparison"; }

  SessionHeader header(const Protocol& made) {
    SessionOptions model;
    model.responder = Plug{"coin"};
    setup = resolve(model, made, 7)->config;
    SessionHeader told;
    told.participant = "1";
    told.protocol_name = made.name;
    told.protocol_text = made.text;
    told.protocol_sha256 = made.sha256;
    told.seed = 7;
    told.heft_version = HEFT_VERSION;
    told.build = build_name();
    told.run_options = to_json(setup);
    told.purpose = Purpose::simulated;
    told.responder = to_text(setup.responder);
    told.started_utc = "2026-01-01T00:00:00Z";
    return told;
  }

  SessionConfig setup;
  std::shared_ptr<const Protocol> protocol;
  Engine engine{protocol, 7};
  RecordedSession recorded;
  double t_s = 0;
};

class VetoedLog : public ::testing::Test {
 protected:
  ~VetoedLog() override {
    for (const char* end : {"", "-wal", "-shm", "-lock"})
      std::filesystem::remove(path.string() + end);
  }
  std::filesystem::path path = std::filesystem::temp_directory_path() /
                               ("heft-vetoed-" + std::to_string(::getpid()) + ".db");
};

TEST_F(VetoedLog, IsVerifiedAndHoldsNoRowOfWhatWasTakenBack) {
  ToldSession session(load_protocol(source_folder() + "/protocols/quick.toml"));
  int n_vetoed = 0, n_estimates_taken_back = 0;
  bool yes = true;
  for (;;) {
    const Next next = session.engine.next();
    if (next.kind == Next::Kind::demonstration) session.tell(DemonstrationShown{});
    if (next.kind == Next::Kind::finish) break;
    if (next.kind != Next::Kind::trial) continue;
    const bool may_be_vetoed = session.compares();
    const Changes changes = session.run_trial(yes = !yes);
    if (!may_be_vetoed || changes.trial->plan.attempt > 1) continue;
    session.tell(AnswerVetoed{"by mistake"});
    ++n_vetoed;
    n_estimates_taken_back += static_cast<int>(changes.estimates.size());
  }
  session.tell(SessionEnded{});
  ASSERT_GT(n_vetoed, 3);
  ASSERT_GT(n_estimates_taken_back, 0);

  const std::int64_t id = SessionArchive(path.string()).store(session.recorded);
  const LogReader reader(path.string());
  const Verification verified = verify_session(reader, id, [](double) {});
  ASSERT_FALSE(verified.first) << verified.first->what << ": " << verified.first->logged
                               << " instead of " << verified.first->replayed;
  int n_void = 0;
  for (const TrialRow& trial : reader.trials(id)) {
    if (trial.status != TrialStatus::voided) continue;
    ++n_void;
    EXPECT_EQ(trial.void_reason, "answer vetoed: by mistake");
    EXPECT_FALSE(trial.outcome) << "whoever counts outcomes does not count it";
    EXPECT_TRUE(trial.validated_s) << "what was answered is kept";
  }
  EXPECT_EQ(n_void, n_vetoed);
}

}  // namespace
}  // namespace heft
