// The comparisons with one of two answers: forced choice (answers = "heavier") and same-different.
#include <cmath>

#include "analysis/measures/TwoAnswerSection.h"

namespace heft {

namespace {
constexpr std::string_view deviance_meaning =
    "of the fit from the saturated model, with one free share for each difference, where "
    "differences were constant stimuli";
constexpr std::string_view fit_p_meaning =
    "share of 1000 simulated data sets of the same design, from the fitted curve and fitted again, "
    "whose deviance is as large; small: the curve does not describe the answers";
constexpr std::string_view rejected_meaning =
    "number of participants whose fit has p < .05, of those whose fit can be judged; about 5 % are "
    "expected if all curves are right";
const std::string thresholds_are =
    "; threshold and Weber fraction: geometric mean over participants with Student's t interval of "
    "the logarithms, of one alone the fit's interval. Fits judged: those of constant stimuli; "
    "rejected: p < .05 of the deviance";
}  // namespace

namespace forced_choice {
namespace {
constexpr Measure threshold{
    "forced_threshold_75", "g", "75 % threshold",
    "difference in mass that makes 75 % of forced choices correct, lapses apart: cumulative normal "
    "fitted to each participant by maximum likelihood, with 2 % of the answers wrong however large "
    "the difference; geometric mean over participants, Student's t interval of the logarithms; of "
    "one alone the fit's interval"};
constexpr Measure weber_fraction{
    "forced_weber_fraction", "", "Weber fraction",
    "75 % threshold of forced choices by the mass of the reference: geometric mean over "
    "participants, Student's t interval of the logarithms; of one alone the fit's interval"};
constexpr Measure exponent{
    "forced_threshold_exponent", "", "exponent",
    "slope of the logarithm of a participant's 75 % threshold of forced choices on the logarithm "
    "of the reference: mean over participants, Student's t interval; 0 if thresholds are equal, 1 "
    "if Weber fractions are"};
constexpr Measure pse{
    "forced_pse", "g", "point of subjective equality",
    "difference in mass at which the comparison is chosen in half of the forced choices, from the "
    "same fit; where no comparison was lighter than its reference it is not estimated"};
constexpr Measure deviance{"forced_deviance", "", "deviance", deviance_meaning};
constexpr Measure fit_p{"forced_fit_p", "", "p of the fit", fit_p_meaning};
constexpr Measure rejected{"forced_fits_rejected", "", "fits rejected", rejected_meaning};
constexpr Measure chosen{"forced_chosen", "%", "the comparison",
                         "share of forced choices at a difference in which the comparison was "
                         "chosen, over participants"};

std::optional<TwoWayAnswer> answer_of(const Attempt& attempt) {
  const auto& trial = attempt.trial;
  if (!attempt.is_usable_comparison(ComparisonAnswers::heavier) || !trial.chosen_slot) return {};
  const double level_g = *trial.plan.level_g == 0 ? 0 : *trial.plan.level_g;  // no -0
  return TwoWayAnswer{level_g, trial.chosen_slot != trial.plan.reference_slot};
}

TwoAnswerFit fit(const AnswersByLevel& answers) {
  const ForcedChoiceFit found = fit_forced_choice(answers);
  return {found.threshold, found.pse, found.why};
}

const TwoAnswerTask task{
    .answer_of = answer_of,
    .fit = fit,
    .check = check_forced_choice,
    .may_be_random = false,
    .method = "maximum likelihood",
    .threshold = threshold,
    .weber_fraction = weber_fraction,
    .exponent = exponent,
    .second = pse,
    .deviance = deviance,
    .fit_p = fit_p,
    .rejected = rejected,
    .share = chosen,
    .name = "forced_choice",
    .finding = "Forced choice",
    .thresholds_title = "Forced choices: 75 % threshold and point of subjective equality",
    .thresholds_note =
        "cumulative normal fitted to each participant, with 2 % of the answers wrong however large "
        "the "
        "difference" +
        thresholds_are,
    .people_title = "Each participant's 75 % threshold in forced choices",
    .n_column = "n",
    .second_column = column(pse, Field::value, "pse_g", "PSE g"),
    .second_interval = {"pse_low_g", "pse_high_g"},
    .exponents_title = "Forced choices: growth of thresholds with the reference",
    .own_exponents_title = "Each participant's growth of thresholds in forced choices",
    .share_title = "Forced choices of the comparison by difference",
    .share_caption =
        "Percentage of trials in which the comparison was chosen, by its mass minus "
        "the reference's; 95 % intervals over participants.",
    .share_note = "",
    .counted = "chosen"};
}  // namespace
}  // namespace forced_choice

namespace same_different {
namespace {
constexpr Measure threshold{
    "same_different_threshold_75", "g", "75 % threshold",
    "difference in mass that would make 75 % of forced choices correct: 0.6745 by the sensitivity "
    "of the differencing model, fitted to each participant's same-different answers by maximum "
    "likelihood with 2 % lapses; the criterion has no influence on it; geometric mean over "
    "participants, Student's t interval of the logarithms; of one alone the fit's interval"};
constexpr Measure weber_fraction{
    "same_different_weber_fraction", "", "Weber fraction",
    "75 % threshold of same-different comparisons by the mass of the reference: geometric mean "
    "over participants, Student's t interval of the logarithms; of one alone the fit's interval"};
constexpr Measure exponent{
    "same_different_threshold_exponent", "", "exponent",
    "slope of the logarithm of a participant's 75 % threshold of same-different comparisons on the "
    "logarithm of the reference: mean over participants, Student's t interval; 0 if thresholds are "
    "equal, 1 if Weber fractions are"};
constexpr Measure criterion{
    "same_different_criterion", "", "criterion",
    "half-width of what is answered by \"same\", in standard deviations of the perceived "
    "difference, from the same fit"};
constexpr Measure deviance{"same_different_deviance", "", "deviance", deviance_meaning};
constexpr Measure fit_p{"same_different_fit_p", "", "p of the fit", fit_p_meaning};
constexpr Measure rejected{"same_different_fits_rejected", "", "fits rejected", rejected_meaning};
constexpr Measure different{"same_different_different", "%", "\"different\"",
                            "share of same-different trials at a difference that were answered by "
                            "\"different\", over participants; at 0 g: false alarms"};

std::optional<TwoWayAnswer> answer_of(const Attempt& attempt) {
  if (!attempt.is_usable_comparison(ComparisonAnswers::same_different)) return {};
  return TwoWayAnswer{std::abs(*attempt.trial.plan.level_g), attempt.trial.outcome == "difference"};
}

TwoAnswerFit fit(const AnswersByLevel& answers) {
  const Fit found = fit_same_different(answers, fixed_lapse);
  return {found.parameter("threshold_75_g"), found.parameter("indecision"), found.why};
}

const TwoAnswerTask task{
    .answer_of = answer_of,
    .fit = fit,
    .check = check_same_different,
    .may_be_random = true,
    .method = "profile likelihood",
    .threshold = threshold,
    .weber_fraction = weber_fraction,
    .exponent = exponent,
    .second = criterion,
    .deviance = deviance,
    .fit_p = fit_p,
    .rejected = rejected,
    .share = different,
    .name = "same_different",
    .finding = "Same-different",
    .thresholds_title = "Same-different comparisons: 75 % thresholds apart from the criterion",
    .thresholds_note =
        "differencing model fitted to each participant, with 2 % lapses" + thresholds_are,
    .people_title = "Each participant's 75 % threshold in same-different comparisons",
    .n_column = "n_participants",
    .second_column = column(criterion, Field::value, "criterion", "criterion SD", 2),
    .second_interval = {"criterion_low", "criterion_high"},
    .exponents_title = "Same-different comparisons: growth of thresholds with the reference",
    .own_exponents_title = "Each participant's growth of thresholds in same-different comparisons",
    .share_title = "Answers \"different\" by difference",
    .share_caption =
        "Percentage of trials that were answered by \"different\", by the difference "
        "in mass; 95 % intervals over participants.",
    .share_note = "differences of either sign together; at 0 g: false alarms",
    .counted = "different"};
}  // namespace
}  // namespace same_different

std::shared_ptr<Section> forced_choice_section() {
  return std::make_shared<TwoAnswerSection>(forced_choice::task);
}

std::shared_ptr<Section> same_different_section() {
  return std::make_shared<TwoAnswerSection>(same_different::task);
}

}  // namespace heft
