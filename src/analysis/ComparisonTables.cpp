// JNDs, staircases and choices as tables.
#include "analysis/TableParts.h"

namespace heft {

namespace {
// "> 1136.2" for what is known to lie above; the CSV has the number and the kind apart.
Cell shown_jnd(const StaircaseResult& result) {
  Cell cell = number(result.shown_g);
  cell.text = std::string(beyond_sign(result.censored)) + cell.text;
  return cell;
}

// The paper's staircases began above, so that its figures stand beside those.
void add_jnds(Table& table, const ReferenceJnd& jnd, std::string_view staircases,
              const StartedJnds& jnds, bool as_published = true) {
  const auto published = [&](const std::optional<double>& figure) {
    return number(as_published ? figure : std::nullopt);
  };
  table.rows.push_back(
      {mass(jnd.compared.reference_g), word(jnd.compared.condition), word(std::string(staircases)),
       number(jnds.mean), number(jnds.sd), low(jnds.interval), high(jnds.interval),
       kind_word(jnds.kind), count(jnds.n()), count(jnds.n_censored(Censored::above)),
       count(jnds.n_censored(Censored::below)), count(jnds.n_missing), published(jnd.published_g),
       published(jnd.published_sd_g), word(jnd.compared.method)});
}

Table jnd_table(const Summary& summary) {
  Table table{"jnd",
              titled("JND by reference mass, mean over participants", summary),
              {{"reference_g", "reference g"},
               {"condition", "condition"},
               {"staircases", "staircases"},
               {"mean_g", "JND g"},
               {"sd_g", "SD"},
               {"low_g", "95 % low"},
               {"high_g", "high"},
               {"summary", "is the"},
               {"n", "n"},
               {"n_censored_above", "above"},
               {"n_censored_below", "below"},
               {"n_missing", "missing"},
               {"published_g", "published g"},
               {"published_sd_g", "published SD"},
               {"method", "method"}},
              {},
              "n participants; SD between them (n-1). The paper's JND: it moves with the criterion "
              "as much as with what is perceived, and with where its staircase began: where they "
              "began on both sides, these are apart, and above - below is by how much each "
              "participant's JND follows the start. Above, below: participants of whom it is only "
              "known to lie there, as a staircase ended at a bound, at its trial limit or with "
              "fewer than 4 reversals; missing: not even that. Where all are exact, the mean with "
              "Student's t interval; otherwise the Tobit mean (normal model of exact and censored "
              "ones together) with its profile interval; none where half or more are not exact."};
  for (const ReferenceJnd& jnd : summary.jnd) {
    if (!jnd.starts) {
      add_jnds(table, jnd, "all", jnd.as_published());
      continue;
    }
    add_jnds(table, jnd, "from above", jnd.starts->from_above_g);
    add_jnds(table, jnd, "from below", jnd.starts->from_below_g, false);
    add_jnds(table, jnd, "above - below", jnd.starts->difference_g, false);
  }
  return table;
}

Table staircase_health_table(const Summary& summary) {
  Table table{"staircase_health",
              titled("How the staircases went", summary),
              {{"reference_g", "reference g"},
               {"condition", ""},
               {"n_staircases", "finished"},
               {"n_unfinished", "unfinished"},
               {"mean_trials", "trials"},
               {"least_trials", "least"},
               {"most_trials", "most"},
               {"n_trial_limit", "at limit"},
               {"n_without_estimate", "no JND"},
               {"n_floor", "floor"},
               {"n_floor_staircases", "in"},
               {"n_ceiling", "ceiling"},
               {"n_ceiling_staircases", "in"}},
              {},
              "staircases; trials: mean, least and most of the finished; at limit: ended by the "
              "trial limit; "
              "floor, ceiling: moves that the bound cut short, and in how many staircases"};
  for (const ReferenceJnd& jnd : summary.jnd) {
    const bool any = jnd.n_staircases > 0;
    table.rows.push_back(
        {mass(jnd.compared.reference_g), word(jnd.compared.condition), count(jnd.n_staircases),
         count(jnd.n_unfinished), any ? number(jnd.mean_trials) : Cell(),
         any ? count(jnd.least_trials) : Cell(), any ? count(jnd.most_trials) : Cell(),
         count(jnd.n_trial_limit), count(jnd.n_without_estimate), count(jnd.n_floor),
         count(jnd.n_floor_staircases), count(jnd.n_ceiling), count(jnd.n_ceiling_staircases)});
  }
  return table;
}

void add_choices(Table& table, Cell reference, int n_trials, const Rate& wrong_cube,
                 const Rate& false_alarm, const Rate& at_zero) {
  table.rows.push_back({std::move(reference), count(n_trials), count(wrong_cube.trials.n_trials),
                        count(wrong_cube.trials.n_hits), number(wrong_cube.percent),
                        low(wrong_cube.interval_percent), high(wrong_cube.interval_percent),
                        count(false_alarm.trials.n_trials), count(false_alarm.trials.n_hits),
                        number(false_alarm.percent), low(false_alarm.interval_percent),
                        high(false_alarm.interval_percent), count(at_zero.trials.n_trials),
                        count(at_zero.trials.n_hits)});
}

Table choices_table(const Summary& summary) {
  Table table{
      "choices",
      titled("Choices in comparisons: wrong cubes and false alarms", summary),
      {{"reference_g", "reference g"},
       {"n_trials", "trials"},
       {"n_choices", "choices"},
       {"n_wrong_cube", "wrong"},
       {"wrong_cube_percent", "%"},
       {"wrong_cube_low_percent", "low"},
       {"wrong_cube_high_percent", "high"},
       {"n_catch", "catch"},
       {"n_false_alarm", "alarms"},
       {"false_alarm_percent", "%"},
       {"false_alarm_low_percent", "low"},
       {"false_alarm_high_percent", "high"},
       {"n_level_zero", "at 0 g"},
       {"n_chosen_level_zero", "chosen"}},
      {},
      "choices between cubes that differ, and wrong ones; catch trials and false alarms; at 0 g: "
      "staircase trials whose difference reached 0. 95 % intervals over participants, "
      "of whom one with more trials counts more. The paper gives no such figures."};
  const ComparisonSummary& comparison = summary.comparison;
  int n_trials = 0;
  for (const ComparisonChoices& choices : comparison.by_reference) {
    add_choices(table, mass(choices.reference_g), choices.n_trials, choices.wrong_cube,
                choices.false_alarm, choices.at_zero);
    n_trials += choices.n_trials;
  }
  if (table.rows.size() > 1)
    add_choices(table, word("all"), n_trials, comparison.wrong_cube, comparison.false_alarm,
                comparison.at_zero);
  return table;
}
}  // namespace

std::vector<Table> comparison_tables(const Summary& summary) {
  return {jnd_table(summary), staircase_health_table(summary), choices_table(summary)};
}

Table staircase_list(const Summary& summary) {
  Table table{"staircases",
              titled("Finished staircases", summary),
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
               {"high_g", "to g"}},
              {},
              ""};
  for (const StaircaseResult& result : summary.staircases)
    table.rows.push_back(
        {word(std::to_string(result.session_id)), word(result.participant), word(result.staircase),
         mass(result.compared.reference_g), word(result.compared.condition), shown_jnd(result),
         named_cell(result.censored), word(result.why), number(result.start_g),
         count(result.n_trials), count(result.n_reversals), count(result.n_floor),
         count(result.n_ceiling), named_cell(result.reason), word(result.compared.method),
         number(result.low_g), number(result.high_g)});
  return table;
}

Table level_list(const Summary& summary) {
  Table table{"choices_by_level",
              titled("Choices in comparisons by difference, without catch trials", summary),
              {{"reference_g", "reference g"},
               {"level_g", "difference g"},
               {"n_trials", "trials"},
               {"n_chosen", "chosen"},
               {"n_choices", "choices between different cubes"},
               {"n_wrong_cube", "wrong cube"}},
              {},
              ""};
  for (const ComparisonChoices& level : summary.comparison.by_level)
    table.rows.push_back({mass(level.reference_g), number(level.level_g), count(level.n_trials),
                          count(level.difference.trials.n_hits),
                          count(level.wrong_cube.trials.n_trials),
                          count(level.wrong_cube.trials.n_hits)});
  return table;
}

}  // namespace heft
