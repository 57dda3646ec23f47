// Comparisons in a forced choice (answers = "heavier"): how often the comparison was chosen at each
// difference, and each participant's 75 % threshold and point of subjective equality.
#include <fmt/format.h>

#include <map>
#include <tuple>

#include "analysis/measures/Section.h"
#include "analysis/measures/Sensitivity.h"
#include "analysis/measures/ShareByLevel.h"
#include "analysis/report/Notes.h"

namespace heft {

namespace {
constexpr Measure threshold{
    "forced_threshold_75", "g", "75 % threshold",
    "difference in mass that makes 75 % of forced choices correct, lapses apart: cumulative normal "
    "fitted to each participant by maximum likelihood with 2 % lapses; mean over participants, "
    "Student's t interval; of one alone the fit's interval"};
constexpr Measure weber_fraction{
    "forced_weber_fraction", "", "Weber fraction",
    "75 % threshold of forced choices by the mass of the reference: mean over participants, "
    "Student's t interval; of one alone the fit's interval"};
constexpr Measure exponent{
    "forced_threshold_exponent", "", "exponent",
    "slope of the logarithm of a participant's 75 % threshold of forced choices on the logarithm "
    "of the reference: mean over participants, Student's t interval; 0 if thresholds are equal, 1 "
    "if Weber fractions are"};
constexpr Measure pse{
    "forced_pse", "g", "point of subjective equality",
    "difference in mass at which the comparison is chosen in half of the forced choices, from the "
    "same fit; where no comparison was lighter than its reference it is not estimated"};
constexpr Measure deviance{
    "forced_deviance", "", "deviance",
    "of the fit from the saturated model, with one free share for each difference, where "
    "differences were constant stimuli"};
constexpr Measure fit_p{
    "forced_fit_p", "", "p of the fit",
    "share of 1000 simulated data sets of the same design, from the fitted curve and fitted again, "
    "whose deviance is as large; small: the curve does not describe the answers"};
constexpr Measure rejected{"forced_fits_rejected", "", "fits rejected",
                           "number of participants whose fit has p < .05, of those whose fit can "
                           "be judged; about 5 % are expected if all curves are right"};
constexpr Measure chosen{"forced_chosen", "%", "the comparison",
                         "share of forced choices at a difference in which the comparison was "
                         "chosen, over participants"};
const ShareByLevel shares{
    .share = chosen,
    .name = "forced_choice",
    .title = "Forced choices of the comparison by difference",
    .caption =
        "Percentage of trials in which the comparison was chosen, by its mass minus the "
        "reference's; 95 % intervals over participants.",
    .hits = "chosen"};

class ForcedChoiceSection final : public Section {
 public:
  void add(const SessionData& data) override {
    for (const Attempt& attempt : data.attempts) {
      const TrialPlan& plan = attempt.trial.plan;
      if (!attempt.is_usable_comparison(ComparisonAnswers::heavier) || !attempt.trial.chosen_slot)
        continue;
      const bool comparison = attempt.trial.chosen_slot != plan.reference_slot;
      const Compared compared{*plan.reference_g, plan.condition};
      const double level_g = *plan.level_g == 0 ? 0 : *plan.level_g;  // no -0
      people_[compared][data.participant()][level_g][comparison ? 1 : 0] += 1;
      checks_.add(data, plan);
    }
  }

  Estimates of_participants(const Summary&) const override {
    Estimates all;
    for (const auto& [compared, people] : people_)
      for (const auto& [participant, answers] : people) {
        put_fit(all, compared, participant, answers);
        checks_.put_own(all, own_estimate(threshold, compared, participant, answers));
      }
    for (StudyEstimate& one : own_exponents(all, threshold, exponent)) all.push_back(one);
    return all;
  }

  void put(Summary& summary) override {
    checks_.judge(people_, summary.checks_models);
    const Estimates own = of_participants(summary);
    for (const auto& people : together(own)) {
      if (checks_.is_own(*people.front()))
        checks_.put_rejected(summary.estimates, people);
      else
        summary.estimates.push_back(over_people(people));
    }
    for (const auto& [compared, people] : people_) shares.put(summary.estimates, compared, people);
  }

  std::vector<std::string> findings(const Summary& summary) const override {
    return threshold_findings(summary, "Forced choice", threshold.name);
  }

  std::vector<EstimateTable> tables() const override {
    EstimateTable thresholds{
        "forced_choice",
        "Forced choices: 75 % threshold and point of subjective equality",
        {key_column("reference_g", "reference g"), key_column("condition", "condition"),
         column(threshold, Field::n, "n", "n"),
         column(threshold, Field::n_trials, "n_trials", "trials"),
         column(threshold, Field::value, "threshold_75_g", "threshold g")},
        "cumulative normal fitted to each participant, with 2 % lapses; mean over participants "
        "with Student's t interval, of one alone the fit's. Fits judged: those of constant "
        "stimuli; rejected: p < .05 of the deviance",
        TablePlace::results,
        "forced_choice[]"};
    add_interval(thresholds.columns, threshold, "low_g", "high_g", 1);
    add_weber_fraction(thresholds.columns, weber_fraction);
    thresholds.columns.push_back(column(pse, Field::value, "pse_g", "PSE g"));
    add_interval(thresholds.columns, pse, "pse_low_g", "pse_high_g", 1);
    thresholds.columns.push_back(column(threshold, Field::why, "why", "no threshold: why"));
    checks_.add_columns(thresholds.columns);
    EstimateTable people{
        "forced_choice_by_participant",
        "Each participant's 75 % threshold in forced choices",
        {key_column("reference_g", "reference g"), key_column("condition", "condition"),
         key_column("participant", "participant"),
         column(threshold, Field::value, "threshold_75_g", "threshold g"),
         column(threshold, Field::low, "low_g", "low"),
         column(threshold, Field::high, "high_g", "high"),
         column(pse, Field::value, "pse_g", "PSE g"),
         column(threshold, Field::n_trials, "n_trials", "trials"),
         column(threshold, Field::why, "why", "no threshold: why")},
        "",
        TablePlace::csv};
    people.participants = true;
    add_weber_fraction(people.columns, weber_fraction);
    checks_.add_own_columns(people.columns);
    return {
        thresholds,
        exponent_table("forced_choice_exponents",
                       "Forced choices: growth of thresholds with the reference", exponent),
        shares.table(), people,
        own_exponent_table("forced_choice_exponents_by_participant",
                           "Each participant's growth of thresholds in forced choices", exponent)};
  }

  std::vector<ChartSpec> charts() const override { return {shares.chart()}; }

 private:
  static void put_fit(Estimates& all, const Compared& compared, const std::string& participant,
                      const AnswersByLevel& answers) {
    const ForcedChoiceFit found = fit_forced_choice(answers);
    const auto put = [&](const Measure& measure, const FittedParameter& parameter) {
      StudyEstimate& own = all.emplace_back(own_estimate(measure, compared, participant, answers));
      own.method = "maximum likelihood";
      own.why = found.why;
      if (!own.why.empty()) return;
      own.value = parameter.value;
      own.low = parameter.low;
      own.high = parameter.high;
    };
    put(threshold, found.threshold);
    if (const auto fraction = weber_fraction_of(all.back(), weber_fraction))
      all.push_back(*fraction);
    if (found.pse) put(pse, *found.pse);
  }

  std::map<Compared, AnswersByPerson> people_;
  CurveChecks checks_{{deviance, fit_p, rejected}, check_forced_choice};
};
}  // namespace

std::shared_ptr<Section> forced_choice_section() {
  return std::make_shared<ForcedChoiceSection>();
}

}  // namespace heft
