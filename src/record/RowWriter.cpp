#include "record/RowWriter.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include "base/Error.h"
#include "record/Binding.h"
#include "record/Schema.h"

namespace heft {

namespace {
constexpr int pose_columns = 7;

std::string keyed_insert(std::string_view table, std::string_view keys, std::string_view columns) {
  return schema::insert_sql(table, fmt::format("{}, {}", keys, columns));
}

// The row's digest is bound last.
std::string digested_insert(std::string_view table, std::string_view keys,
                            std::string_view columns) {
  return keyed_insert(table, keys, fmt::format("{}, digest", columns));
}

std::optional<std::string> if_any(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
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

std::int64_t RowWriter::write_session(const SessionHeader& header) {
  static const std::string sql = digested_insert("session", "state", schema::header_columns);
  digest_.begin("session", "");
  Binding row(statement(sql), SessionState::running);
  row.also_into(digest_) << header.participant << header.protocol_name << header.protocol_text
                         << header.protocol_sha256 << header.seed << header.heft_version
                         << header.build << header.run_options << header.started_utc
                         << header.purpose << header.responder;
  row.run_with_digest();
  const std::int64_t session_id = database_.getLastInsertRowid();
  for (const auto& [key, value] : header.participant_info) write_info(session_id, key, value);
  return session_id;
}

void RowWriter::write_info(std::int64_t session_id, const std::string& key,
                           const std::string& value) {
  static const std::string sql =
      schema::upsert_sql("participant_info", "session_id, key, value", "session_id, key");
  run(statement(sql), session_id, key, value);
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

void RowWriter::write_event(std::int64_t session_id, const RecordedEvent& recorded) {
  const auto& [event, changes] = recorded;
  if (changes.trial) write_trial(session_id, *changes.trial);
  write_event_row(session_id, changes.attempt_index, event);
  for (const CubeRow& cube : changes.cubes) write_cube(session_id, cube);
  for (const AnswerRow& answer : changes.answers) write_answer(session_id, answer);
  for (const ReversalRow& reversal : changes.reversals) write_reversal(session_id, reversal);
  for (const EstimateRow& estimate : changes.estimates) write_estimate(session_id, estimate);
  if (changes.state) write_state(session_id, *changes.state);
}

void RowWriter::write_event_row(std::int64_t session_id, int attempt_index, const Event& event) {
  static const std::string sql =
      digested_insert("event", "session_id, trial_id", schema::event_columns);
  Binding row(statement(sql), session_id, trial_id_or_none(session_id, attempt_index));
  digest_.begin("event", chain_.before_event(session_id));
  digest_.integer(attempt_index);
  row.also_into(digest_) << event.t_s << event.kind << event.slot << event.label << event.detail
                         << event.value;
  chain_.event_written(row.run_with_digest());
}

void RowWriter::write_trial(std::int64_t session_id, const TrialRow& trial) {
  static const std::string sql = schema::upsert_sql(
      "trial", fmt::format("session_id, {}", schema::trial_columns), "session_id, attempt_index");
  const TrialPlan& plan = trial.plan;
  run(statement(sql), session_id, trial.attempt_index, plan.trial_number, plan.attempt, plan.block,
      plan.task, plan.condition, if_any(plan.staircase), plan.reference_g, plan.level_g,
      plan.is_catch, plan.n_reshuffles, trial.status, trial.void_reason, trial.outcome,
      trial.chosen_slot, plan.reference_slot, trial.choice_correct, trial.started_s, trial.shown_s,
      trial.first_contact_s, trial.first_choice_s, trial.validated_s, trial.paused_s, trial.lost_s,
      trial.ended_s);
  write_masses(session_id, trial);
}

// The plan's masses live in the cubes' rows, untouched until a CubeRow says more.
void RowWriter::write_masses(std::int64_t session_id, const TrialRow& trial) {
  static const std::string sql =
      schema::insert_sql("cube", "trial_id, slot, mass_g, n_pushes, contact_s") +
      " ON CONFLICT (trial_id, slot) DO UPDATE SET mass_g = excluded.mass_g";
  int slot = 0;
  for (const double mass_g : trial.plan.masses_g)
    run(statement(sql), trial_id(session_id, trial.attempt_index), ++slot, mass_g, 0, 0.0);
}

void RowWriter::write_cube(std::int64_t session_id, const CubeRow& cube) {
  static const std::string sql = schema::upsert_sql(
      "cube", fmt::format("trial_id, {}", schema::cube_columns), "trial_id, slot");
  run(statement(sql), trial_id(session_id, cube.attempt_index), cube.slot, cube.mass_g,
      cube.n_pushes, cube.contact_s, cube.first_contact_s, cube.last_contact_s);
}

void RowWriter::write_answer(std::int64_t session_id, const AnswerRow& answer) {
  static const std::string sql = keyed_insert("answer", "trial_id", schema::answer_columns);
  run(statement(sql), trial_id(session_id, answer.attempt_index), answer.t_s, answer.action,
      answer.slot, answer.label);
}

void RowWriter::write_reversal(std::int64_t session_id, const ReversalRow& reversal) {
  static const std::string sql =
      keyed_insert("reversal", "session_id, trial_id", schema::reversal_columns);
  run(statement(sql), session_id, trial_id(session_id, reversal.attempt_index), reversal.staircase,
      reversal.number, reversal.level_g, reversal.step_before_g, reversal.step_after_g);
}

void RowWriter::write_estimate(std::int64_t session_id, const EstimateRow& estimate) {
  static const std::string sql = keyed_insert("estimate", "session_id", schema::estimate_columns);
  run(statement(sql), session_id, estimate.staircase, estimate.method, estimate.jnd_g,
      estimate.low_g, estimate.high_g, estimate.n_trials, estimate.n_reversals, estimate.n_floor,
      estimate.n_ceiling, estimate.reason);
}

void RowWriter::write_state(std::int64_t session_id, SessionState state) {
  static const std::string sql = "UPDATE session SET state = ? WHERE session_id = ?";
  run(statement(sql), state, session_id);
}

void RowWriter::write_frame(std::int64_t session_id, const FrameRow& frame) {
  if (frame.cubes.size() > schema::most_cubes)
    throw Error(fmt::format("it has {} cubes, the log keeps at most {}", frame.cubes.size(),
                            schema::most_cubes));
  static const std::string sql =
      digested_insert("frame", "session_id, trial_id",
                      fmt::format("{}, {}", schema::frame_columns, schema::frame_timing_columns));
  const auto trial_id = trial_id_or_none(session_id, frame.attempt_index);
  Binding row(statement(sql), session_id, trial_id);
  digest_.begin("frame", chain_.before_frame(session_id, trial_id));
  digest_.integer(frame.attempt_index);
  row.also_into(digest_) << frame.after_event << frame.t_s << frame.trial_t_s << frame.capture_s
                         << frame.present_s << frame.tracked << frame.jump << frame.contact_slot
                         << frame.quality << frame.state_hash;
  const Velocity& velocity = frame.effector_velocity;
  row.exactly(frame.effector).exactly(velocity.linear_m_s).exactly(velocity.angular_rad_s);
  if (frame.clone)
    row << *frame.clone;
  else
    row.null(pose_columns);
  for (const Pose& cube : frame.cubes) row << cube;
  row.null(pose_columns * (schema::most_cubes - static_cast<int>(frame.cubes.size())));
  if (frame.detected_s || frame.simulated_s || frame.n_dropped)
    row << frame.detected_s << frame.simulated_s << frame.n_dropped;
  else
    row.undigested_null(schema::n_frame_timing_columns);
  chain_.frame_written(row.run_with_digest());
}

}  // namespace heft
