// heft resume: going on with a session that was interrupted, or ending it.
#include <fmt/format.h>

#include <memory>

#include "apparatus/StudyPlaces.h"
#include "cli/Commands.h"
#include "cli/Questionnaires.h"
#include "cli/SessionOptions.h"
#include "cli/Terminal.h"
#include "session/Session.h"

namespace heft::cli {

namespace {
void say_next_parts(const SessionConfig& before) {
  const SessionConfig now = with_next_parts(before);
  for (const auto option : {&SessionConfig::view, &SessionConfig::record_camera})
    if (now.*option != before.*option)
      say("{} is there already; from here on it is {}\n", before.*option, now.*option);
}

// What another responder, tracker or view needs, and the session did without so far.
GivenOptions with_missing_files(const LoggedSession& session, GivenOptions again) {
  const SessionConfig& setup = session.setup;
  const SessionConfig defaults = with_defaults(again);
  const auto fill = [](std::optional<std::string>& given, const std::string& held,
                       const std::string& fallback) {
    if (!given && held.empty() && !fallback.empty()) given = fallback;
  };
  if (again.tracker || again.responder) {
    fill(again.camera_file, setup.camera_file, defaults.camera_file);
    fill(again.board_file, setup.board_file, defaults.board_file);
    fill(again.effector_file, setup.effector_file, defaults.effector_file);
  }
  if (again.view || again.responder)
    fill(again.texts_file, setup.texts_file, texts_file(session.protocol->screens.language));
  return again;
}

// What people are asked is planned with the protocol, and comes in whatever they read.
void change(LoggedSession& session, const GivenOptions& again) {
  change_setup(session, again);
  check(session.setup, *session.protocol);
  add_questionnaires(session.setup, *session.protocol,
                     again.texts_file.value_or(texts_file(session.protocol->screens.language)));
  session.setup = in_force(std::move(session.setup), *session.protocol);
}

// The folder that was given, or the session's; older logs have a plan's elsewhere.
std::string backup_of(const LoggedSession& session, const Elsewhere& elsewhere) {
  if (!elsewhere.backup.empty()) return backup_folder(elsewhere);
  if (!session.setup.backup.empty()) return session.setup.backup;
  const auto place = place_of(session.row.header.participant_info);
  return place ? place->backup : "";
}

void resume(const std::string& db, std::optional<std::int64_t> session_id,
            const GivenOptions& again, const Elsewhere& elsewhere, bool unblind, bool go_on,
            bool keys) {
  LoggedSession session = session_to_resume(db, session_id);
  const SessionConfig before = session.setup;
  change(session, with_missing_files(session, again));
  if (keys) session.setup.keys = "yes";
  session.setup.backup = backup_of(session, elsewhere);
  say("going on with session {}: participant {}, protocol {}\n", session.row.session_id,
      session.row.header.participant, session.protocol->name);
  for (const auto& [column, from, to] : changes_between(before, session.setup))
    if (to.empty())
      say("from here on without {} ({})\n", column, from);
    else if (!from.empty())
      say("from here on with {} {} instead of {}\n", column, to, from);
  say_next_parts(session.setup);
  say_finished(
      run_session({*session.protocol, session.setup, db, unblind, go_on, elsewhere.events,
                   place_words(session.row.header.participant_info)},
                  [&](const RunnerOptions& runner) { return resume_session(session, runner); }),
      db);
}

// There is no way back, so it is never somebody's because they happened to come last.
void end(const std::string& db, std::optional<std::int64_t> session_id,
         const Elsewhere& elsewhere) {
  if (!session_id)
    throw Error(fmt::format("--end needs --session N: which one to end for good; heft list --db {} "
                            "shows them",
                            shell_quoted(db)),
                ExitCode::usage);
  const LoggedSession session = session_to_resume(db, session_id);
  abort_session(session);
  back_up_and_tell(db, backup_of(session, elsewhere), session.row.session_id);
  say("session {} of participant {} is ended as it is; what was answered is kept\n",
      session.row.session_id, session.row.header.participant);
}
}  // namespace

void add_resume(Command& app) {
  struct ResumeOptions {
    std::string db = "heft.db";
    std::optional<std::int64_t> session;
    std::optional<std::string> language;
    GivenOptions again;
    Elsewhere elsewhere;
    bool end = false, unblind = false, go_on = false, keys = false;
  };
  const auto options = std::make_shared<ResumeOptions>();
  Command command = app.add_command(
      "resume",
      "go on with an unfinished session; options that are not given again stay as they were",
      {"heft resume --db lab.db", "heft resume --db lab.db --session 3",
       "heft resume --db lab.db --responder scripted:recorded/07-second-half",
       "heft resume --db lab.db --session 3 --end"});
  command.add_option("--db", &options->db, "the log").shows_default();
  command.add_session(options->session, "the newest unfinished one");
  add_session_options(command, options->again, true);
  command.add_option("--simulator", &options->again.simulator,
                     "from here on; each trial is replayed with the one that it ran with");
  command.add_option("--language", &options->language,
                     "of the participant's screens: en, fr, or a text FILE.toml");
  add_elsewhere_options(command, options->elsewhere);
  command.group("Options");
  command.add_flag("--unblind", options->unblind,
                   "show the experimenter masses and conditions; it is logged");
  command.add_flag("--keys", options->keys,
                   "let the participant's window take keys as answers from here on");
  add_go_on(command, options->go_on);
  command.add_flag("--end", options->end,
                   "don't go on: end that --session as it is, for somebody who will not come back");
  command.does([options] {
    if (options->end) return end(options->db, options->session, options->elsewhere);
    if (options->language) options->again.texts_file = texts_file(*options->language);
    resume(options->db, options->session, options->again, options->elsewhere, options->unblind,
           options->go_on, options->keys);
  });
}

}  // namespace heft::cli
