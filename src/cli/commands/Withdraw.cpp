// heft withdraw: removes a person's data from a log.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <set>

#include "base/Clock.h"
#include "base/Error.h"
#include "cli/Commands.h"
#include "cli/console/Terminal.h"
#include "cli/reports/Reports.h"
#include "record/writer/SessionLog.h"
#include "replay/Replay.h"
#include "session/Session.h"

namespace heft::cli {

namespace {
struct WithdrawOptions {
  std::string db;
  std::optional<std::int64_t> session;
  std::vector<std::string> folders;
  bool yes = false, unverified = false;
};

// What is about to be removed, and where copies may be.
struct Found {
  SessionFacts facts;
  std::set<std::string> folders;   ///< to be searched
  std::set<std::string> pictures;  ///< folders with recorded camera pictures
  std::set<std::string> videos;    ///< of the session
};

Found found_in(const LogReader& reader, const WithdrawOptions& options) {
  Found found{facts_of(reader, reader.session(*options.session)), {}, {}, {}};
  const auto folder = std::filesystem::absolute(options.db).parent_path();
  found.folders = {folder.string()};
  found.folders.insert(options.folders.begin(), options.folders.end());
  for (const LoggedSetup& logged : reader.setups(*options.session)) {
    if (!logged.setup.backup.empty()) found.folders.insert(logged.setup.backup);
    if (!logged.setup.record_camera.empty()) found.pictures.insert(logged.setup.record_camera);
    if (logged.setup.view.name == "video") found.videos.insert(logged.setup.view.what);
  }
  return found;
}

void confirm(const SessionFacts& facts, const WithdrawOptions& options) {
  const std::string what =
      fmt::format("session {} of participant {}, {}, {} of {}", facts.row.session_id,
                  facts.row.header.participant, facts.row.header.protocol_name,
                  counted(facts.n_completed, "trial"), facts.row.header.started_utc);
  if (options.yes) return say("removing {}\n", what);
  if (isatty(STDIN_FILENO) != 1)
    throw Error(fmt::format("this removes {} and cannot be undone; add --yes to do it", what),
                ExitCode::usage);
  say("This removes {}. It cannot be undone.\nType the participant's id to continue: ", what);
  std::string typed;
  std::getline(std::cin, typed);
  if (typed != facts.row.header.participant)
    throw Error("that is not the participant's id; nothing was removed", ExitCode::usage);
}

// An export has a dozen tables, which are counted.
void print_texts(const std::set<std::string>& texts) {
  constexpr std::size_t most_named = 3;
  std::map<std::string, std::vector<std::string>> by_folder;
  for (const std::string& text : texts) {
    const std::filesystem::path path(text);
    by_folder[path.parent_path().string()].push_back(path.filename().string());
  }
  for (const auto& [folder, names] : by_folder)
    if (names.size() > most_named)
      print("  {} ({} files, such as {})\n", folder, names.size(), names.front());
    else
      for (const std::string& name : names) print("  {}/{}\n", folder, name);
}

void report_copies(const Found& found, const WithdrawOptions& options) {
  const CopiesOfSession copies =
      copies_of_session(found.folders, options.db, found.facts.row.header);
  print("files that hold or may hold copies, in {}:\n",
        fmt::format("{}", fmt::join(found.folders, ", ")));
  for (const std::string& log : copies.logs) print("  {}\n", log);
  print_texts(copies.texts);
  for (const std::string& folder : found.pictures) print("  {} (camera pictures)\n", folder);
  for (const std::string& video : found.videos) print("  {} (video)\n", video);
  if (copies.logs.empty() && copies.texts.empty() && found.pictures.empty() && found.videos.empty())
    print("  none found\n");
  print(
      "Delete them, and what was given away: pseudonymised exports do not name the participant "
      "and are not found here.\n");
}

// A person may have come several times.
void report_others(const SessionRow& withdrawn, const std::string& db) {
  for (const SessionRow& other : LogReader(db).sessions())
    if (other.session_id != withdrawn.session_id && other.state != SessionState::withdrawn &&
        other.header.participant == withdrawn.header.participant)
      print("session {} is of participant {}, too: heft withdraw --db {} --session {}\n",
            other.session_id, other.header.participant, shell_quoted(db), other.session_id);
}

void refuse_if_left_in_file(const std::string& why, const WithdrawOptions& options) {
  if (why.empty()) return;
  throw Error(
      fmt::format("session {} is withdrawn, but its data can still be read from the file "
                  "{}: {}, then repeat: heft withdraw --db {} --session {} --yes",
                  *options.session, options.db, why, shell_quoted(options.db), *options.session));
}

void withdraw(const WithdrawOptions& options) {
  if (!options.session)
    throw Error(fmt::format("--session N is required: heft list --db {} shows them",
                            shell_quoted(options.db)),
                ExitCode::usage);
  refuse_special_file(options.db);
  // What is removed cannot be inspected afterwards, and the rest is sealed as it is.
  if (!options.unverified)
    require_verified(
        options.db, {}, [](double) {}, "removes the session nevertheless");
  const Found found = found_in(LogReader(options.db), options);
  if (found.facts.row.state == SessionState::withdrawn) {
    refuse_if_left_in_file(finish_withdrawals(options.db), options);
    throw Error(fmt::format("session {} in {} is already withdrawn, and nothing of it is left in "
                            "the file",
                            *options.session, options.db),
                ExitCode::usage);
  }
  confirm(found.facts, options);
  report_others(found.facts.row, options.db);
  report_copies(found, options);  // before, because afterwards nothing names the person
  const Withdrawal done = withdraw_session(options.db, *options.session, utc_now());
  print("session {} is withdrawn; head of the log: {}\n", *options.session, short_head(done.head));
  refuse_if_left_in_file(done.why_not_overwritten, options);
}
}  // namespace

void add_withdraw(Command& app) {
  const auto options = std::make_shared<WithdrawOptions>();
  Command command = app.add_command(
      "withdraw", "remove a person's data from a log, and list the copies that remain",
      {"heft withdraw --db lab.db --session 7", "heft withdraw --db lab.db --session 7 --yes",
       "heft withdraw --db lab.db --session 7 --search /media/stick"});
  command.add_log(options->db);
  command.add_session(options->session, "none, required");
  command.add_option("--search", &options->folders,
                     "another folder to search for copies, beside the log's and its backups'; "
                     "repeat for several");
  command.add_flag("--yes", options->yes, "do not ask");
  command.add_flag("--unverified", options->unverified,
                   "remove the data even if the log was changed or is damaged");
  command.does([options] { withdraw(*options); });
}

}  // namespace heft::cli
