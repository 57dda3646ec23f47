// Sessions made up row by row, as a log would give them.
#pragma once

#include <string>
#include <vector>

#include "analysis/dataset/Dataset.h"

namespace heft::made_up {

inline SessionData session(std::int64_t id, const std::string& participant,
                           Purpose purpose = Purpose::main,
                           const std::string& responder = "human") {
  SessionData data;
  data.session.session_id = id;
  data.session.header.participant = participant;
  data.session.header.protocol_name = "paper";
  data.session.header.protocol_sha256 = "0123456789abcdef";
  data.session.header.purpose = purpose;
  data.session.header.responder = responder;
  LoggedSetup logged{1, 1, {}};
  from_text(responder, logged.setup.responder);
  data.setups = {logged};
  data.published_conditions = {{"C1", published::Condition::coupled},
                               {"C2", published::Condition::decoupled}};
  data.session.state = SessionState::finished;
  return data;
}

inline std::vector<CubeRow> cubes(const std::vector<double>& masses_g) {
  std::vector<CubeRow> rows;
  for (double mass_g : masses_g) {
    CubeRow row;
    row.slot = static_cast<int>(rows.size()) + 1;
    row.mass_g = mass_g;
    rows.push_back(row);
  }
  return rows;
}

inline Attempt& add_attempt(SessionData& data, const Task& task,
                            const std::vector<double>& masses_g) {
  Attempt attempt;
  attempt.trial.attempt_index = static_cast<int>(data.attempts.size()) + 1;
  attempt.trial.setup_index = 1;
  attempt.trial.plan.trial_number = attempt.trial.attempt_index;
  attempt.trial.plan.task = task;
  attempt.trial.status = TrialStatus::completed;
  attempt.cubes = cubes(masses_g);
  data.attempts.push_back(attempt);
  return data.attempts.back();
}

inline AnswerRow label(int slot, const Label& given) {
  AnswerRow row;
  row.action = "label";
  row.slot = slot;
  row.label = given;
  return row;
}

inline AnswerRow select(int slot) {
  AnswerRow row;
  row.action = "select";
  row.slot = slot;
  return row;
}

inline Attempt& add_sorting(SessionData& data, const std::string& condition,
                            const Outcome& outcome) {
  Attempt& attempt = add_attempt(data, "sorting", {15, 200, 800});
  attempt.trial.plan.condition = condition;
  attempt.trial.outcome = outcome;
  return attempt;
}

inline void add_sortings(SessionData& data, const std::string& condition, const Outcome& outcome,
                         int n) {
  for (int i = 0; i < n; ++i) add_sorting(data, condition, outcome);
}

inline Attempt& add_introduction(SessionData& data, int n_selects) {
  Attempt& attempt = add_attempt(data, "introduction", {15, 800});
  for (int i = 0; i < n_selects; ++i) attempt.answers.push_back(select(2));
  attempt.trial.outcome = "correct";
  return attempt;
}

/// A comparison whose answer is "no difference".
inline Attempt& add_comparison(SessionData& data, const std::string& staircase, double reference_g,
                               double level_g) {
  Attempt& attempt = add_attempt(data, "comparison", {reference_g, reference_g + level_g});
  attempt.trial.plan.staircase = staircase;
  attempt.trial.plan.reference_g = reference_g;
  attempt.trial.plan.level_g = level_g;
  attempt.trial.plan.reference_slot = 1;
  attempt.trial.outcome = "no_difference";
  return attempt;
}

inline void choose(Attempt& attempt, bool rightly) {
  attempt.trial.outcome = "difference";
  attempt.trial.chosen_slot = rightly ? 2 : 1;
  attempt.trial.choice_correct = rightly;
}

/// The estimate of a staircase with one trial.
inline void add_staircase(SessionData& data, const std::string& staircase, double reference_g,
                          double jnd_g, int n_trials = 20) {
  add_comparison(data, staircase, reference_g, jnd_g);
  EstimateRow row;
  row.staircase = staircase;
  row.method = "mean_of_reversals";
  row.jnd_g = jnd_g;
  row.n_trials = n_trials;
  row.n_reversals = 10;
  row.reason = StopReason::reversals;
  data.estimates.push_back(row);
}

}  // namespace heft::made_up
