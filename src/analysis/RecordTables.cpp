// What was in force, what was noted, and what the log's columns mean, as tables.
#include <fmt/format.h>

#include "analysis/TableParts.h"
#include "experiment/EachCell.h"

namespace heft {

namespace {
template <typename Row>
void explain(Table& table, const char* log_table) {
  visit_cells(Row{}, [&](const CellColumn& column, const auto&) {
    table.rows.push_back({word(log_table), word(column.full_name()), word(std::string(column.unit)),
                          word(std::string(column.meaning))});
  });
}
}  // namespace

Table setup_table(const Summary& summary) {
  Table table{
      "setups",
      titled("What was in force", summary),
      {{"what", "what"},
       {"value", "value"},
       {"unit", "unit"},
       {"n_sessions", "sessions"},
       {"n_attempts", "attempts"},
       {"meaning", "meaning"}},
      {},
      "as the sessions' setups tell it; two values of one thing: it differed between "
      "sessions or was changed in one. Protocol, hash, build and seeds stand in the table of "
      "the protocol's choices"};
  for (const SetupValue& row : summary.setups)
    table.rows.push_back({word(row.what), word(row.value), word(row.unit), count(row.n_sessions),
                          count(row.n_attempts), word(row.meaning)});
  return table;
}

Table incident_table(const Summary& summary) {
  Table table{"deviations",
              titled("Deviations, notes, unblindings and checks not passed", summary),
              {{"session_id", "session"},
               {"participant", "participant"},
               {"t_s", "at s"},
               {"kind", "kind"},
               {"text", "what"}},
              {},
              "as the experimenter or the program logged them"};
  for (const Incident& row : summary.incidents)
    table.rows.push_back({word(std::to_string(row.session_id)), word(row.participant),
                          number(row.noted.t_s), named_cell(row.noted.kind), word(row.noted.text)});
  return table;
}

Table dictionary_table(const Summary& summary) {
  Table table{"dictionary",
              "Data dictionary: the columns of the log",
              {{"table", "table"}, {"column", "column"}, {"unit", "unit"}, {"meaning", "meaning"}},
              {},
              "heft export writes these as CSV, Psych-DS or BIDS, with a dictionary of their own; "
              "the CSV files of this report are explained below each of its tables and figures"};
  if (summary.sessions.empty()) return table;
  explain<TrialRow>(table, "trial");
  explain<CubeRow>(table, "cube");
  explain<AnswerRow>(table, "answer");
  explain<ReversalRow>(table, "reversal");
  explain<EstimateRow>(table, "estimate");
  explain<SessionConfig>(table, "setup");
  explain<FrameRow>(table, "frame");
  return table;
}

}  // namespace heft
