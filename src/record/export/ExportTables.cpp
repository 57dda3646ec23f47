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
#include "record/schema/EventRow.h"
#include "record/schema/RowSql.h"

namespace heft {

namespace {

// Long texts, for which the log is the place.
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

// What tells of a person, a place or a moment, or was typed by somebody.
Privacy privacy_of(const std::string& name) {
  static const std::map<std::string, Privacy> by_name{
      {"participant", Privacy::person},    {"void_reason", Privacy::free_text},
      {"started_utc", Privacy::year},      {"responder", Privacy::kind},
      {"tracker", Privacy::kind},          {"view", Privacy::kind},
      {"settings", Privacy::free_text},    {"record_camera", Privacy::free_text},
      {"camera_file", Privacy::free_text}, {"board_file", Privacy::free_text},
      {"texts_file", Privacy::free_text},  {"effector_file", Privacy::free_text},
      {"language", Privacy::kind},         {"display_file", Privacy::free_text}};
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

// A column as its row describes it, where another table has it too.
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

// The ids that tie the files together.
ExportColumn id(const std::string& name, const std::string& meaning) {
  return {name, "", meaning, "", "r." + name};
}
ExportColumn session_id() {
  return {"session_id", "", "number of the session in its log", "", "s.session_id"};
}
ExportColumn participant() {
  return {"participant", "", "who took part", "", "s.participant", Privacy::person};
}
ExportColumn person() {
  return {"person",
          "",
          "who took part, unique among several logs: then the log's name and participant",
          "",
          "s.participant",
          Privacy::person};
}
ExportColumn trial_id() {
  return id("trial_id", "number of the attempt at a trial in its log");
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

// Who knows a plan knows by the place who it is. Groups and orders are the plan's own words.
Privacy privacy_of_info(const std::string& key) {
  static const std::set<std::string> open{"study_group", "study_order", "study_sha256"};
  if (open.contains(key)) return Privacy::open;
  return key.starts_with("study") ? Privacy::free_text : Privacy::number;
}

std::vector<ExportColumn> about_participants(const ParticipantColumns& participants) {
  std::vector<ExportColumn> columns{
      {"state", "", "how far the session came", levels<SessionState>(), "r.state"}};
  for (const std::string& key : participants.infos) {
    const bool is_planned = key.starts_with("study");
    columns.push_back({"info_" + key, "",
                       is_planned ? "what the study's plan gave" : "what the participant told", "",
                       fmt::format("(SELECT value FROM participant_info i WHERE i.session_id = "
                                   "r.session_id AND i.key = {})",
                                   sql_text(key)),
                       privacy_of_info(key)});
  }
  for (const std::string& name : participants.parameters)
    columns.push_back(
        {"parameter_" + name, "",
         "what a simulated participant was drawn as (unit: heft doctor --responder NAME); of "
         "several who went on with the session, the last",
         "",
         fmt::format("(SELECT value FROM participant_parameter p WHERE p.session_id = r.session_id "
                     "AND p.name = {} ORDER BY setup_id DESC LIMIT 1)",
                     sql_text(name))});
  return columns;
}

constexpr auto response_time_meaning =
    "from all cubes shown to the answer that ended it, without pauses and losses of the effector";
constexpr auto response_time_sql = "r.validated_s - r.shown_s - r.paused_s - r.lost_s";

void add_cube_masses(std::vector<ExportColumn>& columns) {
  for (std::size_t slot = 1; slot <= FrameRow::most_cubes; ++slot)
    columns.push_back({fmt::format("cube{}_mass_g", slot), "g",
                       fmt::format("mass of the cube of slot {}, 1 leftmost", slot), "",
                       fmt::format("(SELECT c.mass_g FROM cube c WHERE c.trial_id = r.trial_id AND "
                                   "c.slot = {})",
                                   slot)});
}

// A row a trial, as PsychoPy writes it: counts from 0, answers with .rt and .corr.
ExportTable wide_table() {
  std::vector<ExportColumn> columns{
      participant(),
      person(),
      {"session", "", "number of the session in its log", "", "s.session_id"},
      {"date", "", "when the session started, ISO 8601", "", "s.started_utc", Privacy::year},
      {"expName", "", "name of the protocol's file", "", "s.protocol_name"},
      {"frameRate", "Hz", "frames displayed a second", "",
       "(SELECT u.display_rate_hz FROM setup u WHERE u.setup_id = r.setup_id)"},
      {"trials.thisN", "", "completed trials of the session before this one", "",
       "row_number() OVER (PARTITION BY r.session_id ORDER BY r.trial_id) - 1"},
      {"trials.thisTrialN", "", "completed trials of its block before this one", "",
       "row_number() OVER (PARTITION BY r.session_id, r.block ORDER BY r.trial_id) - 1"},
      {"trial", "", "planned trial of the session, from 1", "", "r.trial_number"}};
  add_described<TrialRow>(columns, {"block", "task", "condition", "staircase", "reference_g",
                                    "level_g", "is_catch", "is_practice"});
  add_cube_masses(columns);
  add_described<TrialRow>(columns, {"reference_slot", "outcome"});
  columns.push_back({"response.keys", "",
                     "the slot that was chosen; where none was, the answer in a word", "",
                     "coalesce(r.chosen_slot, r.outcome)"});
  columns.push_back({"response.corr", "",
                     "1 right, 0 wrong; empty: don't know, no difference, or neither", "0|1",
                     "CASE r.outcome WHEN 'correct' THEN 1 WHEN 'incorrect' THEN 0 WHEN "
                     "'difference' THEN r.choice_correct END"});
  columns.push_back({"response.rt", "s", response_time_meaning, "", response_time_sql});
  columns.push_back({"first_choice.rt", "s", "from all cubes shown to the first action", "",
                     "r.first_choice_s - r.shown_s"});
  columns.push_back({"trial.started", "s", "session time of its start", "", "r.started_s"});
  columns.push_back({"trial.stopped", "s", "session time of its end", "", "r.ended_s"});
  return {"wide", "a completed trial, named as PsychoPy names things",
          of_session("trial") + " WHERE r.status = 'completed'", "r.trial_id", std::move(columns)};
}

// The choices that fits are made of: `heft fit choices.csv --model indecision --by compared`.
ExportTable choice_table() {
  const std::string on_right = "r.reference_slot IS NULL OR r.reference_slot = 1";
  std::vector<ExportColumn> columns{session_id(),
                                    participant(),
                                    person(),
                                    trial_id(),
                                    {"compared", "", "what is one fit: technique and reference", "",
                                     "r.condition || printf(' %.6g g', r.reference_g)"}};
  add_described<TrialRow>(columns,
                          {"condition", "reference_g", "staircase", "is_catch", "level_g"});
  columns.push_back({"answer", "", "which was called heavier", "comparison|reference|none",
                     "CASE WHEN r.outcome <> 'difference' OR r.chosen_slot IS NULL THEN 'none' "
                     "WHEN r.chosen_slot = coalesce(r.reference_slot, 1) THEN 'reference' ELSE "
                     "'comparison' END"});
  columns.push_back({"right_minus_left_g", "g", "mass of the right cube minus that of the left", "",
                     "CASE WHEN " + on_right + " THEN r.level_g ELSE -r.level_g END"});
  columns.push_back({"side", "", "which side was called heavier", "left|right|none",
                     "CASE WHEN r.outcome <> 'difference' OR r.chosen_slot IS NULL THEN 'none' "
                     "WHEN r.chosen_slot = 1 THEN 'left' ELSE 'right' END"});
  return {"choices", "a completed comparison that is no practice",
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
  return {"log", "", "file of the log, as it was given", "", ""};
}

std::vector<ExportTable> export_tables(const ParticipantColumns& participants) {
  const ExportColumn response_time{
      "response_time_s", "s", "validated_s - shown_s - paused_s - lost_s", "", response_time_sql};
  return {
      table<TrialRow>("trials", "an attempt at a planned trial", of_session("trial"), "r.trial_id",
                      {session_id(), participant(), person(), trial_id(),
                       id("setup_id", "what was in force; in setups.csv")},
                      {response_time}),
      wide_table(),
      choice_table(),
      table<AnswerRow>(
          "answers", "an action of the participant", of_trial("answer"), "r.answer_id",
          {session_id(), participant(), person(), trial_id(), id("answer_id", "counts in order")}),
      table<ReversalRow>("reversals", "a reversal of a staircase", of_session("reversal"),
                         "r.rowid", {session_id(), participant(), person(), trial_id()}),
      table<EstimateRow>("estimates", "what one method makes of a staircase",
                         of_session("estimate"), "r.rowid",
                         {session_id(), participant(), person()}),
      table<CubeRow>("cubes", "a cube of an attempt at a trial", of_trial("cube"),
                     "r.trial_id, r.slot", {session_id(), participant(), person(), trial_id()}),
      table<SessionHeader>("participants", "a session",
                           "session r JOIN session s USING (session_id)", "r.session_id",
                           {session_id(), person()}, about_participants(participants)),
      table<SessionConfig>(
          "setups", "what was in force from an event on", of_session("setup"), "r.setup_id",
          {session_id(), participant(), person(), id("setup_id", "number of the setup in its log"),
           id("setup_index", "counts a session's setups from 1"),
           id("from_event_id", "event from which on it was in force; none: the start")}),
      table<FrameRow>(
          "frames", "a displayed frame", of_session("frame"), "r.frame_id",
          {session_id(), participant(), person(), trial_id(), id("frame_id", "counts in order")}),
  };
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
      {"duration", "s", "0: events are moments", "", "0"},
      {"trial_type", "", "what happened", "", "r.kind"},
      {"trial_number", "", "planned trial, from 1", "", "t.trial_number"},
      {"action", "", "what the participant did, where that is what happened", levels<ActionKind>(),
       "(SELECT a.action FROM answer a WHERE r.kind = 'action' AND a.trial_id = r.trial_id AND "
       "a.t_s = r.t_s ORDER BY a.answer_id LIMIT 1)"}};
  add_described<EventRow>(columns, {"slot", "label"});
  return {"events", "something that happened in a trial",
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
