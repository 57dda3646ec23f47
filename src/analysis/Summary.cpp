#include "analysis/Summary.h"

#include <algorithm>
#include <set>

#include "analysis/Notes.h"

namespace heft {

namespace {
SessionSummary summary_of(const SessionData& data) {
  const SessionHeader& header = data.session.header;
  SessionSummary summary{data.session.session_id,        header.participant,
                         header.protocol_name,           std::string(name_of(header.purpose)),
                         data.model().value_or("human"), data.session.state};
  for (const Attempt& attempt : data.attempts) {
    summary.n_completed += attempt.trial.status == TrialStatus::completed ? 1 : 0;
    summary.n_void += attempt.trial.status == TrialStatus::voided ? 1 : 0;
    summary.n_open += attempt.trial.status == TrialStatus::open ? 1 : 0;
  }
  return summary;
}

std::string kind_of_data(const std::vector<SessionData>& sessions) {
  if (sessions.empty()) return "";
  const auto n_simulated = static_cast<std::size_t>(
      std::ranges::count_if(sessions, [](const SessionData& data) { return data.simulated(); }));
  if (n_simulated == 0) return "human";
  return n_simulated == sessions.size() ? "simulated" : "human and simulated";
}

int n_participants(std::span<const SessionData> sessions) {
  std::set<std::string> participants;
  for (const SessionData& data : sessions) participants.insert(data.participant());
  return static_cast<int>(participants.size());
}
}  // namespace

Summary summarize(const Dataset& dataset, const std::string& command) {
  Summary summary;
  summary.database = dataset.database;
  summary.command = command;
  summary.data = kind_of_data(dataset.sessions);
  for (const SessionData& data : dataset.sessions) summary.sessions.push_back(summary_of(data));
  summary.participants = participants_of(dataset.sessions);
  summary.plan = declared_plan(dataset.sessions);
  summary.quality = quality_of(dataset.sessions);
  std::vector<SessionData> kept;  // a copy only where somebody is left out
  std::span<const SessionData> sessions = dataset.sessions;
  if (std::ranges::any_of(summary.participants, &ParticipantRow::excluded))
    sessions = kept = included(sessions, summary.participants);
  summary.n_participants = n_participants(sessions);
  summary.sorting = sorting_of(sessions);
  summary.introduction = introduction_of(sessions);
  summary.jnd = jnd_of(sessions);
  summary.sensitivity = sensitivities_of(sessions);
  summary.staircases = staircase_results(sessions);
  summary.comparison = comparisons_of(sessions);
  summary.times = response_times(sessions);
  summary.voids = voids_of(sessions);
  summary.tracks = example_tracks(sessions);
  summary.all_tracks = all_tracks(sessions);
  summary.points = points_of(sessions);
  summary.thresholds = thresholds_of(folded<ComparisonTrials>(sessions),
                                     folded<StaircaseFold>(sessions), summary.sensitivity);
  summary.tracking = tracking_of(dataset.sessions);
  summary.flow = flow_of(dataset.sessions, summary.participants);
  summary.hypotheses = hypotheses_of(summary);
  summary.choices = protocol_choices(dataset.sessions);
  summary.notes = notes_on(dataset, summary);
  return summary;
}

Summary analyze(const AnalysisOptions& options) {
  const Dataset dataset = read_dataset(options.database, options.session_ids);
  if (!options.mix) refuse_mixed_purposes(dataset);
  return summarize(dataset, options.command);
}

}  // namespace heft
