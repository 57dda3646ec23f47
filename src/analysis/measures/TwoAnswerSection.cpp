#include "analysis/measures/TwoAnswerSection.h"

#include <string_view>
#include <tuple>

#include "analysis/display/Phrases.h"
#include "analysis/measures/Sensitivity.h"
#include "psychophysics/ProcedureKinds.h"

namespace heft {

namespace {

// Reason that the differences are not constant stimuli; empty: they are, as those of catch trials.
std::string why_not_constant(const SessionData& data, const TrialPlan& plan) {
  if (plan.staircase.empty()) return "";
  const auto found = data.staircases.find(plan.staircase);
  if (found == data.staircases.end()) return "the procedure that chose the differences is unknown";
  if (found->second.before->get_if<Constant>()) return "";
  return "an adaptive procedure chose the differences by earlier answers";
}

// Up-down or QUEST, from 0 up: levels of either sign are the same difference.
bool may_follow_random_answers(const SessionData& data, const std::string& staircase) {
  const auto found = data.staircases.find(staircase);
  if (found == data.staircases.end()) return false;
  const Procedure& procedure = *found->second.before;
  if (const UpDown* up_down = procedure.get_if<UpDown>())
    return up_down->config().floor.value_or(-1) >= 0;
  return procedure.get_if<Quest>() != nullptr;
}

Compared in_staircases(const Compared& compared) {
  Compared key = compared;
  key.method = same_different_method;
  return key;
}

// One participant's estimate, still without a measure and a value.
StudyEstimate own_estimate(const Compared& compared, const std::string& participant,
                           const AnswersByLevel& answers) {
  StudyEstimate own{nullptr, "comparison", compared.condition, compared.reference_g};
  own.participant = participant;
  own.n = 1;
  own.n_trials = static_cast<int>(trials_in(answers));
  return own;
}

// Participants' estimates, grouped by reference, condition and measure.
std::vector<std::vector<const StudyEstimate*>> together(const Estimates& own) {
  std::map<std::tuple<std::optional<double>, std::string, std::string_view>,
           std::vector<const StudyEstimate*>>
      groups;
  for (const StudyEstimate& one : own)
    groups[{one.reference_g, one.condition, one.measure->name}].push_back(&one);
  std::vector<std::vector<const StudyEstimate*>> all;
  for (auto& [key, people] : groups) all.push_back(std::move(people));
  return all;
}

}  // namespace

void TwoAnswerSection::add(const SessionData& data) {
  std::map<std::string, Compared> staircases;
  for (const Attempt& attempt : data.attempts) {
    const std::optional<TwoWayAnswer> answer = task_.answer_of(attempt);
    if (!answer) continue;
    const TrialPlan& plan = attempt.trial.plan;
    const Compared compared{*plan.reference_g, plan.condition};
    people_[compared][data.participant()][answer->level_g][answer->counted ? 1 : 0] += 1;
    if (const std::string why = why_not_constant(data, plan); !why.empty())
      not_constant_[{compared, data.participant()}] = why;
    if (task_.may_be_random && may_follow_random_answers(data, plan.staircase))
      staircases.emplace(plan.staircase, in_staircases(compared));
  }
  staircases_.add(data, staircases);
}

void TwoAnswerSection::put_random() {
  for (const auto& [compared, people] : people_)
    if (const std::string why = staircases_.why_random(in_staircases(compared)); !why.empty())
      random_[compared] = why;
}

Estimates TwoAnswerSection::of_participants(const Summary&) const {
  Estimates all;
  for (const auto& [compared, people] : people_)
    for (const auto& [participant, answers] : people) {
      const StudyEstimate own = own_estimate(compared, participant, answers);
      const auto random = random_.find(compared);
      const bool is_random =
          random != random_.end() && not_constant_.contains({compared, participant});
      put_fit(all, own, answers, is_random ? random->second : "");
      put_goodness(all, own, goodness_.at({compared, participant}));
    }
  for (StudyEstimate& one : own_exponents(all, task_.threshold, task_.exponent)) all.push_back(one);
  return all;
}

void TwoAnswerSection::put(Summary& summary) {
  put_random();
  for (const auto& [compared, people] : people_)
    for (const auto& [participant, answers] : people)
      goodness_[{compared, participant}] = summary.checks_models
                                               ? goodness({compared, participant}, answers)
                                               : GoodnessOfFit{.why = "not checked"};
  const Estimates own = of_participants(summary);
  for (const auto& people : together(own)) {
    const Measure* measure = people.front()->measure;
    if (measure == &task_.deviance) continue;  // deviances have no mean
    const bool is_positive = measure == &task_.threshold || measure == &task_.weber_fraction;
    summary.estimates.push_back(measure == &task_.fit_p ? rejected_of(people)
                                                        : over_people(people, is_positive));
  }
  for (const auto& [compared, people] : people_) put_shares(summary.estimates, compared, people);
}

std::vector<std::string> TwoAnswerSection::findings(const Summary& summary) const {
  return threshold_findings(summary, task_.finding, task_.threshold.name);
}

GoodnessOfFit TwoAnswerSection::goodness(const Person& person,
                                         const AnswersByLevel& answers) const {
  const auto why = not_constant_.find(person);
  return why != not_constant_.end() ? GoodnessOfFit{.why = why->second} : task_.check(answers);
}

void TwoAnswerSection::put_fit(Estimates& all, StudyEstimate own, const AnswersByLevel& answers,
                               const std::string& why_random) const {
  TwoAnswerFit found = task_.fit(answers);
  if (found.why.empty()) found.why = why_random;
  const auto put = [&](const Measure& measure, const FittedParameter& fitted) {
    own.measure = &measure;
    own.method = task_.method;
    own.why = found.why;
    if (own.why.empty()) {
      own.value = fitted.value;
      own.low = fitted.low;
      own.high = fitted.high;
    }
    all.push_back(own);
  };
  put(task_.threshold, found.threshold);
  if (const auto fraction = weber_fraction_of(own, task_.weber_fraction)) all.push_back(*fraction);
  if (found.second) put(task_.second, *found.second);
}

void TwoAnswerSection::put_goodness(Estimates& all, StudyEstimate own,
                                    const GoodnessOfFit& found) const {
  own.why = found.why;
  for (const auto& [measure, value] :
       {std::pair(&task_.deviance, found.deviance), {&task_.fit_p, found.p}}) {
    own.measure = measure;
    own.value = value;
    all.push_back(own);
  }
}

// How many fits are rejected, of those that are judged.
StudyEstimate TwoAnswerSection::rejected_of(const std::vector<const StudyEstimate*>& people) const {
  StudyEstimate count = *people.front();
  count.measure = &task_.rejected;
  count.participant.clear();
  count.value.reset();
  count.n = count.n_trials = 0;
  for (const StudyEstimate* own : people) {
    count.n_trials += own->n_trials;
    if (!own->value) continue;
    count.n += 1;
    count.value = count.value.value_or(0) + (*own->value < 0.05 ? 1 : 0);
  }
  if (count.n > 0) count.why.clear();
  return count;
}

void TwoAnswerSection::put_shares(Estimates& all, const Compared& compared,
                                  const AnswersByPerson& people) const {
  std::map<double, Tallies> by_level;
  for (const auto& [participant, answers] : people)
    for (const auto& [level_g, n] : answers)
      by_level[level_g][participant] = {static_cast<int>(n[1]), static_cast<int>(n[0] + n[1])};
  for (const auto& [level_g, tallies] : by_level) {
    StudyEstimate& one = all.emplace_back(rate_estimate(task_.share, rate_of(tallies)));
    one.task = "comparison";
    one.condition = compared.condition;
    one.reference_g = compared.reference_g;
    one.by = {at("level_g", level_g)};
  }
}

std::vector<EstimateTable> TwoAnswerSection::tables() const {
  return {threshold_table(),
          exponent_table(task_.name + "_exponents", task_.exponents_title, task_.exponent),
          share_table(), people_table(),
          own_exponent_table(task_.name + "_exponents_by_participant", task_.own_exponents_title,
                             task_.exponent)};
}

EstimateTable TwoAnswerSection::threshold_table() const {
  EstimateTable table{
      task_.name,
      task_.thresholds_title,
      {key_column("reference_g", "reference g"), key_column("condition", "condition"),
       column(task_.threshold, Field::n, task_.n_column, "n"),
       column(task_.threshold, Field::n_trials, "n_trials", "trials"),
       column(task_.threshold, Field::value, "threshold_75_g", "threshold g")},
      task_.thresholds_note,
      TablePlace::results,
      task_.name + "[]"};
  add_interval(table.columns, task_.threshold, "low_g", "high_g", 1);
  add_weber_fraction(table.columns, task_.weber_fraction);
  table.columns.push_back(task_.second_column);
  add_interval(table.columns, task_.second, task_.second_interval.first,
               task_.second_interval.second, task_.second_column.decimals);
  table.columns.push_back(column(task_.threshold, Field::why, "why", "no threshold: why"));
  table.columns.push_back(column(task_.rejected, Field::n, "n_fits_judged", "fits judged"));
  table.columns.push_back(column(task_.rejected, Field::value, "n_fits_rejected", "rejected", 0));
  table.columns.push_back(column(task_.rejected, Field::why, "fits_why", "not judged: why"));
  return table;
}

EstimateTable TwoAnswerSection::people_table() const {
  EstimateTable table{
      task_.name + "_by_participant",
      task_.people_title,
      {key_column("reference_g", "reference g"), key_column("condition", "condition"),
       key_column("participant", "participant"),
       column(task_.threshold, Field::value, "threshold_75_g", "threshold g"),
       column(task_.threshold, Field::low, "low_g", "low"),
       column(task_.threshold, Field::high, "high_g", "high"), task_.second_column,
       column(task_.threshold, Field::n_trials, "n_trials", "trials"),
       column(task_.threshold, Field::why, "why", "no threshold: why")},
      "",
      TablePlace::csv};
  table.participants = true;
  add_weber_fraction(table.columns, task_.weber_fraction);
  table.columns.push_back(column(task_.deviance, Field::value, "deviance", "deviance", 2));
  table.columns.push_back(column(task_.fit_p, Field::value, "fit_p", "p of the fit", 3));
  table.columns.push_back(column(task_.fit_p, Field::why, "fit_why", "not judged: why"));
  return table;
}

EstimateTable TwoAnswerSection::share_table() const {
  EstimateTable table{task_.name + "_by_level",
                      task_.share_title,
                      {key_column("reference_g", "reference g"),
                       key_column("condition", "condition"), key_column("level_g", "difference g"),
                       column(task_.share, Field::n_trials, "n_trials", "trials"),
                       column(task_.share, Field::n_hits, "n_" + task_.counted, task_.counted),
                       column(task_.share, Field::value, task_.counted + "_percent", "%")},
                      task_.share_note,
                      TablePlace::csv};
  add_interval(table.columns, task_.share, "low_percent", "high_percent", 1);
  return table;
}

std::vector<ChartSpec> TwoAnswerSection::charts() const {
  return {{.name = task_.name,
           .title = task_.share_title,
           .caption = task_.share_caption,
           .csv = task_.name + "_by_level.csv",
           .importance = 38,
           .series = {{&task_.share}},
           .x = "level_g",
           .panels = {"reference_g", "condition"},
           .x_label = "difference (g)",
           .y_label = "% of trials",
           .axes = "set yrange [0:100]\n"}};
}

}  // namespace heft
