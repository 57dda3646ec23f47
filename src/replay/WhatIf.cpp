#include "replay/WhatIf.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "replay/AttemptReplay.h"

namespace heft {

namespace {

// Root of mean square and largest of the distances given to it.
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
};

void add_attempt(const AttemptFold& attempt, const std::vector<FrameRow>& frames,
                 const Protocol& protocol, Paths& paths) {
  AttemptReplay replay(protocol, attempt);
  for (const FrameRow& frame : frames) {
    const ShownFrame shown = replay.advance(frame);
    ++paths.n_pictures;
    if (frame.clone && shown.frame.clone) paths.clone.add(*frame.clone, *shown.frame.clone);
    for (std::size_t i = 0; i < std::min(frame.cubes.size(), shown.frame.cubes.size()); ++i)
      paths.cubes.add(frame.cubes[i], shown.frame.cubes[i]);
  }
}

bool is_right(const TrialRow& row) {
  return row.plan.task == Task::comparison ? row.choice_correct.value_or(false)
                                           : row.outcome == Outcome::correct;
}

using Kind = std::pair<Task, std::string>;

void count(const std::vector<TrialRow>& rows, std::map<Kind, OutcomeDifference>& outcomes,
           int OutcomeDifference::*n, int OutcomeDifference::*n_correct) {
  for (const TrialRow& row : rows) {
    if (row.status != TrialStatus::completed) continue;
    OutcomeDifference& outcome = outcomes[{row.plan.task, row.plan.condition}];
    outcome.task = row.plan.task;
    outcome.condition = row.plan.condition;
    ++(outcome.*n);
    if (is_right(row)) ++(outcome.*n_correct);
  }
}

}  // namespace

std::vector<PathDifference> compare_paths(const LogReader& reader, const LoggedSession& session,
                                          const Protocol& protocol) {
  const std::int64_t session_id = session.row.session_id;
  const Projection fold = fold_session(session.protocol, session.row.header.seed,
                                       reader.events(session_id), session.before());
  std::map<Kind, Paths> by_kind;
  for (const auto& [index, attempt] : fold.attempts)
    add_attempt(attempt, reader.frames(session_id, index), protocol,
                by_kind[{attempt.first_plan.task, attempt.first_plan.condition}]);
  std::vector<PathDifference> differences;
  for (const auto& [kind, paths] : by_kind)
    differences.push_back({kind.first, kind.second, paths.n_pictures, paths.clone.rms_m(),
                           paths.clone.largest_m, paths.cubes.rms_m(), paths.cubes.largest_m});
  return differences;
}

OtherResponder compare_sessions(const LogReader& reader, std::int64_t session_id,
                                const RecordedSession& anew) {
  std::vector<TrialRow> trials;
  std::map<std::string, EstimateDifference> estimates;
  for (const EstimateRow& row : reader.estimates(session_id))
    estimates[row.staircase] = {row.staircase, row.jnd_g, std::nullopt};
  for (const RecordedEntry& entry : anew.entries()) {
    const auto* recorded = std::get_if<RecordedEvent>(&entry);
    if (!recorded) continue;
    if (recorded->changes.trial) trials.push_back(*recorded->changes.trial);
    for (const EstimateRow& row : recorded->changes.estimates) {
      estimates[row.staircase].staircase = row.staircase;
      estimates[row.staircase].would_be_g = row.jnd_g;
    }
  }
  std::map<Kind, OutcomeDifference> outcomes;
  count(reader.trials(session_id), outcomes, &OutcomeDifference::n_logged,
        &OutcomeDifference::n_logged_correct);
  count(trials, outcomes, &OutcomeDifference::n_would_be, &OutcomeDifference::n_would_be_correct);
  OtherResponder other;
  for (const auto& [kind, outcome] : outcomes) other.outcomes.push_back(outcome);
  for (const auto& [name, estimate] : estimates) other.estimates.push_back(estimate);
  return other;
}

}  // namespace heft
