#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/Error.h"
#include "base/files/Printable.h"
#include "cli/console/Terminal.h"
#include "cli/reports/Reports.h"
#include "protocol/Protocol.h"

namespace heft::cli {

namespace {
// Expected trials of the session's protocol with its settings.
std::optional<double> planned_trials(const LogReader& reader, const SessionRow& row) try {
  const auto setups = reader.setups(row.session_id);
  const auto settings =
      setups.empty() ? std::vector<ProtocolSetting>{} : setups.front().setup.settings;
  return total_of(expected_trials(
      parse_protocol(row.header.protocol_text, row.header.protocol_name, settings)));
} catch (const Error&) {
  return std::nullopt;
}
}  // namespace

SessionFacts facts_of(const LogReader& reader, const SessionRow& row) {
  SessionFacts facts;
  facts.row = row;
  for (const TrialRow& trial : reader.trials(row.session_id)) {
    facts.n_completed += trial.status == TrialStatus::completed ? 1 : 0;
    facts.n_void += trial.status == TrialStatus::voided ? 1 : 0;
  }
  const auto events = reader.events(row.session_id);
  if (!events.empty()) facts.duration_s = events.back().event.t_s;
  facts.pictures = count_pictures(events);
  if (is_unfinished(row.state)) facts.planned_trials = planned_trials(reader, row);
  facts.place = place_of(row.header.participant_info);
  facts.head = reader.head_of(row.session_id);
  return facts;
}

std::string trials_text(const SessionFacts& facts) {
  if (!facts.planned_trials) return fmt::format("{}", facts.n_completed);
  return of_about(facts.n_completed, *facts.planned_trials);
}

nlohmann::ordered_json as_json(const SessionFacts& facts) {
  const SessionHeader& header = facts.row.header;
  nlohmann::ordered_json json{{"session_id", facts.row.session_id},
                              {"participant", header.participant},
                              {"protocol_name", header.protocol_name},
                              {"protocol_sha256", header.protocol_sha256},
                              {"purpose", name_of(header.purpose)},
                              {"responder", header.responder},
                              {"state", name_of(facts.row.state)},
                              {"n_completed", facts.n_completed},
                              {"n_void", facts.n_void},
                              {"planned_trials", nullptr},
                              {"started_utc", header.started_utc},
                              {"duration_s", facts.duration_s},
                              {"n_pictures", facts.pictures.shown},
                              {"n_dropped", facts.pictures.dropped},
                              {"n_late", facts.pictures.late},
                              {"n_doubled", facts.pictures.doubled},
                              {"head", facts.head},
                              {"study", nullptr}};
  if (facts.planned_trials) json["planned_trials"] = *facts.planned_trials;
  if (const auto& place = facts.place)
    json["study"] = {{"name", place->study},
                     {"place", place->number},
                     {"participants", place->participants},
                     {"group", place->group},
                     {"order", place->order}};
  return json;
}

void warn_of_fault(const std::optional<std::string>& fault, const std::string& db) {
  if (fault)
    say("heft: WARNING: {} was changed or damaged: {}. heft analyse refuses it. Inspect it with: "
        "heft replay --db {}\n",
        db, *fault, shell_quoted(db));
}

std::vector<std::string> next_steps(const std::vector<SessionFacts>& sessions,
                                    const std::string& db) {
  const std::string log = shell_quoted(db);
  std::vector<std::string> steps;
  bool any_ended = false;
  for (const SessionFacts& facts : sessions) {
    if (is_unfinished(facts.row.state))
      steps.push_back(fmt::format("resume participant {}: heft resume --db {} --session {}",
                                  facts.row.header.participant, log, facts.row.session_id));
    else
      any_ended = true;
  }
  if (sessions.size() == 1 && any_ended)
    steps.push_back(fmt::format("results: heft analyse --db {} --session {}", log,
                                sessions.front().row.session_id));
  else if (any_ended)
    steps.push_back(fmt::format("results: heft analyse --db {}", log));
  if (any_ended) steps.push_back(fmt::format("for other programs: heft export {} --out data", log));
  return steps;
}

}  // namespace heft::cli
