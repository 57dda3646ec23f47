// heft show: one session of a log: its progress, configuration, notes and checks of the apparatus.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "apparatus/LoggedSession.h"
#include "base/Clock.h"
#include "base/Error.h"
#include "base/files/Printable.h"
#include "cli/Commands.h"
#include "cli/console/Terminal.h"
#include "cli/reports/Reports.h"
#include "record/schema/EventRow.h"
#include "replay/Replay.h"
#include "session/Session.h"

namespace heft::cli {

namespace {
using Json = nlohmann::ordered_json;

// Events of the session's course, in order; trials are counted instead.
bool is_listed(const Event& event) {
  return event.is<Note, Deviation, Unblinding, SessionPaused, SessionContinued, SessionResumed,
                  BreakTaken, Consent, AnswerVetoed, SessionEnded>();
}

struct BlockProgress {
  std::string block;
  int n_completed = 0, n_void = 0;
};

// Progress of blocks, in the order of the session.
std::vector<BlockProgress> progress_of(const std::vector<TrialRow>& trials) {
  std::vector<BlockProgress> blocks;
  for (const TrialRow& trial : trials) {
    auto found = std::ranges::find(blocks, trial.plan.block, &BlockProgress::block);
    if (found == blocks.end()) found = blocks.insert(blocks.end(), {trial.plan.block});
    found->n_completed += trial.status == TrialStatus::completed ? 1 : 0;
    found->n_void += trial.status == TrialStatus::voided ? 1 : 0;
  }
  return blocks;
}

struct Shown {
  SessionFacts facts;
  std::vector<LoggedEvent> events;
  std::vector<TrialRow> trials;
  std::vector<LoggedSetup> setups;
};

Shown shown_of(const std::string& db, std::optional<std::int64_t> session_id) {
  refuse_special_file(db);
  const LogReader reader(db);
  const auto sessions = reader.sessions();
  if (sessions.empty()) throw Error(fmt::format("{} holds no session yet", db));
  const SessionRow row = session_id ? reader.session(*session_id) : sessions.back();
  const std::int64_t id = row.session_id;
  warn_of_fault(fault_of_log(reader, db, {id}, [](double) {}), db);
  return {facts_of(reader, row), reader.events(id), reader.trials(id), reader.setups(id)};
}

// The participant's answers, without the study plan's entries.
std::map<std::string, std::string> participant_reports(const SessionRow& row) {
  auto reported = row.header.participant_info;
  std::erase_if(reported, [](const auto& entry) {
    return entry.first == "study" || entry.first.starts_with("study_");
  });
  return reported;
}

void print_head(const SessionFacts& facts) {
  const SessionHeader& header = facts.row.header;
  print("session {}: participant {}, protocol {}, purpose {}, seed {}\n", facts.row.session_id,
        escaped_line(header.participant), escaped_line(header.protocol_name),
        name_of(header.purpose), header.seed);
  if (const auto& place = facts.place)
    print("study {}: {} of {}{}{}\n", escaped_line(place->study), place->number,
          place->participants, place->group.empty() ? "" : ", group " + escaped_line(place->group),
          place->order.empty() ? "" : ", order " + escaped_line(place->order));
  if (!facts.head.empty()) print("head of the log: {}\n", short_head(facts.head));
  print("{}; trials: {} completed, {} void; {} minutes of session time; started {}\n",
        name_of(facts.row.state), trials_text(facts), facts.n_void, minutes_text(facts.duration_s),
        header.started_utc);
}

void print_pictures(const PictureCounts& pictures) {
  if (pictures.shown + pictures.dropped == 0) return;
  print("camera pictures: {} shown, {} of them late; {} dropped\n", pictures.shown, pictures.late,
        pictures.dropped);
  if (pictures.doubled > 0)
    print("doubles: {} of them show a second print of a tag; put spare sheets and nets away\n",
          pictures.doubled);
}

void print_progress(const std::vector<TrialRow>& trials) {
  const auto blocks = progress_of(trials);
  if (!blocks.empty()) print("\ntrials by block\n");
  for (const BlockProgress& block : blocks)
    print("  {}: {} completed{}\n", escaped_line(block.block), block.n_completed,
          block.n_void > 0 ? fmt::format(", {} void", block.n_void) : "");
  for (const TrialRow& trial : trials)
    if (trial.status == TrialStatus::voided)
      print("  void: trial {}, attempt {}, at {}: {}\n", trial.plan.trial_number,
            trial.plan.attempt, minutes_text(trial.ended_s.value_or(trial.started_s)),
            escaped_line(trial.void_reason.value_or("")));
}

std::string in_short(const SessionConfig& setup) {
  const auto often = [](const std::optional<double>& hz) {
    return hz ? fmt::format(" at {} Hz", *hz) : std::string{};
  };
  const std::string simulator = setup.simulator.empty() ? "of the protocol" : setup.simulator;
  std::string reported = fmt::format(
      "responder {}, tracker {}, simulator {}{}, view {}{}", escaped_line(to_text(setup.responder)),
      escaped_line(to_text(setup.tracker)), escaped_line(simulator), often(setup.rate_hz),
      escaped_line(to_text(setup.view)), often(setup.display_rate_hz));
  for (const auto& [name, value] : {std::pair{"input", to_text(setup.input)},
                                    {"display", to_text(setup.display)},
                                    {"language", setup.language},
                                    {"operator", setup.run_by}})
    if (!value.empty()) reported += fmt::format(", {} {}", name, escaped_line(value));
  if (const auto light = setup.display_latency_ms.find("light_ms");
      light != setup.display_latency_ms.end())
    reported += fmt::format(", light {:.0f} ms after a frame", light->second);
  for (const ProtocolSetting& setting : setup.settings)
    reported += ", set " + escaped_line(to_text(setting));
  return reported;
}

void print_setups(const std::vector<LoggedSetup>& setups) {
  print("\nsetups\n");
  const SessionConfig* before = nullptr;
  for (const LoggedSetup& logged : setups) {
    print("  from event {}:", logged.from_event);
    if (!before) {
      print(" {}\n", in_short(logged.setup));
    } else {
      std::string changes;
      for (const auto& [column, from, to] : changes_between(*before, logged.setup))
        changes += fmt::format("{} {} {} instead of {}", changes.empty() ? "" : ",", column,
                               to.empty() ? "none" : escaped_line(to),
                               from.empty() ? "none" : escaped_line(from));
      print("{}\n", changes);
    }
    before = &logged.setup;
  }
}

// Whole, unless another program wrote it.
std::string readable(const std::string& text) {
  constexpr std::size_t most = 1000;
  if (text.size() <= most) return escaped_line(text);
  return escaped_line(text.substr(0, most)) + fmt::format("... ({} bytes in all)", text.size());
}

void print_checks(const std::vector<LoggedEvent>& events) {
  bool any = false;
  for (const LoggedEvent& logged : events)
    if (const auto* check = logged.event.as<CheckResult>()) {
      if (!std::exchange(any, true)) print("\nchecks of the apparatus\n");
      print("  {} {}: {} ({})\n", minutes_text(logged.event.t_s), escaped_line(check->name),
            escaped_line(check->finding), name_of(check->verdict));
    }
}

void print_course(const std::vector<LoggedEvent>& events) {
  bool any = false;
  for (const LoggedEvent& logged : events) {
    if (!is_listed(logged.event)) continue;
    if (!std::exchange(any, true)) print("\nincidents\n");
    const EventRow row = row_of(logged.event);
    print("  {} {}{}{}\n", minutes_text(row.t_s), name_of(row.kind), row.detail.empty() ? "" : ": ",
          readable(row.detail));
  }
}

void print_info(const SessionRow& row) {
  const auto reported = participant_reports(row);
  if (!reported.empty()) print("\nreported by the participant\n");
  for (const auto& [key, value] : reported) print("  {}: {}\n", readable(key), readable(value));
}

// Columns only: the contents of files are long, and in the log.
Json setup_json(const LoggedSetup& logged) {
  const Json all = Json::parse(to_json(logged.setup));
  Json columns{{"from_event", logged.from_event}};
  for (const auto& [key, value] : all.items())
    if (!key.ends_with("_text")) columns[key] = value;
  return columns;
}

Json as_json(const Shown& shown) {
  Json json = as_json(shown.facts);
  json["seed"] = shown.facts.row.header.seed;
  json["blocks"] = Json::array();
  for (const BlockProgress& block : progress_of(shown.trials))
    json["blocks"].push_back(
        {{"block", block.block}, {"n_completed", block.n_completed}, {"n_void", block.n_void}});
  json["voids"] = Json::array();
  for (const TrialRow& trial : shown.trials)
    if (trial.status == TrialStatus::voided)
      json["voids"].push_back({{"trial_number", trial.plan.trial_number},
                               {"attempt", trial.plan.attempt},
                               {"t_s", trial.ended_s.value_or(trial.started_s)},
                               {"reason", trial.void_reason.value_or("")}});
  json["setups"] = Json::array();
  for (const LoggedSetup& setup : shown.setups) json["setups"].push_back(setup_json(setup));
  json["checks"] = Json::array();
  json["events"] = Json::array();
  for (const auto& [event, attempt] : shown.events) {
    if (const auto* check = event.as<CheckResult>())
      json["checks"].push_back({{"t_s", event.t_s},
                                {"name", check->name},
                                {"verdict", name_of(check->verdict)},
                                {"finding", check->finding}});
    if (!is_listed(event)) continue;
    const EventRow row = row_of(event);
    json["events"].push_back(
        {{"t_s", row.t_s}, {"kind", name_of(row.kind)}, {"detail", row.detail}});
  }
  json["participant_info"] = Json::object();
  for (const auto& [key, value] : participant_reports(shown.facts.row))
    json["participant_info"][key] = value;
  return json;
}

// " at 2026-11-28T20:03:01.974Z"; empty if the log does not have it.
std::string withdrawal_time(const SessionHeader& header) {
  const Json kept = Json::parse(header.run_options, nullptr, false);
  const auto when = kept.find("withdrawn_utc");
  return when != kept.end() && when->is_string() ? " at " + when->get<std::string>() : "";
}

void show(const std::string& db, std::optional<std::int64_t> session_id, bool json) {
  const Shown shown = shown_of(db, session_id);
  if (json)
    return fmt::print("{}\n", as_json(shown).dump(2, ' ', false, Json::error_handler_t::replace));
  if (shown.facts.row.state == SessionState::withdrawn)
    return print("session {}: its data were withdrawn{}; head of the log: {}\n",
                 shown.facts.row.session_id, withdrawal_time(shown.facts.row.header),
                 short_head(shown.facts.head));
  print_head(shown.facts);
  print_pictures(shown.facts.pictures);
  print_progress(shown.trials);
  print_setups(shown.setups);
  print_checks(shown.events);
  print_course(shown.events);
  print_info(shown.facts.row);
  flush_output();
  say("\n");
  for (const std::string& step : next_steps({shown.facts}, db)) say("{}\n", step);
}
}  // namespace

void add_show(Command& app) {
  struct ShowOptions {
    std::string db;
    std::optional<std::int64_t> session;
    bool json = false;
  };
  const auto options = std::make_shared<ShowOptions>();
  Command command =
      app.add_command("show", "one session: progress, configuration, checks, notes, void trials",
                      {"heft show --db lab.db", "heft show --db lab.db --session 3 --json"});
  command.add_log(options->db);
  command.add_session(options->session, "the newest one");
  command.add_flag("--json", options->json, "JSON on stdout instead of text");
  command.does([options] { show(options->db, options->session, options->json); });
}

}  // namespace heft::cli
