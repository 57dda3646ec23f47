#include "analysis/Exclusion.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "analysis/Quality.h"

namespace heft {

namespace {
void count_attempt(ParticipantRow& row, const SessionData& data, const Attempt& attempt) {
  row.n_lost += attempt.trial.lost_s > 0 ? 1 : 0;
  if (!attempt.completed()) return;
  row.n_completed += 1;
  row.n_impossible += is_impossible(data, attempt) ? 1 : 0;
  if (!attempt.trial.plan.is_catch) return;
  row.n_catch += 1;
  row.n_false_alarms += attempt.trial.outcome == Outcome::difference ? 1 : 0;
}

std::string beyond(int n, int of, const std::optional<double>& largest, std::string_view what) {
  if (!largest || of == 0 || n <= *largest * of) return "";
  return fmt::format("{}: {} of {}, the protocol allows {:g} %", what, n, of, 100 * *largest);
}

std::string why_excluded(const ParticipantRow& row, int n_attempts, const ExclusionRules& rules) {
  if (rules.unfinished && row.n_finished == 0) return "no finished session";
  for (const std::string& why :
       {beyond(row.n_impossible, row.n_completed, rules.impossible_answers, "impossible answers"),
        beyond(row.n_false_alarms, row.n_catch, rules.false_alarms, "false alarms"),
        beyond(row.n_lost, n_attempts, rules.out_of_view, "effector out of view")})
    if (!why.empty()) return why;
  return "";
}
}  // namespace

std::vector<ParticipantRow> participants_of(std::span<const SessionData> sessions) {
  struct Seen {
    ParticipantRow row;
    int n_attempts = 0;
    const ExclusionRules* rules = nullptr;
  };
  std::map<std::string, Seen> participants;
  for (const SessionData& data : sessions) {
    const std::string name = data.participant();
    Seen& seen = participants[name];
    seen.row.participant = name;
    if (!seen.rules) seen.rules = &data.exclusion;
    seen.row.n_sessions += 1;
    seen.row.n_finished += data.finished() ? 1 : 0;
    for (const Attempt& attempt : data.attempts) count_attempt(seen.row, data, attempt);
    seen.n_attempts += static_cast<int>(data.attempts.size());
  }
  std::vector<ParticipantRow> rows;
  for (auto& [name, seen] : participants) {
    seen.row.excluded_because = why_excluded(seen.row, seen.n_attempts, *seen.rules);
    rows.push_back(seen.row);
  }
  return rows;
}

std::vector<SessionData> included(std::span<const SessionData> sessions,
                                  std::span<const ParticipantRow> participants) {
  std::map<std::string, bool> excluded;
  for (const ParticipantRow& row : participants) excluded[row.participant] = row.excluded();
  std::vector<SessionData> kept;
  for (const SessionData& data : sessions)
    if (!excluded[data.participant()]) kept.push_back(data);
  return kept;
}

std::optional<AnalysisPlan> declared_plan(std::span<const SessionData> sessions) {
  std::optional<AnalysisPlan> plan;
  for (const SessionData& data : sessions) {
    if (!data.plan) return std::nullopt;
    if (plan && (plan->tested != data.plan->tested ||
                 plan->equivalence_margin != data.plan->equivalence_margin))
      return std::nullopt;
    plan = data.plan;
  }
  return plan;
}

}  // namespace heft
