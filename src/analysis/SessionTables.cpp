// Sessions, response times and voids as tables.
#include "analysis/TableParts.h"

namespace heft {

namespace {
Table times_table(const Summary& summary) {
  Table table{"response_times",
              titled("Response times, all participants together", summary),
              {{"task", "task"},
               {"condition", "condition"},
               {"n_trials", "trials"},
               {"median_s", "median s"},
               {"lower_quartile_s", "25 %"},
               {"upper_quartile_s", "75 %"}},
              {},
              "from all cubes shown to the answer, without pauses and time with the effector out "
              "of view"};
  for (const ResponseTimes& times : summary.times)
    table.rows.push_back({named_cell(times.task), word(times.condition), count(times.n_trials),
                          number(times.median_s), number(times.lower_quartile_s),
                          number(times.upper_quartile_s)});
  return table;
}

Table voids_table(const Summary& summary) {
  Table table{"voids",
              titled("Void attempts (each was presented again)", summary),
              {{"reason", "reason"}, {"n", "n"}},
              {},
              ""};
  for (const VoidCount& reason : summary.voids)
    table.rows.push_back({word(reason.reason), count(reason.n)});
  return table;
}

Table protocol_choices_table(const Summary& summary) {
  Table table{"protocol_choices",
              "What the protocol chose where the paper leaves it open",
              {{"protocol", "protocol"}, {"choice", "choice"}, {"value", "value"}},
              {},
              "each is a key of the protocol, which is kept in the log; paper.toml explains them"};
  for (const ProtocolChoice& choice : summary.choices)
    table.rows.push_back({word(choice.protocol), word(choice.choice), word(choice.value)});
  return table;
}
}  // namespace

std::vector<Table> session_tables(const Summary& summary) {
  return {times_table(summary), voids_table(summary), protocol_choices_table(summary)};
}

Table session_list(const Summary& summary) {
  Table table{"sessions",
              titled("Sessions", summary),
              {{"session_id", "session"},
               {"participant", "participant"},
               {"protocol", "protocol"},
               {"purpose", "purpose"},
               {"responder", "responder"},
               {"state", "state"},
               {"n_completed", "completed"},
               {"n_void", "void"},
               {"n_open", "open"}},
              {},
              "completed, void and open are attempts at trials"};
  for (const SessionSummary& session : summary.sessions)
    table.rows.push_back({word(std::to_string(session.session_id)), word(session.participant),
                          word(session.protocol), word(session.purpose), word(session.responder),
                          named_cell(session.state), count(session.n_completed),
                          count(session.n_void), count(session.n_open)});
  return table;
}

}  // namespace heft
