#include "replay/WhatIf.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "replay/AttemptReplay.h"
#include "tasks/Task.h"

namespace heft {

namespace {

// Root mean square and maximum of distances.
struct Distances {
  int n = 0;
  double sum_squared_m2 = 0, largest_m = 0;

  void add(const Pose& a, const Pose& b) {
    const double distance_m = (a.position_m - b.position_m).norm();
    ++n;
    sum_squared_m2 += distance_m * distance_m;
    largest_m = std::max(largest_m, distance_m);
  }
  double rms_m() const { return n == 0 ? 0 : std::sqrt(sum_squared_m2 / n); }
};

struct Paths {
  int n_pictures = 0;
  Distances clone, cubes;
  CuesByMass logged, would_be;
};

void add_attempt(const ProjectedAttempt& attempt, const std::vector<FrameRow>& frames,
                 const Protocol& protocol, Paths& paths) {
  AttemptReplay replay(protocol, attempt);
  CueMeter logged(paths.logged), would_be(paths.would_be);
  const std::vector<double>* masses_g = &attempt.first_plan.masses_g;
  auto event = attempt.events.begin();
  for (const FrameRow& frame : frames) {
    for (; event != attempt.events.end() && event->before < frame.after_event; ++event)
      if (event->plan_after.n_reshuffles > 0) masses_g = &event->plan_after.masses_g;
    const ShownFrame shown = replay.advance(frame);
    logged.add(displayed(frame), frame.contact_slot, *masses_g);
    would_be.add(shown.frame, shown.contact_slot, *masses_g);
    ++paths.n_pictures;
    if (frame.clone && shown.frame.clone) paths.clone.add(*frame.clone, *shown.frame.clone);
    for (std::size_t i = 0; i < std::min(frame.cubes.size(), shown.frame.cubes.size()); ++i)
      paths.cubes.add(frame.cubes[i], shown.frame.cubes[i]);
  }
}

bool is_right(const TrialRow& row) {
  return row.choice_correct.value_or(row.outcome == "correct");
}

using Kind = std::pair<Task, std::string>;

void count(const std::vector<TrialRow>& rows,
           std::map<Kind, OutcomeDifference, InTaskOrder>& outcomes, int OutcomeDifference::*n,
           int OutcomeDifference::*n_correct) {
  for (const TrialRow& row : rows) {
    if (row.status != TrialStatus::completed) continue;
    OutcomeDifference& outcome = outcomes[{row.plan.task, row.plan.condition}];
    outcome.task = row.plan.task;
    outcome.condition = row.plan.condition;
    ++(outcome.*n);
    if (is_right(row)) ++(outcome.*n_correct);
  }
}

std::vector<CueDifference> cue_differences(const Paths& paths) {
  std::map<double, CueDifference> by_mass;
  for (const auto& [mass_g, cues] : paths.logged) by_mass[mass_g].logged = cues;
  for (const auto& [mass_g, cues] : paths.would_be) by_mass[mass_g].would_be = cues;
  std::vector<CueDifference> differences;
  for (auto& [mass_g, difference] : by_mass) {
    difference.mass_g = mass_g;
    differences.push_back(difference);
  }
  return differences;
}

}  // namespace

std::optional<double> grams_per_lag(const Protocol& protocol, const std::string& technique) {
  constexpr double g_per_kg = 1000;
  const Scene scene = scene_of(protocol, technique, {});
  if (!scene.coupling.decoupled) return std::nullopt;
  return g_per_kg * scene.coupling.stiffness_n_per_m / (scene.friction * scene.gravity_m_s2);
}

std::vector<PathDifference> compare_paths(const LogReader& reader, const LoggedSession& session,
                                          const Protocol& protocol) {
  const std::int64_t session_id = session.row.session_id;
  const Projection fold = sound_fold(reader, session);
  std::map<Kind, Paths, InTaskOrder> by_kind;
  for (const auto& [index, attempt] : fold.attempts)
    add_attempt(attempt, reader.frames(session_id, index), protocol,
                by_kind[{attempt.first_plan.task, attempt.first_plan.condition}]);
  std::vector<PathDifference> differences;
  for (const auto& [kind, paths] : by_kind)
    differences.push_back({kind.first, kind.second, paths.n_pictures, paths.clone.rms_m(),
                           paths.clone.largest_m, paths.cubes.rms_m(), paths.cubes.largest_m,
                           cue_differences(paths), grams_per_lag(*session.protocol, kind.second),
                           grams_per_lag(protocol, kind.second)});
  return differences;
}

OtherResponder compare_sessions(const LogReader& reader, std::int64_t session_id,
                                const RecordedSession& rerun) {
  std::vector<TrialRow> trials;
  std::map<std::string, EstimateDifference> estimates;
  for (const EstimateRow& row : reader.estimates(session_id))
    estimates[row.staircase] = {row.staircase, row.jnd_g, std::nullopt};
  for (const RecordedEntry& entry : rerun.entries()) {
    const auto* recorded = std::get_if<RecordedEvent>(&entry);
    if (!recorded) continue;
    if (recorded->changes.trial) trials.push_back(*recorded->changes.trial);
    for (const EstimateRow& row : recorded->changes.estimates) {
      estimates[row.staircase].staircase = row.staircase;
      estimates[row.staircase].would_be_g = row.jnd_g;
    }
  }
  std::map<Kind, OutcomeDifference, InTaskOrder> outcomes;
  count(reader.trials(session_id), outcomes, &OutcomeDifference::n_logged,
        &OutcomeDifference::n_logged_correct);
  count(trials, outcomes, &OutcomeDifference::n_would_be, &OutcomeDifference::n_would_be_correct);
  OtherResponder other;
  for (const auto& [kind, outcome] : outcomes) other.outcomes.push_back(outcome);
  for (const auto& [name, estimate] : estimates) other.estimates.push_back(estimate);
  return other;
}

}  // namespace heft
