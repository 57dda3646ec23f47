#include "record/ExportTables.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "experiment/EachCell.h"
#include "record/EventRow.h"
#include "record/SessionHeader.h"

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
  if constexpr (std::is_enum_v<Inner>)
    return fmt::format("{}", fmt::join(EnumNames<Inner>::names, "|"));
  else
    return std::is_same_v<Inner, bool> ? "0|1" : "";
}

template <typename Row>
std::vector<ExportColumn> columns_of_rows() {
  std::vector<ExportColumn> columns;
  visit_cells(Row{}, [&]<typename Value>(const CellColumn& cell, const Value&) {
    const std::string name = cell.full_name();
    if (std::ranges::find(left_out, name) == left_out.end())
      columns.push_back(
          {name, std::string(cell.unit), std::string(cell.meaning), levels<Value>(), "r." + name});
  });
  return columns;
}

// The ids that tie the files together.
ExportColumn id(const std::string& name, const std::string& meaning) {
  return {name, "", meaning, "", "r." + name};
}
ExportColumn session_id() {
  return {"session_id", "", "number of the session in its log", "", "s.session_id"};
}
ExportColumn participant() {
  return {"participant", "", "who took part", "", "s.participant"};
}
ExportColumn trial_id() {
  return id("trial_id", "number of the attempt at a trial in its log");
}

template <typename Row>
ExportTable table(const std::string& file, const std::string& rows, const std::string& order,
                  std::vector<ExportColumn> first, const std::vector<ExportColumn>& last = {}) {
  const auto own = columns_of_rows<Row>();
  first.insert(first.end(), own.begin(), own.end());
  first.insert(first.end(), last.begin(), last.end());
  return {file, rows, order, std::move(first)};
}

std::string of_session(const std::string& table) {
  return fmt::format("{} r JOIN session s ON s.session_id = r.session_id", table);
}
std::string of_trial(const std::string& table) {
  return fmt::format(
      "{} r JOIN trial t ON t.trial_id = r.trial_id JOIN session s ON s.session_id = t.session_id",
      table);
}

// A text in SQL, whatever is in it.
std::string quoted(const std::string& text) {
  std::string hex;
  for (const char c : text) hex += fmt::format("{:02x}", static_cast<unsigned char>(c));
  return fmt::format("CAST(x'{}' AS TEXT)", hex);
}

std::vector<ExportColumn> about_participants(const ParticipantColumns& participants) {
  std::vector<ExportColumn> columns{
      {"state", "", "how far the session came", levels<SessionState>(), "r.state"}};
  for (const std::string& key : participants.infos)
    columns.push_back({"info_" + key, "", "what the participant told", "",
                       fmt::format("(SELECT value FROM participant_info i WHERE i.session_id = "
                                   "r.session_id AND i.key = {})",
                                   quoted(key))});
  for (const std::string& name : participants.parameters)
    columns.push_back(
        {"parameter_" + name, "",
         "what a simulated participant was drawn as (unit: heft doctor --responder NAME); of "
         "several who went on with the session, the last",
         "",
         fmt::format("(SELECT value FROM participant_parameter p WHERE p.session_id = r.session_id "
                     "AND p.name = {} ORDER BY setup_id DESC LIMIT 1)",
                     quoted(name))});
  return columns;
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
  const ExportColumn response_time{"response_time_s", "s",
                                   "validated_s - shown_s - paused_s - lost_s", "",
                                   "r.validated_s - r.shown_s - r.paused_s - r.lost_s"};
  return {
      table<TrialRow>("trials.csv", of_session("trial"), "r.trial_id",
                      {session_id(), participant(), trial_id(),
                       id("setup_id", "what was in force; in setups.csv")},
                      {response_time}),
      table<AnswerRow>(
          "answers.csv", of_trial("answer"), "r.answer_id",
          {session_id(), participant(), trial_id(), id("answer_id", "counts in order")}),
      table<ReversalRow>("reversals.csv", of_session("reversal"), "r.rowid",
                         {session_id(), participant(), trial_id()}),
      table<EstimateRow>("estimates.csv", of_session("estimate"), "r.rowid",
                         {session_id(), participant()}),
      table<CubeRow>("cubes.csv", of_trial("cube"), "r.trial_id, r.slot",
                     {session_id(), participant(), trial_id()}),
      table<SessionHeader>("participants.csv", "session r JOIN session s USING (session_id)",
                           "r.session_id", {session_id()}, about_participants(participants)),
      table<Setup>("setups.csv", of_session("setup"), "r.setup_id",
                   {session_id(), participant(), id("setup_id", "number of the setup in its log"),
                    id("setup_index", "counts a session's setups from 1"),
                    id("from_event_id", "event from which on it was in force; none: the start")}),
      table<FrameRow>("frames.csv", of_session("frame"), "r.frame_id",
                      {session_id(), participant(), trial_id(), id("frame_id", "counts in order")}),
  };
}

}  // namespace heft
