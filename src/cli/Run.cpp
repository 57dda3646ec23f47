// heft run and heft resume: one participant's session.
#include <fmt/format.h>

#include <memory>

#include "base/Error.h"
#include "cli/Commands.h"
#include "cli/SessionCommand.h"

namespace heft::cli {

namespace {

struct Options {
  std::string protocol, participant, db = "heft.db";
  std::optional<std::uint64_t> seed;
  std::string responder = "human";
  std::optional<std::string> tracker, view;
  std::string simulator;
  bool again = false;
};

void say_finished(const SessionResult& result, const std::string& db) {
  fmt::print(stderr,
             "session {} is finished: {} trials, {:.0f} minutes of session time, all saved in {}\n"
             "what was found: heft analyse --db {}\n"
             "check the log: heft replay --db {} --session {}\n",
             result.session_id, result.n_completed, result.duration_s / 60, db, db, db,
             result.session_id);
}

void run(const Options& options) {
  SessionRequest request;
  request.protocol = load_protocol(options.protocol);
  request.options.responder = options.responder;
  request.options.tracker = options.tracker.value_or("hand");
  request.options.view = options.view.value_or("headless");
  request.options.simulator = options.simulator;
  complete(request.options);
  request.participant = options.participant;
  request.db = options.db;
  request.seed = options.seed.value_or(fresh_seed());
  request.again = options.again;
  fmt::print(stderr, "participant {}, protocol {}, responder {}, seed {}\n", request.participant,
             request.protocol.name, request.options.responder, request.seed);
  say_finished(
      run_session(request.protocol, request.db,
                  [&](const RunnerOptions& runner) { return start_session(request, runner); }),
      request.db);
}

}  // namespace

void add_run(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = add_command(
      app, "run", "run one participant's session of a protocol",
      {"heft run protocols/quick.toml --participant 07 --responder simulated",
       "heft run protocols/paper.toml --participant 07 --responder simulated --seed 42 --db lab.db",
       "heft run protocols/jnd.toml --participant 07 --responder scripted:recorded/07 --db "
       "lab.db"});
  command->add_option("PROTOCOL", options->protocol, "a protocol file")->required();
  command
      ->add_option("--participant", options->participant,
                   "the participant's id; text, kept as it is")
      ->required();
  command->add_option("--db", options->db, "the log; an existing one gets one more session")
      ->capture_default_str();
  add_seed(command, options->seed);
  command
      ->add_option("--responder", options->responder,
                   "human, or a model: NAME or NAME:FILE (heft doctor lists them)")
      ->capture_default_str();
  command->add_option("--tracker", options->tracker,
                      "where effector poses come from: hand (the responder's own, no pixels)");
  command->add_option("--view", options->view, "what shows the session: headless");
  command->add_option("--simulator", options->simulator, "instead of the protocol's");
  command->add_flag("--again", options->again,
                    "run once more a protocol that the participant has finished");
  command->callback([options] { run(*options); });
}

void add_resume(CLI::App& app) {
  struct ResumeOptions {
    std::string db = "heft.db";
    std::optional<std::int64_t> session;
  };
  const auto options = std::make_shared<ResumeOptions>();
  CLI::App* command =
      add_command(app, "resume", "go on with an unfinished session",
                  {"heft resume --db lab.db", "heft resume --db lab.db --session 3"});
  command->add_option("--db", options->db, "the log")->capture_default_str();
  command->add_option("--session", options->session, "default: the newest unfinished one");
  command->callback([options] {
    const LoggedSession session = session_to_resume(options->db, options->session);
    fmt::print(stderr, "going on with session {}: participant {}, protocol {}\n",
               session.row.session_id, session.row.header.participant, session.protocol->name);
    say_finished(
        run_session(*session.protocol, options->db,
                    [&](const RunnerOptions& runner) { return resume_session(session, runner); }),
        options->db);
  });
}

}  // namespace heft::cli
