// Comparisons answered by "same" or "different": how often the answer was "different" at each
// difference, and each participant's threshold apart from the criterion.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <tuple>

#include "analysis/measures/Section.h"
#include "analysis/measures/Sensitivity.h"
#include "analysis/measures/ShareByLevel.h"
#include "analysis/report/Notes.h"
#include "inference/Fit.h"

namespace heft {

namespace {
constexpr Measure threshold{
    "same_different_threshold_75", "g", "75 % threshold",
    "difference in mass that would make 75 % of forced choices correct: 0.6745 by the sensitivity "
    "of the differencing model, fitted to each participant's same-different answers by maximum "
    "likelihood with 2 % lapses; the criterion has no influence on it; mean over participants, "
    "Student's t interval; of one alone the fit's interval"};
constexpr Measure weber_fraction{
    "same_different_weber_fraction", "", "Weber fraction",
    "75 % threshold of same-different comparisons by the mass of the reference: mean over "
    "participants, Student's t interval; of one alone the fit's interval"};
constexpr Measure exponent{
    "same_different_threshold_exponent", "", "exponent",
    "slope of the logarithm of a participant's 75 % threshold of same-different comparisons on the "
    "logarithm of the reference: mean over participants, Student's t interval; 0 if thresholds are "
    "equal, 1 if Weber fractions are"};
constexpr Measure criterion{
    "same_different_criterion", "", "criterion",
    "half-width of what is answered by \"same\", in standard deviations of the perceived "
    "difference, from the same fit"};
constexpr Measure deviance{
    "same_different_deviance", "", "deviance",
    "of the fit from the saturated model, with one free share for each difference, where "
    "differences were constant stimuli"};
constexpr Measure fit_p{
    "same_different_fit_p", "", "p of the fit",
    "share of 1000 simulated data sets of the same design, from the fitted curve and fitted again, "
    "whose deviance is as large; small: the curve does not describe the answers"};
constexpr Measure rejected{"same_different_fits_rejected", "", "fits rejected",
                           "number of participants whose fit has p < .05, of those whose fit can "
                           "be judged; about 5 % are expected if all curves are right"};
constexpr Measure different{"same_different_different", "%", "\"different\"",
                            "share of same-different trials at a difference that were answered by "
                            "\"different\", over participants; at 0 g: false alarms"};
const ShareByLevel shares{
    .share = different,
    .name = "same_different",
    .title = "Answers \"different\" by difference",
    .caption =
        "Percentage of trials that were answered by \"different\", by the difference in "
        "mass; 95 % intervals over participants.",
    .hits = "different",
    .note = "differences of either sign together; at 0 g: false alarms"};

class SameDifferentSection final : public Section {
 public:
  void add(const SessionData& data) override {
    for (const Attempt& attempt : data.attempts) {
      if (!attempt.is_usable_comparison(ComparisonAnswers::same_different)) continue;
      const TrialPlan& plan = attempt.trial.plan;
      const double level_g = std::abs(*plan.level_g);
      const bool is_different = attempt.trial.outcome == "difference";
      people_[{*plan.reference_g, plan.condition}][data.participant()][level_g]
             [is_different ? 1 : 0] += 1;
      checks_.add(data, plan);
    }
  }

  Estimates of_participants(const Summary&) const override {
    Estimates all;
    for (const auto& [compared, people] : people_)
      for (const auto& [participant, answers] : people) {
        put_own(all, compared, participant, answers);
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
    return threshold_findings(summary, "Same-different", threshold.name);
  }

  std::vector<EstimateTable> tables() const override {
    EstimateTable thresholds{
        "same_different",
        "Same-different comparisons: 75 % thresholds apart from the criterion",
        {key_column("reference_g", "reference g"), key_column("condition", "condition"),
         column(threshold, Field::n, "n_participants", "n"),
         column(threshold, Field::n_trials, "n_trials", "trials"),
         column(threshold, Field::value, "threshold_75_g", "threshold g")},
        "differencing model fitted to each participant, with 2 % lapses; mean over participants "
        "with Student's t interval, of one alone the fit's. Fits judged: those of constant "
        "stimuli; rejected: p < .05 of the deviance",
        TablePlace::results,
        "same_different[]"};
    add_interval(thresholds.columns, threshold, "low_g", "high_g", 1);
    add_weber_fraction(thresholds.columns, weber_fraction);
    thresholds.columns.push_back(column(criterion, Field::value, "criterion", "criterion SD", 2));
    add_interval(thresholds.columns, criterion, "criterion_low", "criterion_high", 2);
    thresholds.columns.push_back(column(threshold, Field::why, "why", "no threshold: why"));
    checks_.add_columns(thresholds.columns);
    EstimateTable people{
        "same_different_by_participant",
        "Each participant's 75 % threshold in same-different comparisons",
        {key_column("reference_g", "reference g"), key_column("condition", "condition"),
         key_column("participant", "participant"),
         column(threshold, Field::value, "threshold_75_g", "threshold g"),
         column(threshold, Field::low, "low_g", "low"),
         column(threshold, Field::high, "high_g", "high"),
         column(criterion, Field::value, "criterion", "criterion SD", 2),
         column(threshold, Field::n_trials, "n_trials", "trials"),
         column(threshold, Field::why, "why", "no threshold: why")},
        "",
        TablePlace::csv};
    people.participants = true;
    add_weber_fraction(people.columns, weber_fraction);
    checks_.add_own_columns(people.columns);
    return {thresholds,
            exponent_table("same_different_exponents",
                           "Same-different comparisons: growth of thresholds with the reference",
                           exponent),
            shares.table(), people,
            own_exponent_table("same_different_exponents_by_participant",
                               "Each participant's growth of thresholds in same-different "
                               "comparisons",
                               exponent)};
  }

  std::vector<ChartSpec> charts() const override { return {shares.chart()}; }

 private:
  static void put_own(Estimates& all, const Compared& compared, const std::string& participant,
                      const AnswersByLevel& answers) {
    const Fit fit = fit_same_different(answers, fixed_lapse);
    for (const auto& [measure, name] :
         {std::pair(&threshold, "threshold_75_g"), {&criterion, "indecision"}}) {
      StudyEstimate& own = all.emplace_back(own_estimate(*measure, compared, participant, answers));
      own.method = "profile likelihood";
      own.why = fit.why;
      if (fit.identifiable()) {
        const FittedParameter& fitted = fit.parameter(name);
        own.value = fitted.value;
        own.low = fitted.low;
        own.high = fitted.high;
      }
      if (measure != &threshold) continue;
      if (const auto fraction = weber_fraction_of(own, weber_fraction)) all.push_back(*fraction);
    }
  }

  std::map<Compared, AnswersByPerson> people_;
  CurveChecks checks_{{deviance, fit_p, rejected}, check_same_different};
};
}  // namespace

std::shared_ptr<Section> same_different_section() {
  return std::make_shared<SameDifferentSection>();
}

}  // namespace heft
