#include "replay/Projection.h"

#include <fmt/format.h>

#include <type_traits>
#include <utility>

#include "experiment/Rows.h"

namespace heft {

namespace {

std::string text(const std::string& value) {
  return '"' + value + '"';
}
std::string text(bool value) {
  return value ? "1" : "0";
}
std::string text(int value) {
  return fmt::format("{}", value);
}
// Adding 0 turns -0, which the log does not distinguish, into 0.
std::string text(double value) {
  return fmt::format("{}", value + 0.0);
}
template <typename Enum>
requires std::is_enum_v<Enum> std::string text(Enum value) {
  return std::string(name_of(value));
}
template <typename Value>
std::string text(const std::optional<Value>& value) {
  return value ? text(*value) : "NULL";
}

template <typename Row>
RowText texts(std::string table, std::string key, int attempt_index, double t_s, const Row& row) {
  RowText made{std::move(table), std::move(key), attempt_index, t_s, {}};
  visit_cells(row, [&](const CellColumn& column, const auto& value) {
    made.columns.push_back({column.full_name(), text(value)});
  });
  return made;
}

void add(RowText& text, std::string column, int value) {
  text.columns.push_back({std::move(column), fmt::format("{}", value)});
}

constexpr double at_its_end = -1;

RowText text_of(const TrialRow& row) {
  RowText text =
      texts("trial", fmt::format("trial {} attempt {}", row.plan.trial_number, row.plan.attempt),
            row.attempt_index, at_its_end, row);
  add(text, "setup", row.setup_index);
  return text;
}

RowText text_of(const CubeRow& row) {
  return texts("cube", fmt::format("cube {} of attempt {}", row.slot, row.attempt_index),
               row.attempt_index, at_its_end, row);
}

RowText text_of(const AnswerRow& row, int number) {
  RowText text = texts("answer", fmt::format("answer {}", number), row.attempt_index, row.t_s, row);
  add(text, "attempt", row.attempt_index);
  return text;
}

RowText text_of(const ReversalRow& row) {
  RowText text =
      texts("reversal", fmt::format("reversal {} of staircase \"{}\"", row.number, row.staircase),
            row.attempt_index, at_its_end, row);
  add(text, "attempt", row.attempt_index);
  return text;
}

RowText text_of(const EstimateRow& row) {
  return texts("estimate",
               fmt::format("estimate \"{}\" of staircase \"{}\"", row.method, row.staircase), 0,
               at_its_end, row);
}

RowText text_of(const ParticipantParameterRow& row) {
  return texts("participant_parameter",
               fmt::format("parameter {} of setup {}", row.name, row.setup_index), 0, at_its_end,
               row);
}

RowText text_of(const SessionConfig& setup, int number, int from_event) {
  RowText text = texts("setup", fmt::format("setup {}", number), 0, at_its_end, setup);
  add(text, "from_event", from_event);
  return text;
}

void put(std::map<std::string, RowText>& rows, RowText row) {
  std::string key = row.table + ": " + row.key;
  // Attempts that crashed share trial and attempt number with their replacement.
  if (row.table == "trial") key += fmt::format(" (#{})", row.attempt_index);
  rows.insert_or_assign(std::move(key), std::move(row));
}

void put(Projection& projection, const SessionConfig& setup, int from_event) {
  projection.setups.push_back(setup);
  put(projection.rows, text_of(setup, static_cast<int>(projection.setups.size()), from_event));
}

void take(std::map<std::string, RowText>& rows, const RowText& row) {
  rows.erase(row.table + ": " + row.key);
}

void put(Projection& projection, const Changes& changes, int& n_answers) {
  if (changes.setup) put(projection, *changes.setup, projection.n_events + 1);
  if (changes.trial) projection.attempts[changes.trial->attempt_index].row = *changes.trial;
  for (const CubeRow& row : changes.cubes) put(projection.rows, text_of(row));
  for (const AnswerRow& row : changes.answers) put(projection.rows, text_of(row, ++n_answers));
  for (const ReversalRow& row : changes.withdrawn_reversals) take(projection.rows, text_of(row));
  for (const EstimateRow& row : changes.withdrawn_estimates) take(projection.rows, text_of(row));
  for (const ReversalRow& row : changes.reversals) put(projection.rows, text_of(row));
  for (const EstimateRow& row : changes.estimates) put(projection.rows, text_of(row));
  for (const auto& row : changes.parameters) put(projection.rows, text_of(row));
  if (changes.state) projection.state = *changes.state;
}

// Up to the first event that is not possible.
void fold(Projection& projection, Engine& engine, const std::vector<LoggedEvent>& events) {
  int n_answers = 0;
  for (const LoggedEvent& logged : events) {
    const Admission admission = engine.admit(logged.event);
    if (!admission.admitted) {
      projection.refused = {logged, admission.refusal};
      return;
    }
    const Changes changes = *engine.apply(*admission.admitted).changes;
    if (changes.attempt_index != logged.attempt_index) {
      projection.refused = {logged, fmt::format("it is logged with attempt {}, but belongs to {}",
                                                logged.attempt_index, changes.attempt_index)};
      return;
    }
    put(projection, changes, n_answers);
    if (changes.attempt_index > 0) {
      ProjectedAttempt& attempt = projection.attempts[changes.attempt_index];
      const TrialPlan presented = engine.next().plan.value_or(TrialPlan{});
      if (logged.event.as<TrialStarted>())
        attempt.first_plan = presented;
      else
        attempt.events.push_back({projection.n_events, projection.last_s, logged.event, presented});
    }
    ++projection.n_events;
    projection.last_s = logged.event.t_s;
  }
}
}  // namespace

Projection fold_session(std::shared_ptr<const SessionPlan> plan, std::uint64_t seed,
                        const std::vector<LoggedEvent>& events) {
  Projection projection;
  Engine engine(std::move(plan), seed);
  fold(projection, engine, events);
  // Most events change the row of their attempt: only the last is put into words.
  for (const auto& [index, attempt] : projection.attempts)
    if (attempt.row.attempt_index == index) put(projection.rows, text_of(attempt.row));
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
