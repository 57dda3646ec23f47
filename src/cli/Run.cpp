// heft run and heft resume: one participant's session.
#include <fmt/format.h>

#include <memory>

#include "base/Error.h"
#include "cli/Commands.h"
#include "cli/ParticipantId.h"
#include "cli/SessionCommand.h"
#include "cli/Talk.h"
#include "cli/WholeNumber.h"

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

constexpr auto responder_help = "human, or a model: NAME or NAME:FILE (heft doctor lists them)";
constexpr auto tracker_help =
    "where effector poses come from: hand (the responder's own, no pixels); not in this version: "
    "camera:N, video:F, frames:DIR, synthetic";
constexpr auto view_help = "what shows the session: headless; not in this version: window, video:F";

void say_finished(const SessionResult& result, const std::string& db) {
  say("session {} is finished: {} trials, {:.0f} minutes of session time, all saved in {}\n"
      "what was found: heft analyse --db {}\n"
      "check the log: heft replay --db {} --session {}\n",
      result.session_id, result.n_completed, result.duration_s / 60, db, db, db, result.session_id);
}

void run(const Options& options) {
  check_participant(options.participant);
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
  say("participant {}, protocol {}, responder {}, seed {}\n", request.participant,
      request.protocol.name, request.options.responder, request.seed);
  say_finished(
      run_session(request.protocol, request.db,
                  [&](const RunnerOptions& runner) { return start_session(request, runner); }),
      request.db);
}

void resume(const std::string& db, std::optional<std::int64_t> session_id,
            const OptionsAgain& again) {
  LoggedSession session = session_to_resume(db, session_id);
  give_again(session, again);
  say("going on with session {}: participant {}, protocol {}\n", session.row.session_id,
      session.row.header.participant, session.protocol->name);
  for (const OptionChange& change : session.changes)
    if (change.option != "responder_text")
      say("from here on with {} {} instead of {}\n", change.option, change.to, change.from);
  say_finished(
      run_session(*session.protocol, db,
                  [&](const RunnerOptions& runner) { return resume_session(session, runner); }),
      db);
}

void end(const std::string& db, std::optional<std::int64_t> session_id) {
  const LoggedSession session = session_to_resume(db, session_id);
  abort_session(session);
  say("session {} of participant {} is ended as it is; what was answered is kept\n",
      session.row.session_id, session.row.header.participant);
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
  command->add_option("--responder", options->responder, responder_help)->capture_default_str();
  command->add_option("--tracker", options->tracker, tracker_help);
  command->add_option("--view", options->view, view_help);
  command->add_option("--simulator", options->simulator, "instead of the protocol's");
  command->add_flag("--again", options->again,
                    "run once more a protocol that the participant has finished");
  command->callback([options] { run(*options); });
}

void add_resume(CLI::App& app) {
  struct ResumeOptions {
    std::string db = "heft.db";
    std::optional<std::int64_t> session;
    OptionsAgain again;
    bool end = false;
  };
  const auto options = std::make_shared<ResumeOptions>();
  CLI::App* command = add_command(
      app, "resume",
      "go on with an unfinished session; options that are not given again stay as they were",
      {"heft resume --db lab.db", "heft resume --db lab.db --session 3",
       "heft resume --db lab.db --responder scripted:recorded/07-second-half",
       "heft resume --db lab.db --session 3 --end"});
  command->add_option("--db", options->db, "the log")->capture_default_str();
  command->add_option("--session", options->session, "default: the newest unfinished one")
      ->check(session_number());
  command->add_option("--responder", options->again.responder, responder_help);
  command->add_option("--tracker", options->again.tracker, tracker_help);
  command->add_option("--view", options->again.view, view_help);
  command->add_option("--simulator", options->again.simulator,
                      "only the one the session was started with: replay needs one for all of it");
  command->add_flag("--end", options->end,
                    "don't go on: end the session as it is, for somebody who will not come back");
  command->callback([options] {
    if (options->end) return end(options->db, options->session);
    resume(options->db, options->session, options->again);
  });
}

}  // namespace heft::cli
