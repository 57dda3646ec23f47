// Tables of records: participants, sessions, staircases, incidents, configurations.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "analysis/report/Tables.h"
#include "experiment/Rows.h"

namespace heft {

namespace {
// Single cubes have no reference.
Cell reference_cell(const Compared& compared) {
  if (compared.reference_g == 0) return word("");
  return {fmt::format("{:g}", compared.reference_g), compared.reference_g};
}

Cell session_cell(std::int64_t id) {
  return {std::to_string(id), static_cast<double>(id), true};
}

template <typename Enum>
Cell named_cell(Enum value) {
  return word(std::string(name_of(value)));
}

Table participant_table(const Summary& summary) {
  Table table{"participants",
              "Participants",
              {{"participant", "participant"},
               {"n_sessions", "sessions"},
               {"n_finished", "finished"},
               {"n_completed", "trials"},
               {"n_anticipatory", "anticipatory"},
               {"n_lost", "out of view"},
               {"n_catch", "catch trials"},
               {"n_false_alarms", "false alarms"},
               {"excluded_because", "excluded, because"}},
              {},
              "anticipatory: answers too early, too fast or without contact. Participants are "
              "excluded only by a rule that the protocol declares",
              {},
              "participants[]"};
  for (const ParticipantRow& row : summary.participants)
    table.rows.push_back({word(row.participant), count(row.n_sessions), count(row.n_finished),
                          count(row.n_completed), count(row.n_anticipatory), count(row.n_lost),
                          count(row.n_catch), count(row.n_false_alarms),
                          word(row.excluded_because)});
  return table;
}

Table data_quality_table(const Summary& summary) {
  Table table{"data_quality",
              "Data quality",
              {{"what", "what"}, {"n", "n"}, {"of", "of"}, {"meaning", "meaning"}},
              {},
              "of all participants; none is excluded for these, except by the protocol's rules",
              {},
              "quality.summary[]"};
  if (summary.sessions.empty()) return table;
  for (const DataQualityRow& row : summary.quality.counted)
    table.rows.push_back(
        {word(row.what), count(row.n), row.of ? count(*row.of) : Cell(), word(row.meaning)});
  return table;
}

Table losses_table(const Summary& summary) {
  Table table{"losses",
              "Voids, losses and anticipatory responses by level and condition",
              {{"task", "task"},
               {"condition", "condition"},
               {"difference", "difference"},
               {"n_attempts", "attempts"},
               {"n_void", "void"},
               {"n_lost", "out of view"},
               {"lost_s", "for s"},
               {"n_anticipatory", "anticipatory"}},
              {},
              "losses that depend on the level bias the results: compare the rows. out of view: "
              "attempts with tracking lost, and the total time",
              {},
              "quality.losses[]"};
  for (const LossRow& row : summary.quality.losses)
    table.rows.push_back({named_cell(row.task), word(row.condition), word(row.difference),
                          count(row.n_attempts), count(row.n_void), count(row.n_lost),
                          number(row.lost_s), count(row.n_anticipatory)});
  return table;
}

Table resets_table(const Summary& summary) {
  Table table{
      "resets",
      "Cubes reset to their start, by mass",
      {{"mass", "mass"}, {"n_cubes", "cubes shown"}, {"n_reset", "reset"}, {"percent", "%", "-"}},
      {},
      "if cubes are reset one by one and the percentages differ, a reset reveals the mass; resets "
      "of all cubes together (out_of_area) do not",
      {},
      "quality.resets[]"};
  for (const ResetRow& row : summary.quality.resets)
    table.rows.push_back({word(row.mass), count(row.n_cubes), count(row.n_reset),
                          number(100.0 * row.n_reset / row.n_cubes)});
  return table;
}

Table incident_table(const Summary& summary) {
  Table table{"deviations",
              "Deviations, notes, unblindings and checks not passed",
              {{"session_id", "session"},
               {"participant", "participant"},
               {"t_s", "at s"},
               {"kind", "kind"},
               {"text", "what"}},
              {},
              "as logged by the experimenter or the program"};
  for (const Incident& row : summary.incidents)
    table.rows.push_back({session_cell(row.session_id), word(row.participant),
                          number(row.noted.t_s), named_cell(row.noted.kind), word(row.noted.text)});
  return table;
}

Table published_table(const Summary& summary) {
  Table table{"beside_published",
              "Observed and published figures",
              {{"figure", "figure"},
               {"unit", "unit"},
               {"observed", "observed"},
               {"observed_sd", "SD"},
               {"observed_low", "95 % low"},
               {"observed_high", "high"},
               {"n_participants", "n"},
               {"published", "published"},
               {"published_sd", "SD"},
               {"published_low", "95 % low"},
               {"published_high", "high"},
               {"source", ""}},
              {},
              std::string(published::about_figures)};
  for (const StudyEstimate* one : published_among(summary.estimates)) {
    const published::Figure& figure = *one->published;
    const auto paper = interval_of(figure);
    const auto end = [&](double Interval::*which) {
      return number(paper ? std::optional(*paper.*which) : std::nullopt);
    };
    table.rows.push_back({word(std::string(figure.what)), word(std::string(one->measure->unit)),
                          number(one->value), number(one->sd), number(one->low), number(one->high),
                          count(one->n), number(figure.value), number(figure.sd),
                          end(&Interval::low), end(&Interval::high),
                          word(std::string(figure.source))});
  }
  return table;
}

Table flow_table(const Summary& summary) {
  Table table{"participant_flow",
              "Participant flow",
              {{"step", "step"}, {"n", "participants"}, {"meaning", "meaning"}},
              {},
              "how many were planned is not in a log"};
  const ParticipantFlow& flow = summary.flow;
  if (flow.n_asked == 0) return table;
  const auto add = [&](std::string step, int n, std::string meaning) {
    table.rows.push_back({word(std::move(step)), count(n), word(std::move(meaning))});
  };
  add("asked", flow.n_asked, "with a session in the log");
  if (flow.n_withdrawn > 0) add("withdrawn", flow.n_withdrawn, "sessions whose data were removed");
  add("declined", flow.n_declined, "did not agree to take part");
  add("started", flow.n_started, "began a trial");
  for (const auto& [state, n] : flow.unfinished)
    add("finished no session", n, "the last one is " + state);
  add("finished", flow.n_finished, "a session or more");
  for (const auto& [rule, n] : flow.excluded) add("excluded", n, rule);
  add("analyzed", flow.n_analyzed, "in the figures");
  if (flow.n_practice_trials > 0)
    add("practice trials", flow.n_practice_trials, "attempts, of all participants; in no figure");
  return table;
}

Table session_table(const Summary& summary) {
  Table table{"sessions",
              "Sessions",
              {{"session_id", "session"},
               {"participant", "participant"},
               {"protocol", "protocol"},
               {"purpose", "purpose"},
               {"responder", "responder"},
               {"state", "state"},
               {"n_completed", "completed"},
               {"n_void", "void"},
               {"n_open", "open"},
               {"n_pictures", "pictures"},
               {"n_dropped", "dropped"},
               {"n_late", "late"},
               {"n_doubled", "doubled"}},
              {},
              "completed, void and open are attempts at trials; dropped, late and doubled (with a "
              "second print of a tag in view) are camera pictures",
              {},
              "sessions[]"};
  for (const SessionSummary& session : summary.sessions)
    table.rows.push_back({session_cell(session.session_id), word(session.participant),
                          word(session.protocol), word(session.purpose), word(session.responder),
                          named_cell(session.state), count(session.n_completed),
                          count(session.n_void), count(session.n_open),
                          count(session.pictures.shown), count(session.pictures.dropped),
                          count(session.pictures.late), count(session.pictures.doubled)});
  return table;
}

Table staircase_table(const Summary& summary) {
  Table table{"staircases",
              "Finished staircases",
              {{"session_id", "session"},
               {"participant", "participant"},
               {"staircase", "staircase"},
               {"reference_g", "reference g"},
               {"condition", "condition"},
               {"jnd_g", "JND g"},
               {"censored", "censored"},
               {"why_censored", "because"},
               {"start_g", "start g"},
               {"n_trials", "trials"},
               {"n_reversals", "reversals"},
               {"n_floor", "floor hits"},
               {"n_ceiling", "ceiling hits"},
               {"reason", "ended by"},
               {"method", "method"},
               {"low_g", "from g"},
               {"high_g", "to g"},
               {"block", "judgment"}},
              {},
              ""};
  const auto add = [&](const StaircaseResult& result) {
    Cell shown = number(result.shown_g);
    shown.text = std::string(beyond_sign(result.censored)) + shown.text;
    table.rows.push_back(
        {session_cell(result.session_id), word(result.participant), word(result.staircase),
         reference_cell(result.compared), word(result.compared.condition), shown,
         named_cell(result.censored), word(result.why), number(result.start_g),
         count(result.n_trials), count(result.n_reversals), count(result.n_floor),
         count(result.n_ceiling), named_cell(result.reason), word(result.compared.method),
         number(result.low_g), number(result.high_g), word(result.compared.block)});
  };
  std::ranges::for_each(summary.shared->staircases.results(), add);
  std::ranges::for_each(summary.shared->judgments.results(), add);
  return table;
}

Table choices_of_protocols(const Summary& summary) {
  Table table{"protocol_choices",
              "Protocol choices that the paper does not specify",
              {{"protocol", "protocol"}, {"choice", "choice"}, {"value", "value"}},
              {},
              "protocol keys, explained in paper.toml; the log keeps the protocol"};
  for (const ProtocolChoice& choice : summary.choices)
    table.rows.push_back({word(choice.protocol), word(choice.choice), word(choice.value)});
  return table;
}

Table setup_table(const Summary& summary) {
  Table table{"setups",
              "Session configurations",
              {{"what", "what"},
               {"value", "value"},
               {"unit", "unit"},
               {"n_sessions", "sessions"},
               {"n_attempts", "attempts"},
               {"meaning", "meaning"}},
              {},
              "several values of one setting: it differed between sessions or changed during one. "
              "Protocol, hash, build and seeds are in the table of protocol choices"};
  for (const SetupValue& row : summary.setups)
    table.rows.push_back({word(row.what), word(row.value), word(row.unit), count(row.n_sessions),
                          count(row.n_attempts), word(row.meaning)});
  return table;
}

template <typename Row>
void explain(Table& table, const char* log_table) {
  visit_cells(Row{}, [&](const CellColumn& column, const auto&) {
    table.rows.push_back({word(log_table), word(column.full_name()), word(std::string(column.unit)),
                          word(std::string(column.meaning))});
  });
}

Table dictionary_table(const Summary& summary) {
  Table table{
      "dictionary",
      "Data dictionary: the columns of the log",
      {{"table", "table"}, {"column", "column"}, {"unit", "unit"}, {"meaning", "meaning"}},
      {},
      "heft export writes these as CSV, Psych-DS or BIDS, with a separate dictionary; the CSV "
      "files of this report are explained below each of its tables and figures, and measures.csv "
      "says what each measure is"};
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
}  // namespace

std::vector<RecordTable> record_tables() {
  return {{TablePlace::report_first, participant_table},
          {TablePlace::first, data_quality_table},
          {TablePlace::first, losses_table},
          {TablePlace::first, resets_table},
          {TablePlace::report_first, incident_table},
          {TablePlace::report, published_table},
          {TablePlace::run, choices_of_protocols},
          {TablePlace::run_only, setup_table},
          {TablePlace::run_only, dictionary_table},
          {TablePlace::csv, flow_table},
          {TablePlace::csv, session_table},
          {TablePlace::csv, staircase_table}};
}

Table track_table(const SessionTracks& session) {
  Table table{"staircase_trials",
              "Every trial of every staircase",
              {{"session_id", "session"},
               {"participant", "participant"},
               {"staircase", "staircase"},
               {"reference_g", "reference g"},
               {"condition", "condition"},
               {"trial", "trial"},
               {"level_g", "difference g"},
               {"chosen", "chosen"},
               {"incorrect", "incorrect"},
               {"reversal", "reversal"},
               {"block", "block"},
               {"question", "question"},
               {"positive", "positive answers"}},
              {},
              ""};
  for (const Track& track : session.tracks)
    for (std::size_t i = 0; i < track.points.size(); ++i) {
      const TrackPoint& point = track.points[i];
      table.rows.push_back(
          {session_cell(session.session_id), word(session.participant), word(track.staircase),
           reference_cell(track.compared), word(track.compared.condition),
           count(static_cast<int>(i) + 1), number(point.level_g), count(point.chosen ? 1 : 0),
           count(point.wrong ? 1 : 0), count(point.is_reversal ? 1 : 0), word(track.compared.block),
           word(track.question), word(fmt::format("{}", fmt::join(track.positive, ", ")))});
    }
  return table;
}

}  // namespace heft
