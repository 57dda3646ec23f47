#include "record/export/ExportTables.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "experiment/Rows.h"
#include "record/export/Export.h"
#include "record/schema/EventRow.h"
#include "record/schema/RowSql.h"

namespace heft {

namespace {

// Long texts, which are not exported.
constexpr std::array left_out{"protocol_text", "run_options"};

template <typename Value>
struct Plain {
  using type = Value;
};
template <typename Value>
struct Plain<std::optional<Value>> {
  using type = Value;
};

template <typename Value>
std::string levels() {
  using Inner = typename Plain<Value>::type;
  if constexpr (is_listed<Inner>)
    return fmt::format("{}", fmt::join(listed_names<Inner>(), "|"));
  else
    return std::is_same_v<Inner, bool> ? "0|1" : "";
}

// Columns that identify a person, place or time, or were typed.
Privacy privacy_of(const std::string& name) {
  static const std::map<std::string, Privacy> by_name{
      {"participant", Privacy::person},    {"void_reason", Privacy::free_text},
      {"started_utc", Privacy::year},      {"responder", Privacy::kind},
      {"tracker", Privacy::kind},          {"view", Privacy::kind},
      {"settings", Privacy::free_text},    {"record_camera", Privacy::free_text},
      {"camera_file", Privacy::free_text}, {"board_file", Privacy::free_text},
      {"texts_file", Privacy::free_text},  {"effector_file", Privacy::free_text},
      {"language", Privacy::kind},         {"display_file", Privacy::free_text},
      {"operator", Privacy::free_text},    {"seed", Privacy::free_text}};
  const auto found = by_name.find(name);
  return found == by_name.end() ? Privacy::open : found->second;
}

template <typename Row>
std::vector<ExportColumn> columns_of_rows() {
  std::vector<ExportColumn> columns;
  visit_cells(Row{}, [&]<typename Value>(const CellColumn& cell, const Value&) {
    const std::string name = cell.full_name();
    if (std::ranges::find(left_out, name) == left_out.end())
      columns.push_back({name, std::string(cell.unit), std::string(cell.meaning), levels<Value>(),
                         "r." + name, privacy_of(name)});
  });
  return columns;
}

// A column of a row type.
template <typename Row>
ExportColumn described(const std::string& name) {
  const auto columns = columns_of_rows<Row>();
  const auto found = std::ranges::find(columns, name, &ExportColumn::name);
  if (found == columns.end()) throw std::logic_error("no column " + name);
  return *found;
}

template <typename Row>
void add_described(std::vector<ExportColumn>& columns, std::initializer_list<const char*> names) {
  for (const char* name : names) columns.push_back(described<Row>(name));
}

// Ids that relate the files.
ExportColumn id(const std::string& name, const std::string& meaning) {
  return {name, "", meaning, "", "r." + name};
}
ExportColumn session_id() {
  return {"session_id", "", "id of the session in its log", "", "s.session_id"};
}
ExportColumn participant() {
  return {"participant", "", "participant's id", "", "s.participant", Privacy::person};
}
ExportColumn person() {
  return {"person",
          "",
          "participant's id; with several logs preceded by the log's name",
          "",
          "s.participant",
          Privacy::person};
}
ExportColumn lab() {
  return {"lab", "", "lab: file name of the log without folder and extension", "", "''"};
}
ExportColumn trial_id() {
  return id("trial_id", "id of the attempt in its log");
}

template <typename Row>
ExportTable table(const std::string& name, const std::string& meaning, const std::string& rows,
                  const std::string& order, std::vector<ExportColumn> first,
                  const std::vector<ExportColumn>& last = {}) {
  const auto own = columns_of_rows<Row>();
  first.insert(first.end(), own.begin(), own.end());
  first.insert(first.end(), last.begin(), last.end());
  return {name, meaning, rows, order, std::move(first)};
}

std::string of_session(const std::string& table) {
  return fmt::format("{} r JOIN session s ON s.session_id = r.session_id", table);
}
std::string of_trial(const std::string& table) {
  return fmt::format(
      "{} r JOIN trial t ON t.trial_id = r.trial_id JOIN session s ON s.session_id = t.session_id",
      table);
}

// A place in the plan identifies the person to anyone who knows the plan; groups and orders do not.
Privacy privacy_of_info(const std::string& key) {
  static const std::set<std::string> open{"study_group", "study_order", "study_sha256"};
  if (open.contains(key)) return Privacy::open;
  return key.starts_with("study") ? Privacy::free_text : Privacy::number;
}

std::vector<ExportColumn> about_participants(const ParticipantColumns& participants) {
  std::vector<ExportColumn> columns{
      {"state", "", "state of the session", levels<SessionState>(), "r.state"}};
  for (const std::string& key : participants.infos) {
    const bool is_planned = key.starts_with("study");
    columns.push_back(
        {"info_" + key, "",
         is_planned ? "assignment by the study's plan" : "answer about the participant", "",
         fmt::format("(SELECT value FROM participant_info i WHERE i.session_id = "
                     "r.session_id AND i.key = {})",
                     sql_text(key)),
         privacy_of_info(key)});
  }
  for (const std::string& name : participants.parameters)
    columns.push_back(
        {"parameter_" + name, "",
         "parameter drawn for a simulated participant (unit: heft doctor --responder NAME); "
         "the last one if the session was continued by another model",
         "",
         fmt::format("(SELECT value FROM participant_parameter p WHERE p.session_id = r.session_id "
                     "AND p.name = {} ORDER BY setup_id DESC LIMIT 1)",
                     sql_text(name))});
  return columns;
}

constexpr auto response_time_meaning =
    "from the cubes' onset to the final answer, without pauses and losses of the effector";
constexpr auto response_time_sql = "r.validated_s - r.shown_s - r.paused_s - r.lost_s";

void add_cube_masses(std::vector<ExportColumn>& columns) {
  for (std::size_t slot = 1; slot <= FrameRow::most_cubes; ++slot)
    columns.push_back({fmt::format("cube{}_mass_g", slot), "g",
                       fmt::format("mass of the cube in slot {}; 1 is leftmost", slot), "",
                       fmt::format("(SELECT c.mass_g FROM cube c WHERE c.trial_id = r.trial_id AND "
                                   "c.slot = {})",
                                   slot)});
}

// One row per trial with PsychoPy's names: counts from 0, answers with .rt and .corr.
ExportTable wide_table() {
  std::vector<ExportColumn> columns{
      participant(),
      person(),
      lab(),
      {"session", "", "id of the session in its log", "", "s.session_id"},
      {"date", "", "start time of the session, ISO 8601", "", "s.started_utc", Privacy::year},
      {"expName", "", "file name of the protocol", "", "s.protocol_name"},
      {"frameRate", "Hz", "displayed frames per second", "",
       "(SELECT u.display_rate_hz FROM setup u WHERE u.setup_id = r.setup_id)"},
      {"trials.thisN", "", "number of earlier completed trials of the session", "",
       "row_number() OVER (PARTITION BY r.session_id ORDER BY r.trial_id) - 1"},
      {"trials.thisTrialN", "", "number of earlier completed trials of the block", "",
       "row_number() OVER (PARTITION BY r.session_id, r.block ORDER BY r.trial_id) - 1"},
      {"trial", "", "number of the planned trial, from 1", "", "r.trial_number"}};
  add_described<TrialRow>(columns, {"block", "task", "condition", "staircase", "reference_g",
                                    "level_g", "is_catch", "is_practice"});
  add_cube_masses(columns);
  add_described<TrialRow>(columns, {"reference_slot", "outcome"});
  columns.push_back({"response.keys", "", "chosen slot, otherwise the outcome", "",
                     "coalesce(r.chosen_slot, r.outcome)"});
  columns.push_back({"response.corr", "", "1 correct, 0 incorrect; empty: neither, or no choice",
                     "0|1",
                     "CASE r.outcome WHEN 'correct' THEN 1 WHEN 'incorrect' THEN 0 WHEN "
                     "'difference' THEN r.choice_correct END"});
  columns.push_back({"response.rt", "s", response_time_meaning, "", response_time_sql});
  columns.push_back({"first_choice.rt", "s", "from the cubes' onset to the first action", "",
                     "r.first_choice_s - r.shown_s"});
  columns.push_back({"trial.started", "s", "session time of the start", "", "r.started_s"});
  columns.push_back({"trial.stopped", "s", "session time of the end", "", "r.ended_s"});
  return {"wide", "a completed trial, with PsychoPy's names",
          of_session("trial") + " WHERE r.status = 'completed'", "r.trial_id", std::move(columns)};
}

// Input of `heft fit choices.csv --model indecision --by compared`.
ExportTable choice_table() {
  const std::string on_right = "r.reference_slot IS NULL OR r.reference_slot = 1";
  std::vector<ExportColumn> columns{session_id(),
                                    participant(),
                                    person(),
                                    lab(),
                                    trial_id(),
                                    {"compared", "", "technique and reference, the unit of a fit",
                                     "", "r.condition || printf(' %.6g g', r.reference_g)"}};
  add_described<TrialRow>(columns,
                          {"condition", "reference_g", "staircase", "is_catch", "level_g"});
  columns.push_back({"answer", "", "cube that was judged heavier",
                     "comparison|reference|none|different",
                     "CASE WHEN r.outcome <> 'difference' THEN 'none' "
                     "WHEN r.chosen_slot IS NULL THEN 'different' "
                     "WHEN r.chosen_slot = coalesce(r.reference_slot, 1) THEN 'reference' ELSE "
                     "'comparison' END"});
  columns.push_back({"right_minus_left_g", "g",
                     "mass of the right cube minus mass of the left cube", "",
                     "CASE WHEN " + on_right + " THEN r.level_g ELSE -r.level_g END"});
  columns.push_back({"side", "", "side that was judged heavier", "left|right|none|different",
                     "CASE WHEN r.outcome <> 'difference' THEN 'none' "
                     "WHEN r.chosen_slot IS NULL THEN 'different' "
                     "WHEN r.chosen_slot = 1 THEN 'left' ELSE 'right' END"});
  return {"choices", "a completed comparison, without practice",
          of_session("trial") +
              " WHERE r.task = 'comparison' AND r.status = 'completed' AND r.outcome IS NOT NULL "
              "AND r.reference_g IS NOT NULL AND r.level_g IS NOT NULL AND NOT r.is_practice",
          "r.trial_id", std::move(columns)};
}

void add_names(SQLite::Database& database, const char* sql, std::vector<std::string>& names) {
  SQLite::Statement query(database, sql);
  while (query.executeStep()) names.push_back(query.getColumn(0).getString());
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
}

}  // namespace

void ParticipantColumns::add(SQLite::Database& database) {
  add_names(database, "SELECT DISTINCT key FROM participant_info", infos);
  add_names(database, "SELECT DISTINCT name FROM participant_parameter", parameters);
}

ExportColumn log_column() {
  return {"log", "", "file name of the log, as given", "", ""};
}

std::vector<ExportTable> export_tables(const ParticipantColumns& participants) {
  const ExportColumn response_time{
      "response_time_s", "s", "validated_s - shown_s - paused_s - lost_s", "", response_time_sql};
  return {
      table<TrialRow>("trials", "an attempt at a planned trial", of_session("trial"), "r.trial_id",
                      {session_id(), participant(), person(), lab(), trial_id(),
                       id("setup_id", "configuration; see setups.csv")},
                      {response_time}),
      wide_table(),
      choice_table(),
      table<AnswerRow>("answers", "an action of the participant", of_trial("answer"), "r.answer_id",
                       {session_id(), participant(), person(), lab(), trial_id(),
                        id("answer_id", "id in order of writing")}),
      table<ReversalRow>("reversals", "a reversal of a staircase", of_session("reversal"),
                         "r.rowid", {session_id(), participant(), person(), lab(), trial_id()}),
      table<EstimateRow>("estimates", "an estimate of a staircase by one method",
                         of_session("estimate"), "r.rowid",
                         {session_id(), participant(), person(), lab()}),
      table<CubeRow>("cubes", "a cube of an attempt at a trial", of_trial("cube"),
                     "r.trial_id, r.slot",
                     {session_id(), participant(), person(), lab(), trial_id()}),
      table<SessionHeader>(
          "participants", "a session",
          "(SELECT * FROM session WHERE state != 'withdrawn') r JOIN session s USING (session_id)",
          "r.session_id", {session_id(), person(), lab()}, about_participants(participants)),
      table<SessionConfig>(
          "setups", "a configuration", of_session("setup"), "r.setup_id",
          {session_id(), participant(), person(), lab(),
           id("setup_id", "id of the configuration in its log"),
           id("setup_index", "number of the configuration in its session, from 1"),
           id("from_event_id", "event that put it into effect; empty: start of the session")}),
      table<FrameRow>("frames", "a displayed frame", of_session("frame"), "r.frame_id",
                      {session_id(), participant(), person(), lab(), trial_id(),
                       id("frame_id", "id in order of writing")}),
  };
}

std::map<std::string, std::string> units_of_columns() {
  std::map<std::string, std::string> units;
  for (const ExportTable& table : export_tables({}))
    for (const ExportColumn& column : table.columns)
      if (!column.unit.empty()) units.try_emplace(column.name, column.unit);
  return units;
}

ExportTable behavior_table() {
  std::vector<ExportColumn> columns = columns_of_rows<TrialRow>();
  columns.insert(columns.begin(), trial_id());
  columns.push_back({"response_time", "s", response_time_meaning, "", response_time_sql});
  add_cube_masses(columns);
  return {"beh", "an attempt at a planned trial", of_session("trial"), "r.trial_id",
          std::move(columns)};
}

ExportTable event_table() {
  std::vector<ExportColumn> columns{
      {"onset", "s", "session time of the event", "", "r.t_s"},
      {"duration", "s", "0: events have no duration", "", "0"},
      {"trial_type", "", "kind of event", "", "r.kind"},
      {"trial_number", "", "number of the planned trial, from 1", "", "t.trial_number"},
      {"action", "", "action of the participant, if the event is one", levels<ActionKind>(),
       "(SELECT a.action FROM answer a WHERE r.kind = 'action' AND a.trial_id = r.trial_id AND "
       "a.t_s = r.t_s ORDER BY a.answer_id LIMIT 1)"}};
  add_described<EventRow>(columns, {"slot", "label"});
  return {"events", "an event of a trial",
          "event r JOIN trial t ON t.trial_id = r.trial_id JOIN session s ON s.session_id = "
          "r.session_id",
          "r.event_id", std::move(columns)};
}

std::string sql_text(const std::string& text) {
  std::string hex;
  for (const char c : text) hex += fmt::format("{:02x}", static_cast<unsigned char>(c));
  return fmt::format("CAST(x'{}' AS TEXT)", hex);
}

std::vector<std::string> levels_of(const ExportColumn& column) {
  std::vector<std::string> levels;
  std::istringstream text(column.levels);
  for (std::string level; std::getline(text, level, '|');) levels.push_back(level);
  return levels;
}

}  // namespace heft
