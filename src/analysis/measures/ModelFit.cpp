// Whether the indecision model predicts the observed figures, along the staircases that people ran.
#include <fmt/format.h>

#include <cmath>

#include "analysis/display/Phrases.h"
#include "analysis/measures/Sensitivity.h"

namespace heft {

namespace {
constexpr Measure predictive_p{
    "predictive_p", "", "p",
    "share of studies predicted by the indecision model in which a figure, at any reference and in "
    "any condition, is as far from its mean, in SDs, as the farthest one that was seen here"};
constexpr Measure seen{"seen_figure", "", "seen", "a figure of the study"};
constexpr Measure predicted{
    "predicted_figure", "", "predicted",
    "the same figure in studies predicted by the indecision model: mean and middle 95 %"};
constexpr Measure heavier{
    "predicted_heavier", "%", "the heavier cube",
    "share of comparisons in a bin of differences in which the heavier cube is chosen by the "
    "indecision model"};
constexpr Measure lighter{
    "predicted_lighter", "%", "the lighter cube",
    "share of comparisons in a bin of differences in which the lighter cube is chosen by the "
    "indecision model"};
constexpr Measure none{"predicted_none", "%", "no difference",
                       "share of comparisons in a bin of differences answered \"no difference\" by "
                       "the indecision model"};

using Bins = std::vector<ComparedTrials>;

// Halfway from one bin to the next.
std::vector<double> edges_between(const Bins& bins) {
  std::vector<double> edges_g;
  for (std::size_t i = 1; i < bins.size(); ++i)
    edges_g.push_back((bins[i - 1].back()->level_g + bins[i].front()->level_g) / 2);
  return edges_g;
}

StudyEstimate estimate_at(const Measure& measure, const ReferenceSensitivity& row) {
  StudyEstimate estimate{&measure, "comparison", row.compared.condition};
  estimate.reference_g = row.compared.reference_g;
  estimate.n = row.fit.n;
  estimate.n_trials = static_cast<int>(row.fit.n_trials);
  estimate.method = "studies simulated with the fitted mixed indecision model";
  return estimate;
}

void put_bands(Estimates& all, const ReferenceSensitivity& row, const Bins& bins,
               const PredictiveCheck& check) {
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const PredictedShares& shares = check.by_level[i];
    for (const auto& [measure, band] :
         {std::pair(&heavier, shares.heavier), {&lighter, shares.lighter}, {&none, shares.none}}) {
      const bool is_half_right = measure != &none && bins[i].front()->level_g == 0;
      if (!band || is_half_right) continue;
      StudyEstimate& one = all.emplace_back(estimate_at(*measure, row));
      one.by = {at("mean_level_g", mean_level_g(bins[i]))};
      one.value = 100 * band->mean;
      one.set(Interval{100 * band->low, 100 * band->high});
    }
  }
}

void put_figures(Estimates& all, const ReferenceSensitivity& row, const PredictiveCheck& check,
                 double joint_p) {
  for (const PredictedFigure& figure : check.figures) {
    StudyEstimate& is = all.emplace_back(estimate_at(seen, row));
    is.by = {{"figure", figure.name}};
    is.value = figure.seen;
    StudyEstimate& model = all.emplace_back(estimate_at(predicted, row));
    model.by = {{"figure", figure.name}};
    model.value = figure.mean;
    model.set(Interval{figure.low, figure.high});
  }
  StudyEstimate& p = all.emplace_back(estimate_at(predictive_p, row));
  p.by = {{"figure", check.farthest().name}};
  p.value = joint_p;
  p.n_trials = static_cast<int>(check.farthest_of_studies.size());
}

// "mean level of reversals (g) at 200 g in C2 is 80.1, predicted 91 to 120"
std::string miss_in_words(const Estimates& all, const StudyEstimate& check) {
  const std::string reference = check.text_at("reference_g");
  const auto at_figure = [&](const Measure& measure) {
    return find_estimate(all, measure.name,
                         {{"reference_g", reference},
                          {"condition", check.condition},
                          {"figure", check.at("figure")->text}});
  };
  const StudyEstimate& model = *at_figure(predicted);
  return fmt::format("{} at {} g in {} is {}, predicted {} to {}", check.at("figure")->text,
                     reference, check.condition, in_digits(*at_figure(seen)->value),
                     in_digits(*model.low), in_digits(*model.high));
}
}  // namespace

void put_model_fit(Estimates& all, std::span<const ReferenceSensitivity> rows,
                   const ComparisonTrials& trials, StaircaseRuns& runs) {
  std::vector<const ReferenceSensitivity*> checked;
  std::vector<PredictiveCheck> checks;
  for (const ReferenceSensitivity& row : rows) {
    const std::vector<PersonRuns> people = runs.take(row.compared);
    if (!row.is_of_people() || people.empty()) continue;
    const Bins bins = binned(pointers_to(trials.by_compared().at(row.compared)));
    PredictiveCheck check =
        check_predictions(row.fit, people, edges_between(bins), 1 + checks.size());
    if (check.figures.empty()) continue;
    put_bands(all, row, bins, check);
    checked.push_back(&row);
    checks.push_back(std::move(check));
  }
  const std::vector<double> ps = joint_p(checks);
  for (std::size_t i = 0; i < checks.size(); ++i) put_figures(all, *checked[i], checks[i], ps[i]);
}

EstimateTable model_fit_table() {
  return {
      "model_fit",
      "Does the indecision model predict what was seen?",
      {key_column("reference_g", "reference g"), key_column("condition", "condition"),
       column(predictive_p, Field::value, "p", "p", 3),
       column(predictive_p, Field::n_trials, "n_studies", "studies"),
       key_column("figure", "farthest from what is predicted"),
       column(seen, Field::value, "seen", "seen", 2),
       column(predicted, Field::low, "predicted_low", "predicted from", 2),
       column(predicted, Field::high, "predicted_high", "to", 2)},
      "people drawn from the fitted model run each participant's staircases from the first trial "
      "on, in 500 studies (100 to 500 with more than 200 people, 100 of Bayesian procedures). p: "
      "the share of these studies in which a figure of any row is as far from its mean, in SDs, as "
      "the farthest one here. Below .05, the model does not hold. All figures: predictive_checks.",
      TablePlace::results,
      "model_fit[]"};
}

EstimateTable predictive_checks_table() {
  return {"predictive_checks",
          "Figures of the study beside those that the indecision model predicts",
          {key_column("reference_g", "reference g"), key_column("condition", "condition"),
           key_column("figure", "figure"), column(seen, Field::value, "seen", "seen", 3),
           column(predicted, Field::value, "predicted", "predicted", 3),
           column(predicted, Field::low, "low", "95 % from", 3),
           column(predicted, Field::high, "high", "to", 3)},
          "",
          TablePlace::csv};
}

std::optional<ModelVerdict> model_verdict(const Estimates& all) {
  const auto checks = estimates_of(all, predictive_p.name);
  if (checks.empty()) return std::nullopt;
  ModelVerdict verdict{{}, 1, checks.front()->n_trials};
  for (const StudyEstimate* check : checks) {
    verdict.least_p = std::min(verdict.least_p, *check->value);
    verdict.n_studies = std::min(verdict.n_studies, check->n_trials);
    if (*check->value < 0.05) verdict.missed.push_back(check);
  }
  return verdict;
}

std::string model_fit_sentence(const Estimates& all) {
  const std::optional<ModelVerdict> verdict = model_verdict(all);
  if (!verdict) return "";
  if (verdict->missed.empty())
    return fmt::format("Predictive check of the indecision model: passed (smallest p = {:.2f}).",
                       verdict->least_p);
  std::vector<std::string> missed;
  for (const StudyEstimate* check : verdict->missed) missed.push_back(miss_in_words(all, *check));
  return fmt::format(
      "Doubt these thresholds: the indecision model does not predict what was seen "
      "(p = {:.3f}): {}.",
      verdict->least_p, some_of(missed, 2));
}

}  // namespace heft
