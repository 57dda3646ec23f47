#include "analysis/Jnd.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "analysis/Published.h"
#include "protocol/Protocol.h"
#include "protocol/TomlDocument.h"
#include "psychophysics/Procedure.h"

namespace heft {

namespace {
// What each of a session's staircases that estimate a JND compared with, from its trials.
std::map<std::string, Compared> compared_by(const SessionData& data) {
  std::map<std::string, Compared> staircases;
  for (const Attempt& attempt : data.attempts) {
    const TrialPlan& plan = attempt.trial.plan;
    if (plan.task == Task::comparison && !plan.staircase.empty() && plan.reference_g &&
        !data.without_jnd.contains(plan.staircase))
      staircases.emplace(plan.staircase, Compared{*plan.reference_g, plan.condition});
  }
  return staircases;
}

// A damaged log may hold an infinite JND: that is none.
std::optional<double> finite(std::optional<double> value) {
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::vector<StaircaseResult> results_of(const SessionData& data) {
  const auto staircases = compared_by(data);
  std::vector<StaircaseResult> results;
  for (const EstimateRow& row : data.estimates) {
    const auto compared = staircases.find(row.staircase);
    if (row.method != jnd_method || compared == staircases.end()) continue;
    results.push_back({data.session.session_id, data.participant(), row.staircase, compared->second,
                       finite(row.jnd_g), row.n_trials, row.n_reversals, row.n_floor, row.n_ceiling,
                       row.reason == Finish::trials});
  }
  return results;
}

// Staircases of one session first, then sessions: a participant counts once.
std::vector<ParticipantJnd> participants_of(std::span<const StaircaseResult> results) {
  std::map<std::string, std::map<std::int64_t, std::vector<double>>> jnds;
  for (const StaircaseResult& result : results)
    if (result.jnd_g) jnds[result.participant][result.session_id].push_back(*result.jnd_g);
  std::vector<ParticipantJnd> participants;
  for (const auto& [participant, sessions] : jnds) {
    std::vector<double> session_means;
    for (const auto& [id, values] : sessions) session_means.push_back(*mean(values));
    participants.push_back({participant, *mean(session_means)});
  }
  return participants;
}

void add_staircase(ReferenceJnd& jnd, const StaircaseResult& result) {
  jnd.n_staircases += 1;
  jnd.n_without_estimate += result.jnd_g ? 0 : 1;
  jnd.mean_trials += (result.n_trials - jnd.mean_trials) / jnd.n_staircases;
  jnd.least_trials = std::min(jnd.least_trials, result.n_trials);
  jnd.most_trials = std::max(jnd.most_trials, result.n_trials);
  jnd.n_trial_limit += result.at_trial_limit ? 1 : 0;
  jnd.n_floor += result.n_floor;
  jnd.n_ceiling += result.n_ceiling;
  jnd.n_floor_staircases += result.n_floor > 0 ? 1 : 0;
  jnd.n_ceiling_staircases += result.n_ceiling > 0 ? 1 : 0;
}

ReferenceJnd jnd_at(const Compared& compared, std::span<const StaircaseResult> results,
                    int n_started) {
  ReferenceJnd jnd;
  jnd.compared = compared;
  jnd.least_trials = results.empty() ? 0 : std::numeric_limits<int>::max();
  for (const StaircaseResult& result : results) add_staircase(jnd, result);
  jnd.n_unfinished = n_started - jnd.n_staircases;
  jnd.participants = participants_of(results);
  std::vector<double> values;
  for (const ParticipantJnd& participant : jnd.participants) values.push_back(participant.jnd_g);
  jnd.mean_g = mean(values);
  jnd.sd_g = sample_sd(values);
  if (jnd.sd_g.value_or(0) > 0) jnd.interval_g = student_t_interval(values);
  const auto figure = published::jnd_at(compared.reference_g);
  if (figure && compared.condition == "C2") {
    jnd.published_g = figure->mean_g;
    jnd.published_sd_g = figure->sd_g;
  }
  return jnd;
}
}  // namespace

std::set<std::string> staircases_without_jnd(const std::string& protocol_text) {
  std::set<std::string> names;
  try {
    for (const Block& block : parse_protocol(protocol_text, "protocol").blocks)
      if (const auto* comparison = std::get_if<ComparisonBlock>(&block))
        for (const ReferenceStaircase& entry : comparison->staircases)
          if (!std::ranges::count(Procedure(entry.staircase).estimates(), jnd_method,
                                  &Estimate::method))
            names.insert(entry.staircase.name);
  } catch (const InvalidFile&) {
  }
  return names;
}

std::vector<StaircaseResult> staircase_results(std::span<const SessionData> sessions) {
  std::vector<StaircaseResult> results;
  for (const SessionData& data : sessions)
    for (StaircaseResult& result : results_of(data)) results.push_back(std::move(result));
  return results;
}

std::vector<ReferenceJnd> jnd_of(std::span<const SessionData> sessions) {
  std::map<Compared, std::vector<StaircaseResult>> finished;
  std::map<Compared, int> n_started;
  for (const SessionData& data : sessions)
    for (const auto& [staircase, compared] : compared_by(data)) n_started[compared] += 1;
  for (const StaircaseResult& result : staircase_results(sessions))
    finished[result.compared].push_back(result);
  std::vector<ReferenceJnd> jnds;
  for (const auto& [compared, n] : n_started)
    jnds.push_back(jnd_at(compared, finished[compared], n));
  return jnds;
}

}  // namespace heft
