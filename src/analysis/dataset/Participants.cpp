#include "analysis/dataset/Participants.h"

#include <fmt/format.h>

#include "analysis/dataset/Quality.h"

namespace heft {

namespace {
void count_attempt(ParticipantRow& row, const SessionData& data, const Attempt& attempt) {
  row.n_lost += attempt.trial.lost_s > 0 ? 1 : 0;
  if (!attempt.completed()) return;
  row.n_completed += 1;
  row.n_anticipatory += is_anticipatory(data, attempt) ? 1 : 0;
  if (!attempt.trial.plan.is_catch) return;
  row.n_catch += 1;
  row.n_false_alarms += attempt.trial.outcome == "difference" ? 1 : 0;
}

std::string beyond(int n, int of, const std::optional<double>& largest, std::string_view what) {
  if (!largest || of == 0 || n <= *largest * of) return "";
  return fmt::format("{}: {} of {}, the protocol allows {:g} %", what, n, of, 100 * *largest);
}

std::string why_excluded(const ParticipantRow& row, int n_attempts, const ExclusionRules& rules) {
  if (rules.unfinished && row.n_finished == 0) return "no finished session";
  for (const std::string& why :
       {beyond(row.n_anticipatory, row.n_completed, rules.anticipatory_responses,
               "anticipatory responses"),
        beyond(row.n_false_alarms, row.n_catch, rules.false_alarms, "false alarms"),
        beyond(row.n_lost, n_attempts, rules.out_of_view, "effector out of view")})
    if (!why.empty()) return why;
  return "";
}
}  // namespace

void ParticipantsCollector::add(const SessionData& data) {
  const std::string name = data.participant();
  const auto [found, is_new] = participants_.try_emplace(name);
  Seen& seen = found->second;
  if (is_new) seen.rules = data.exclusion;
  seen.row.participant = name;
  seen.row.n_sessions += 1;
  seen.row.n_finished += data.finished() ? 1 : 0;
  for (const Attempt& attempt : data.attempts) count_attempt(seen.row, data, attempt);
  seen.n_attempts += static_cast<int>(data.attempts.size());
}

std::vector<ParticipantRow> ParticipantsCollector::result() const {
  std::vector<ParticipantRow> rows;
  for (const auto& [name, seen] : participants_) {
    rows.push_back(seen.row);
    rows.back().excluded_because = why_excluded(seen.row, seen.n_attempts, seen.rules);
  }
  return rows;
}

void PlanCollector::add(const SessionData& data) {
  differ_ = differ_ || !data.plan ||
            (plan_ && (plan_->tested != data.plan->tested ||
                       plan_->equivalence_margin != data.plan->equivalence_margin));
  plan_ = data.plan;
}

std::string in_short(const std::string& why) {
  return why.substr(0, why.find(':'));
}

void FlowCollector::add(const SessionData& data) {
  Course& course = courses_[data.participant()];
  course.declined = course.declined || !data.events.consented.value_or(true);
  course.agreed = course.agreed || data.events.consented.value_or(false);
  course.started = course.started || !data.attempts.empty() || data.n_practice > 0;
  n_practice_trials_ += data.n_practice;
  course.finished = course.finished || data.finished();
  course.last = data.session.state;
}

ParticipantFlow FlowCollector::result(std::span<const ParticipantRow> participants,
                                      int n_withdrawn) const {
  ParticipantFlow flow;
  flow.n_asked = static_cast<int>(courses_.size()) + n_withdrawn;
  flow.n_withdrawn = n_withdrawn;
  flow.n_practice_trials = n_practice_trials_;
  for (const auto& [participant, course] : courses_) {
    flow.n_declined += course.declined && !course.agreed && !course.started ? 1 : 0;
    flow.n_started += course.started ? 1 : 0;
    flow.n_finished += course.started && course.finished ? 1 : 0;
    if (course.started && !course.finished) flow.unfinished[std::string(name_of(course.last))] += 1;
  }
  for (const ParticipantRow& row : participants) {
    if (row.excluded()) flow.excluded[in_short(row.excluded_because)] += 1;
    flow.n_analyzed += !row.excluded() && courses_.at(row.participant).started ? 1 : 0;
  }
  return flow;
}

}  // namespace heft
