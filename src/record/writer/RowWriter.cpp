#include "record/writer/RowWriter.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <utility>

#include "base/Error.h"
#include "record/schema/Binding.h"
#include "record/schema/Digests.h"
#include "record/schema/EventRow.h"
#include "record/schema/RowSql.h"
#include "record/schema/Schema.h"

namespace heft {

namespace {
template <typename Row>
std::string keyed_insert(std::string_view table, std::string_view keys) {
  return insert_sql(table, fmt::format("{}, {}", keys, columns_of<Row>()));
}

// The row's digest is bound last.
template <typename Row>
std::string digested_insert(std::string_view table, std::string_view keys) {
  return insert_sql(table, fmt::format("{}, {}, digest", keys, columns_of<Row>()));
}
}  // namespace

RowWriter::RowWriter(SQLite::Database& database) : database_(database), chain_(database) {}
RowWriter::RowWriter(RowWriter&&) noexcept = default;
RowWriter::~RowWriter() = default;

SQLite::Statement& RowWriter::statement(const std::string& sql) {
  auto& prepared = statements_[sql];
  if (!prepared) prepared = std::make_unique<SQLite::Statement>(database_, sql);
  return *prepared;
}

template <typename... Keys>
std::optional<std::int64_t> RowWriter::first_cell(const std::string& sql, const Keys&... keys) {
  SQLite::Statement& query = statement(sql);
  Binding binding(query, keys...);
  if (!binding.step()) return std::nullopt;
  return query.getColumn(0).getInt64();
}

template <typename Row, typename... Keys>
void RowWriter::insert(const std::string& sql, const Row& row, const Keys&... keys) {
  Binding places(statement(sql), keys...);
  bind_row(places, row);
  places.run();
}

void RowWriter::forget() {
  last_attempt_.reset();
  changed_trials_.clear();
  changed_cubes_.clear();
  tasks_.clear();
  n_new_events_ = n_new_frames_ = 0;
  chain_.forget();
}

std::int64_t RowWriter::write_session(const SessionHeader& header) {
  static const std::string sql = digested_insert<SessionHeader>("session", "state");
  digest_.begin("session", "");
  Binding row(statement(sql), SessionState::running);
  row.also_into(digest_);
  bind_row(row, header);
  row.run_with_digest();
  const std::int64_t session_id = database_.getLastInsertRowid();
  for (const auto& [key, value] : header.participant_info) write_info(session_id, key, value);
  write_info_digest(session_id);
  return session_id;
}

void RowWriter::write_info(std::int64_t session_id, const std::string& key,
                           const std::string& value) {
  static const std::string sql =
      upsert_sql("participant_info", "session_id, key, value", "session_id, key");
  run(statement(sql), session_id, key, value);
  write_info_digest(session_id);
}

void RowWriter::write_info_digest(std::int64_t session_id) {
  static const std::string sql = "UPDATE session SET info_digest = ? WHERE session_id = ?";
  run(statement(sql), info_digest(database_, session_id), session_id);
}

void RowWriter::write_rest(std::int64_t session_id) {
  // Trials come last: their plans have the newest masses.
  for (const auto& [place, cube] : std::exchange(changed_cubes_, {})) write_cube(session_id, cube);
  for (const auto& [attempt, trial] : std::exchange(changed_trials_, {}))
    write_trial(session_id, trial);
  static const std::string sql =
      "UPDATE session SET n_events = n_events + ?, n_frames = n_frames + ? WHERE session_id = ?";
  const int events = std::exchange(n_new_events_, 0), frames = std::exchange(n_new_frames_, 0);
  if (events + frames > 0) run(statement(sql), events, frames, session_id);
}

void RowWriter::write(std::int64_t session_id, const RecordedEntry& entry) {
  if (const auto* event = std::get_if<RecordedEvent>(&entry))
    write_event(session_id, *event);
  else
    write_frame(session_id, std::get<FrameRow>(entry));
}

std::optional<int> RowWriter::trial_number(std::int64_t session_id, int attempt_index) {
  const auto attempt = find_attempt(session_id, attempt_index);
  return attempt ? std::optional(attempt->trial_number) : std::nullopt;
}

std::optional<RowWriter::Attempt> RowWriter::find_attempt(std::int64_t session_id,
                                                          int attempt_index) {
  if (last_attempt_ && last_attempt_->session_id == session_id &&
      last_attempt_->attempt_index == attempt_index)
    return last_attempt_;
  static const std::string sql =
      "SELECT trial_id, trial_number FROM trial WHERE session_id = ? AND attempt_index = ?";
  SQLite::Statement& query = statement(sql);
  Binding binding(query, session_id, attempt_index);
  if (!binding.step()) return std::nullopt;
  last_attempt_ = {session_id, attempt_index, query.getColumn(0).getInt64(),
                   query.getColumn(1).getInt()};
  return last_attempt_;
}

std::int64_t RowWriter::trial_id(std::int64_t session_id, int attempt_index) {
  const auto attempt = find_attempt(session_id, attempt_index);
  if (!attempt)
    throw Error(fmt::format("its attempt {} has no trial row in the log", attempt_index));
  return attempt->trial_id;
}

std::optional<std::int64_t> RowWriter::trial_id_or_none(std::int64_t session_id,
                                                        int attempt_index) {
  if (attempt_index == 0) return std::nullopt;
  return trial_id(session_id, attempt_index);
}

std::optional<std::int64_t> RowWriter::setup_id(std::int64_t session_id, int setup_index) {
  static const std::string sql =
      "SELECT setup_id FROM setup WHERE session_id = ? AND setup_index = ?";
  return first_cell(sql, session_id, setup_index);
}

void RowWriter::write_event(std::int64_t session_id, const RecordedEvent& recorded) {
  const auto& [event, changes] = recorded;
  if (changes.trial) take_trial(session_id, *changes.trial);
  write_event_row(session_id, changes.attempt_index, event);
  if (changes.setup) write_setup(session_id, database_.getLastInsertRowid(), *changes.setup);
  for (const CubeRow& cube : changes.cubes) changed_cubes_[{cube.attempt_index, cube.slot}] = cube;
  static const std::string answer = keyed_insert<AnswerRow>("answer", "trial_id"),
                           reversal = keyed_insert<ReversalRow>("reversal", "session_id, trial_id"),
                           estimate = keyed_insert<EstimateRow>("estimate", "session_id"),
                           parameter = keyed_insert<ParticipantParameterRow>(
                               "participant_parameter", "session_id, setup_id");
  for (const AnswerRow& row : changes.answers)
    insert(answer, row, trial_id(session_id, row.attempt_index));
  withdraw(session_id, changes);
  for (const ReversalRow& row : changes.reversals)
    insert(reversal, row, session_id, trial_id(session_id, row.attempt_index));
  for (const EstimateRow& row : changes.estimates) insert(estimate, row, session_id);
  for (const ParticipantParameterRow& row : changes.parameters)
    insert(parameter, row, session_id, setup_id(session_id, row.setup_index));
  static const std::string state = "UPDATE session SET state = ? WHERE session_id = ?";
  if (changes.state) run(statement(state), *changes.state, session_id);
}

void RowWriter::withdraw(std::int64_t session_id, const Changes& changes) {
  static const std::string
      reversal = "DELETE FROM reversal WHERE session_id = ? AND staircase = ? AND number = ?",
      estimate = "DELETE FROM estimate WHERE session_id = ? AND staircase = ? AND method = ?";
  for (const ReversalRow& row : changes.withdrawn_reversals)
    run(statement(reversal), session_id, row.staircase, row.number);
  for (const EstimateRow& row : changes.withdrawn_estimates)
    run(statement(estimate), session_id, row.staircase, row.method);
}

void RowWriter::write_event_row(std::int64_t session_id, int attempt_index, const Event& event) {
  static const std::string sql = digested_insert<EventRow>("event", "session_id, trial_id");
  Binding row(statement(sql), session_id, trial_id_or_none(session_id, attempt_index));
  digest_.begin("event", chain_.before_event(session_id));
  digest_.integer(attempt_index);
  row.also_into(digest_);
  bind_row(row, row_of(event));
  chain_.event_written(row.run_with_digest());
  ++n_new_events_;
}

void RowWriter::write_setup(std::int64_t session_id, std::int64_t event_id,
                            const SessionConfig& setup) {
  static const std::string sql =
      keyed_insert<SessionConfig>("setup", "session_id, from_event_id, setup_index");
  static const std::string n_before = "SELECT count(*) FROM setup WHERE session_id = ?";
  insert(sql, setup, session_id, event_id, first_cell(n_before, session_id).value() + 1);
}

// The first row of an attempt is written immediately, because others refer to it.
void RowWriter::take_trial(std::int64_t session_id, const TrialRow& trial) {
  if (find_attempt(session_id, trial.attempt_index))
    changed_trials_[trial.attempt_index] = trial;
  else
    write_trial(session_id, trial);
}

void RowWriter::write_trial(std::int64_t session_id, const TrialRow& trial) {
  static const std::string sql =
      upsert_sql("trial", fmt::format("session_id, setup_id, {}", columns_of<TrialRow>()),
                 "session_id, attempt_index");
  if (tasks_.insert(trial.plan.task).second) schema::add_words(database_, trial.plan.task);
  insert(sql, trial, session_id, setup_id(session_id, trial.setup_index));
  write_cubes_of_plan(session_id, trial);
}

// The plan's masses and friction are stored in the cubes' rows; other columns change only with a
// CubeRow.
void RowWriter::write_cubes_of_plan(std::int64_t session_id, const TrialRow& trial) {
  static const std::string sql = keyed_insert<CubeRow>("cube", "trial_id") +
                                 " ON CONFLICT (trial_id, slot) DO UPDATE SET mass_g = "
                                 "excluded.mass_g, table_friction = excluded.table_friction";
  for (const CubeRow& cube : fresh_cubes(trial.attempt_index, trial.plan))
    insert(sql, cube, trial_id(session_id, trial.attempt_index));
}

void RowWriter::write_cube(std::int64_t session_id, const CubeRow& cube) {
  static const std::string sql =
      upsert_sql("cube", fmt::format("trial_id, {}", columns_of<CubeRow>()), "trial_id, slot");
  insert(sql, cube, trial_id(session_id, cube.attempt_index));
}

void RowWriter::write_frame(std::int64_t session_id, const FrameRow& frame) {
  if (frame.cubes.size() > FrameRow::most_cubes)
    throw Error(fmt::format("it has {} cubes, expected at most {}", frame.cubes.size(),
                            FrameRow::most_cubes));
  static const std::string sql = digested_insert<FrameRow>("frame", "session_id, trial_id");
  const auto trial_id = trial_id_or_none(session_id, frame.attempt_index);
  Binding row(statement(sql), session_id, trial_id);
  digest_.begin("frame", chain_.before_frame(session_id, trial_id));
  digest_.integer(frame.attempt_index);
  row.also_into(digest_);
  bind_row(row, frame);
  chain_.frame_written(row.run_with_digest());
  ++n_new_frames_;
}

}  // namespace heft
