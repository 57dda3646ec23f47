// What is counted first, and how well masses are told apart, as tables.
#include "analysis/TableParts.h"

namespace heft {

namespace {
Table counted_table(const Summary& summary) {
  Table table{"counted_first",
              titled("Counted before anything else", summary),
              {{"what", "what"}, {"n", "n"}, {"of", "of"}, {"meaning", "meaning"}},
              {},
              "nobody and nothing is left out for any of it"};
  if (summary.sessions.empty()) return table;
  for (const CountedRow& row : summary.quality.counted)
    table.rows.push_back(
        {word(row.what), count(row.n), row.of ? count(*row.of) : Cell(), word(row.meaning)});
  return table;
}

Table losses_table(const Summary& summary) {
  Table table{"losses",
              titled("Voids, losses and impossible answers by level and condition", summary),
              {{"task", "task"},
               {"condition", "condition"},
               {"difference", "difference"},
               {"n_attempts", "attempts"},
               {"n_void", "void"},
               {"n_lost", "out of view"},
               {"lost_s", "for s"},
               {"n_impossible", "impossible"}},
              {},
              "losses that go with the level are bias: compare the rows. out of view: attempts in "
              "which the effector was, and for how long in all"};
  for (const LossRow& row : summary.quality.losses)
    table.rows.push_back({named_cell(row.task), word(row.condition), word(row.difference),
                          count(row.n_attempts), count(row.n_void), count(row.n_lost),
                          number(row.lost_s), count(row.n_impossible)});
  return table;
}

Table resets_table(const Summary& summary) {
  Table table{
      "resets",
      titled("Cubes that were put back to their start, by mass", summary),
      {{"mass", "mass"}, {"n_cubes", "cubes shown"}, {"n_reset", "put back"}, {"percent", "%"}},
      {},
      "where cubes go back each by itself and the percentages differ, one that jumps home tells "
      "its mass; where all of a trial go back together (out_of_area), it does not"};
  for (const ResetRow& row : summary.quality.resets)
    table.rows.push_back({word(row.mass), count(row.n_cubes), count(row.n_reset),
                          number(100.0 * row.n_reset / row.n_cubes)});
  return table;
}

Table sensitivity_table(const Summary& summary) {
  Table table{
      "sensitivity",
      titled("How well masses are told apart: difference that is told rightly in 75 %", summary),
      {{"reference_g", "reference g"},
       {"condition", "condition"},
       {"n", "n"},
       {"threshold_75_g", "threshold g"},
       {"low_g", "95 % low"},
       {"high_g", "high"},
       {"indecision", "indecision"},
       {"indecision_low", ""},
       {"indecision_high", ""},
       {"sensitivity_per_g", ""},
       {"why", "no threshold, because"}},
      {},
      "indecision model (left, none, right; lapse rate .02) with criteria and side bias of each "
      "participant's own; the median participant's threshold of a forced choice, free of the "
      "criterion. Interval: bootstrap over participants. Indecision: half the width between the "
      "median participant's criteria in SDs of what is felt. What the data can't bear is not "
      "printed."};
  for (const ReferenceSensitivity& row : summary.sensitivity) {
    const PooledSensitivity& pooled = row.pooled;
    table.rows.push_back({mass(row.compared.reference_g), word(row.compared.condition),
                          count(pooled.n), number(pooled.threshold_75_g),
                          low(pooled.threshold_interval_g), high(pooled.threshold_interval_g),
                          number(pooled.indecision, 2), low(pooled.indecision_interval),
                          high(pooled.indecision_interval), number(pooled.sensitivity, 5),
                          word(pooled.why)});
  }
  return table;
}
}  // namespace

Cell kind_word(MeanKind kind) {
  if (kind == MeanKind::none) return {};
  return word(kind == MeanKind::mean ? "mean" : "Tobit mean");
}

std::vector<Table> quality_tables(const Summary& summary) {
  return {counted_table(summary), losses_table(summary), resets_table(summary)};
}

std::vector<Table> sensitivity_tables(const Summary& summary) {
  return {sensitivity_table(summary)};
}

}  // namespace heft
