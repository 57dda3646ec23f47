#include "replay/Projection.h"

#include <fmt/format.h>

namespace heft {

namespace {

void put(std::map<std::string, RowText>& rows, RowText row) {
  std::string key = row.table + ": " + row.key;
  // Attempts that crashed share trial and attempt number with the one that replaced them.
  if (row.table == "trial") key += fmt::format(" (#{})", row.attempt_index);
  rows.insert_or_assign(std::move(key), std::move(row));
}

void put(Projection& projection, const Setup& setup, int from_event) {
  projection.setups.push_back(setup);
  put(projection.rows, text_of(setup, static_cast<int>(projection.setups.size()), from_event));
}

void put(Projection& projection, const Changes& changes, int& n_answers) {
  if (changes.setup) put(projection, *changes.setup, projection.n_events + 1);
  if (changes.trial) {
    put(projection.rows, text_of(*changes.trial));
    projection.attempts[changes.trial->attempt_index].row = *changes.trial;
  }
  for (const CubeRow& row : changes.cubes) put(projection.rows, text_of(row));
  for (const AnswerRow& row : changes.answers) put(projection.rows, text_of(row, ++n_answers));
  for (const ReversalRow& row : changes.reversals) put(projection.rows, text_of(row));
  for (const EstimateRow& row : changes.estimates) put(projection.rows, text_of(row));
  for (const auto& row : changes.parameters) put(projection.rows, text_of(row));
  if (changes.state) projection.state = *changes.state;
}

}  // namespace

Projection fold_session(std::shared_ptr<const SessionPlan> plan, std::uint64_t seed,
                        const std::vector<LoggedEvent>& events,
                        const std::optional<Setup>& before) {
  Projection projection;
  Engine engine(std::move(plan), seed, before ? 1 : 0);
  if (before) put(projection, *before, 0);
  int n_answers = 0;
  for (const LoggedEvent& logged : events) {
    const Admission admission = engine.admit(logged.event);
    if (!admission.admitted) {
      projection.refused = {logged, admission.refusal};
      return projection;
    }
    const Changes changes = engine.apply(*admission.admitted);
    if (changes.attempt_index != logged.attempt_index) {
      projection.refused = {logged, fmt::format("it is logged with attempt {}, but belongs to {}",
                                                logged.attempt_index, changes.attempt_index)};
      return projection;
    }
    put(projection, changes, n_answers);
    if (changes.attempt_index > 0) {
      AttemptFold& attempt = projection.attempts[changes.attempt_index];
      const TrialPlan presented = engine.next().plan.value_or(TrialPlan{});
      if (logged.event.as<TrialStarted>())
        attempt.first_plan = presented;
      else
        attempt.events.push_back({projection.n_events, projection.last_s, logged.event, presented});
    }
    ++projection.n_events;
    projection.last_s = logged.event.t_s;
  }
  return projection;
}

std::map<std::string, RowText> logged_rows(const LogReader& reader, std::int64_t session_id) {
  std::map<std::string, RowText> rows;
  for (const LoggedSetup& logged : reader.setups(session_id))
    put(rows, text_of(logged.setup, logged.setup_index, logged.from_event));
  for (const TrialRow& row : reader.trials(session_id)) put(rows, text_of(row));
  for (const CubeRow& row : reader.cubes(session_id)) put(rows, text_of(row));
  int n_answers = 0;
  for (const AnswerRow& row : reader.answers(session_id)) put(rows, text_of(row, ++n_answers));
  for (const ReversalRow& row : reader.reversals(session_id)) put(rows, text_of(row));
  for (const EstimateRow& row : reader.estimates(session_id)) put(rows, text_of(row));
  for (const auto& row : reader.participant_parameters(session_id)) put(rows, text_of(row));
  return rows;
}

}  // namespace heft
