// heft resume: continues an interrupted session, or ends it for good.
#include <fmt/format.h>

#include <memory>

#include "apparatus/StudyPlaces.h"
#include "cli/Commands.h"
#include "cli/SessionOptions.h"
#include "cli/console/Terminal.h"
#include "session/Session.h"

namespace heft::cli {

namespace {
void say_next_parts(const ResolvedConfig& config) {
  const Plug& view = config->config.view;
  if (config->film != view.what)
    say("{} already exists; from here on it is {}\n", to_text(view),
        to_text(Plug{view.name, config->film}));
  if (const std::string& pictures = config->config.record_camera; config->pictures != pictures)
    say("{} already exists; from here on it is {}\n", pictures, config->pictures);
}

// The given folder, or the session's; older logs do not have a plan's.
std::string backup_of(const LoggedSession& session, const std::string& given) {
  if (!given.empty()) return given;
  if (!session.setup.backup.empty()) return session.setup.backup;
  const auto place = place_of(session.row.header.participant_info);
  return place ? place->backup : "";
}

void resume(const std::string& db, std::optional<std::int64_t> session_id, SessionOptions again,
            const std::optional<EventTarget>& events, bool unblind, bool ignore_failed_checks) {
  const LoggedSession session = session_to_resume(db, session_id);
  again.backup = backup_of(session, again.backup);
  const ResolvedConfig config =
      resolve(again, session.setup, *session.protocol, session.row.header.seed);
  say("resuming session {}: participant {}, protocol {}\n", session.row.session_id,
      session.row.header.participant, session.protocol->name);
  for (const auto& [column, from, to] : changes_between(session.setup, config->config))
    if (to.empty())
      say("from here on without {} ({})\n", column, from);
    else if (!from.empty())
      say("from here on with {} {} instead of {}\n", column, to, from);
  say_next_parts(config);
  say_finished(run_session({config, db, unblind, ignore_failed_checks, events,
                            place_words(session.row.header.participant_info)},
                           [&](const RunnerOptions& runner) {
                             return resume_session(session, config, runner);
                           }),
               db);
}

// It cannot be undone, so it is never applied to the newest session by default.
void end(const std::string& db, std::optional<std::int64_t> session_id, const std::string& backup) {
  if (!session_id)
    throw Error(fmt::format("--end needs --session N: which one to end for good; heft list --db {} "
                            "shows them",
                            shell_quoted(db)),
                ExitCode::usage);
  const LoggedSession session = session_to_resume(db, session_id);
  abort_session(session);
  back_up_and_report(db, backup_of(session, backup), session.row.session_id);
  say("session {} of participant {} has ended; its answers are kept\n", session.row.session_id,
      session.row.header.participant);
}
}  // namespace

void add_resume(Command& app) {
  struct ResumeOptions {
    std::string db;
    std::optional<EventTarget> events;
    std::optional<std::int64_t> session;
    SessionOptions again;
    bool end = false, unblind = false, ignore_failed_checks = false, keys = false;
  };
  const auto options = std::make_shared<ResumeOptions>();
  Command command =
      app.add_command("resume", "continue an unfinished session; missing options keep their values",
                      {"heft resume --db lab.db", "heft resume --db lab.db --session 3",
                       "heft resume --db lab.db --responder scripted:recorded/07-second-half",
                       "heft resume --db lab.db --session 3 --end"});
  command.add_log(options->db);
  command.add_session(options->session, "the newest unfinished one");
  add_session_options(command, options->again, true);
  command.add_option("--simulator", &options->again.simulator,
                     "from here on; each trial is replayed with its own");
  command.add_option("--language", &options->again.language,
                     "of the participant's screens: en, fr, or a text FILE.toml");
  add_output_options(command, options->again, options->events);
  command.group("Options");
  command.add_flag("--unblind", options->unblind,
                   "show the experimenter masses and conditions; it is logged");
  command.add_flag("--keys", options->keys,
                   "let the participant's window take keys as answers from here on");
  add_ignore_failed_checks(command, options->ignore_failed_checks);
  command.add_flag(
      "--end", options->end,
      "do not continue: end that --session for good, if the participant does not return");
  command.does([options] {
    if (options->end) return end(options->db, options->session, options->again.backup);
    if (options->keys) options->again.keys = TakesKeys::yes;
    resume(options->db, options->session, options->again, options->events, options->unblind,
           options->ignore_failed_checks);
  });
}

}  // namespace heft::cli
