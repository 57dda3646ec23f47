// Sorting and introduction as tables.
#include "analysis/TableParts.h"

namespace heft {

namespace {
void add_proportion(Table& table, const ConditionSorting& sorting, std::string_view trials,
                    std::string_view answer, const Proportion& proportion) {
  if (proportion.n_participants == 0) return;
  const std::string method = proportion.method == IntervalMethod::exact ? "exact" : "participants";
  table.rows.push_back(
      {word(sorting.condition), word(std::string(trials)), word(std::string(answer)),
       number(proportion.mean_percent), number(proportion.sd_percent),
       low(proportion.interval_percent), high(proportion.interval_percent), word(method),
       count(proportion.n_participants), count(proportion.trials.n_hits),
       count(proportion.trials.n_trials), number(proportion.pooled_percent),
       number(proportion.published_percent), number(proportion.published_sd_percent)});
}

Table sorting_table(const Summary& summary) {
  Table table{
      "sorting",
      titled("Sorting: percentage of trials, mean over participants", summary),
      {{"condition", "condition"},
       {"trials", "of trials"},
       {"answer", "answer"},
       {"mean_percent", "mean %"},
       {"sd_percent", "SD"},
       {"low_percent", "95 % low"},
       {"high_percent", "high"},
       {"interval", "interval"},
       {"n_participants", "n"},
       {"n_hits", ""},
       {"n_trials", "trials"},
       {"pooled_percent", "pooled %"},
       {"published_percent", "published %"},
       {"published_sd_percent", "published SD"}},
      {},
      "n participants; SD between them (n-1). Interval over participants: a score interval with "
      "the trials that their differences leave effective, and Student's t; exact (Clopper-Pearson) "
      "over people where all have the same percentage, over the trials of one alone. The published "
      "10.1 % of answered C1 trials is a ratio of "
      "means, nearest to pooled."};
  for (const ConditionSorting& sorting : summary.sorting) {
    add_proportion(table, sorting, "all", "correct", sorting.correct);
    add_proportion(table, sorting, "all", "incorrect", sorting.incorrect);
    add_proportion(table, sorting, "all", "I don't know", sorting.none);
    add_proportion(table, sorting, "answered", "correct", sorting.answered_correct);
    add_proportion(table, sorting, "answered", "incorrect", sorting.answered_incorrect);
  }
  return table;
}

Table swaps_table(const Summary& summary) {
  Table table{"swapped",
              titled("Incorrect sortings: which cubes were taken for each other", summary),
              {{"condition", "condition"},
               {"n_incorrect", "incorrect"},
               {"light_intermediate", "light-intermediate"},
               {"intermediate_heavy", "intermediate-heavy"},
               {"light_heavy", "light-heavy"},
               {"all_three", "all three"}},
              {},
              "numbers of trials"};
  for (const ConditionSorting& sorting : summary.sorting) {
    const int n_incorrect = sorting.incorrect.trials.n_hits;
    if (n_incorrect == 0) continue;
    std::vector<Cell> row{word(sorting.condition), count(n_incorrect)};
    for (int n : sorting.swaps) row.push_back(count(n));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table introduction_table(const Summary& summary) {
  Table table{"introduction",
              titled("Introduction: right on the first try", summary),
              {{"n_participants", "participants"},
               {"n_first_try", "first try"},
               {"percent", "%"},
               {"low_percent", "95 % low"},
               {"high_percent", "high"},
               {"published_percent", "published %"},
               {"published_n_participants", "published n"}},
              {},
              "exactly one cube was selected; exact interval"};
  const auto& [rate, published_percent, published_n] = summary.introduction;
  if (rate.percent)
    table.rows.push_back({count(rate.trials.n_trials), count(rate.trials.n_hits),
                          number(rate.percent), low(rate.interval_percent),
                          high(rate.interval_percent), number(published_percent),
                          number(published_n, 0)});
  return table;
}
}  // namespace

std::vector<Table> sorting_tables(const Summary& summary) {
  return {introduction_table(summary), sorting_table(summary), label_table(summary),
          swaps_table(summary)};
}

}  // namespace heft
