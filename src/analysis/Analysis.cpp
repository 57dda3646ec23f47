#include "analysis/Analysis.h"

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "analysis/measures/Section.h"
#include "analysis/report/Notes.h"

namespace heft {

namespace {
/// Visits all sessions in order; can be called repeatedly.
using EachSession = std::function<void(const std::function<void(const SessionData&)>&)>;

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
  summary.pictures = data.pictures;
  return summary;
}

// Data of all participants, with excluded ones.
struct EveryoneCollector {
  ParticipantsCollector participants;
  PlanCollector plan;
  QualityCollector quality;
  FlowCollector flow;
  ChoicesCollector choices;
  NotesCollector notes;
  SetupsCollector setups;
  IncidentsCollector incidents;
  std::vector<SessionSummary> sessions;
  std::map<std::string, published::Comparable> comparable;
  std::size_t n_simulated = 0;

  void add(const SessionData& data) {
    participants.add(data);
    plan.add(data);
    quality.add(data);
    flow.add(data);
    choices.add(data);
    notes.add(data);
    setups.add(data);
    incidents.add(data);
    sessions.push_back(summary_of(data));
    for (const Attempt& attempt : data.attempts) {
      const std::string& condition = attempt.trial.plan.condition;
      comparable[condition].add(data.published_condition(condition), true);
    }
    n_simulated += data.simulated() ? 1 : 0;
  }

  std::string kind_of_data() const {
    if (sessions.empty()) return "";
    if (n_simulated == 0) return "human";
    return n_simulated == sessions.size() ? "simulated" : "human and simulated";
  }
};

// The figures, of participants who are not excluded.
struct IncludedCollector {
  std::set<std::string> participants;
  std::shared_ptr<SharedCollectors> shared = std::make_shared<SharedCollectors>();
  TracksCollector tracks;
  std::vector<std::shared_ptr<Section>> sections = all_sections();

  void add(const SessionData& data, bool counts = true) {
    for (const auto& section : sections)
      if (counts || section->of_everyone()) section->add(data);
    if (!counts) return;
    participants.insert(data.participant());
    shared->comparisons.add(data);
    shared->staircases.add(data);
    shared->judgments.add(data);
    tracks.add(data);
  }

  void put(Summary& summary) && {
    summary.n_participants = static_cast<int>(participants.size());
    summary.shared = shared;
    for (const auto& section : sections) {
      section->put(summary);
      summary.sections.push_back(section);
    }
    summary.all_tracks = std::move(tracks).result();
    for (const ReferenceJnd& row : shared->judgments.jnds())
      if (!row.overall.why_withheld.empty()) remove_estimates(summary.all_tracks, row.compared);
  }
};

// Exclusion is known only after the last session; if someone is excluded, sessions are read again.
IncludedCollector counted_of(IncludedCollector&& all, const EachSession& each,
                             std::span<const ParticipantRow> participants) {
  if (std::ranges::none_of(participants, &ParticipantRow::excluded)) return std::move(all);
  std::set<std::string> excluded;
  for (const ParticipantRow& row : participants)
    if (row.excluded()) excluded.insert(row.participant);
  IncludedCollector counted;
  each([&](const SessionData& data) { counted.add(data, !excluded.contains(data.participant())); });
  return counted;
}

// @param summary with database, command and integrity  @param n_withdrawn sessions without data
Summary summarize(Summary summary, const EachSession& each, int n_withdrawn) {
  EveryoneCollector everybody;
  IncludedCollector all;
  each([&](const SessionData& data) {
    everybody.add(data);
    all.add(data);
  });
  summary.data = everybody.kind_of_data();
  summary.participants = everybody.participants.result();
  summary.plan = everybody.plan.result();
  summary.quality = everybody.quality.result();
  summary.flow = everybody.flow.result(summary.participants, n_withdrawn);
  summary.protocols = everybody.choices.protocols();
  summary.choices = everybody.choices.result();
  summary.setups = everybody.setups.result();
  summary.incidents = everybody.incidents.result();
  summary.sessions = std::move(everybody.sessions);
  summary.comparable = std::move(everybody.comparable);
  counted_of(std::move(all), each, summary.participants).put(summary);
  summary.hypotheses = hypotheses_of(summary);
  summary.notes = everybody.notes.result(summary);
  return summary;
}
}  // namespace

Summary summarize(const Dataset& dataset, const std::string& command) {
  const auto each = [&](const std::function<void(const SessionData&)>& use) {
    std::ranges::for_each(dataset.sessions, use);
  };
  Summary summary;
  summary.database = dataset.database;
  summary.command = command;
  return summarize(std::move(summary), each, 0);
}

Summary analyze(const AnalysisOptions& options) {
  const LoggedSessions sessions(options.databases, options.session_ids);
  if (!options.mix) refuse_mixed_purposes(sessions);
  const auto each = [&](const std::function<void(const SessionData&)>& use) { sessions.each(use); };
  Summary summary;
  summary.database = sessions.database();
  summary.command = options.command;
  summary.integrity = options.integrity;
  summary.checks_models = options.check_models;
  return summarize(std::move(summary), each, sessions.n_withdrawn());
}

}  // namespace heft
