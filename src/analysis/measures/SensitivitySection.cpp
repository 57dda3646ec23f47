// How well masses are discriminated, whatever the criterion: 75 % thresholds by reference and
// condition, and of each participant beside their JND and its start.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "analysis/display/Phrases.h"
#include "analysis/measures/Section.h"
#include "analysis/measures/Sensitivity.h"
#include "psychophysics/ProcedureKinds.h"

namespace heft {

namespace {
constexpr Measure threshold{"threshold_75", "g", "threshold",
                            "75 %-correct discrimination threshold of the median participant in a "
                            "forced choice, free of the criterion (indecision model)"};
constexpr Measure weber_fraction{
    "weber_fraction", "", "Weber fraction",
    "75 %-correct discrimination threshold by the mass of the reference"};
constexpr Measure sensitivity{
    "sensitivity", "1/g", "sensitivity",
    "sensitivity of the median participant: d' per gram (indecision model)"};
constexpr Measure indecision{"indecision", "SD", "criterion half-width",
                             "half the width between the median participant's criteria, in SDs of "
                             "the internal noise"};
constexpr Measure lapse{"lapse_rate", "", "lapse rate",
                        "share of trials answered at random, shared by all participants"};
constexpr Measure sensitivity_sd{"sd_log_sensitivity", "", "spread",
                                 "SD between participants of the logarithm of the sensitivity"};
constexpr Measure threshold_at_lapse{
    "threshold_at_lapse", "g", "threshold",
    "75 %-correct discrimination threshold if the lapse rate were this, where it is not "
    "identifiable"};
constexpr Measure jnd_by_start{
    "jnd_by_start", "g", "JND",
    "a participant's JND by whether the staircases started above or below"};
constexpr Measure start{"staircase_start", "g", "start",
                        "mean first level of a participant's staircases from above or from below"};
constexpr Measure participant_jnd{"participant_jnd", "g", "JND",
                                  "a participant's JND, all staircases of a reference together"};
constexpr Measure posterior{"posterior_threshold", "g", "posterior",
                            "a participant's threshold by a Bayesian procedure, mean of its "
                            "posterior; of several such staircases their mean, without interval"};

StudyEstimate estimate_at(const Measure& measure, const Compared& compared) {
  return {&measure, "comparison", compared.condition, compared.reference_g};
}

void put_fit(Estimates& all, const ReferenceSensitivity& row) {
  const MixedFit& fit = row.fit;
  const auto put = [&](const Measure& measure, const std::optional<MixedFigure>& figure) {
    StudyEstimate& estimate = all.emplace_back(estimate_at(measure, row.compared));
    estimate.n = fit.n;
    estimate.n_trials = static_cast<int>(fit.n_trials);
    estimate.method = fit.n > 1 ? "mixed indecision model, profile likelihood"
                                : "indecision model, profile likelihood";
    estimate.why = fit.why;
    estimate.as_published = row.as_published;
    if (!figure) return;
    estimate.value = figure->value;
    estimate.low = figure->low;
    estimate.high = figure->high;
  };
  put(threshold, fit.threshold_75_g);
  if (const auto fraction = weber_fraction_of(all.back(), weber_fraction)) all.push_back(*fraction);
  put(sensitivity, fit.sensitivity);
  put(indecision, fit.indecision);
  put(lapse, fit.lapse);
  if (fit.sd_log_sensitivity) put(sensitivity_sd, MixedFigure{*fit.sd_log_sensitivity});
  for (const auto& [rate, threshold_g] : fit.at_lapse) {
    put(threshold_at_lapse, MixedFigure{threshold_g});
    all.back().by = {at("lapse", rate)};
  }
}

using Key = std::pair<Compared, std::string>;

// Null: too few people.
const OwnSensitivity* own_of(const Key& key, const std::vector<ReferenceSensitivity>& all) {
  const auto reference = std::ranges::find(all, key.first, &ReferenceSensitivity::compared);
  return reference == all.end() ? nullptr : reference->fit.own(key.second);
}

using Results = std::vector<const StaircaseResult*>;

std::map<Key, Results> results_by_person(const std::deque<StaircaseResult>& all) {
  std::map<Key, Results> results;
  for (const StaircaseResult& result : all)
    results[{result.compared, result.participant}].push_back(&result);
  return results;
}

std::map<Key, ParticipantJnd> jnds_by_person(const StaircaseCollector& staircases) {
  std::map<Key, ParticipantJnd> jnds;
  for (const ReferenceJnd& jnd : staircases.jnds())
    for (const ParticipantJnd& one : jnd.overall.participants)
      jnds[{jnd.compared, one.participant}] = one;
  return jnds;
}

// @param of of the participant at the reference
void put_value(Estimates& all, StudyEstimate of, const Measure& measure, double value,
               Censored censored = Censored::none) {
  of.measure = &measure;
  of.value = value;
  of.censored = censored;
  all.push_back(std::move(of));
}

void put_started(Estimates& all, StudyEstimate of, const char* staircases, const Results& results) {
  if (results.empty()) return;
  std::vector<double> starts_g;
  std::vector<std::optional<CensoredValue>> jnds;
  for (const StaircaseResult* result : results) {
    starts_g.push_back(result->start_g);
    jnds.push_back(censored_value(*result));
  }
  of.by = {{"staircases", staircases}};
  put_value(all, of, start, *mean(starts_g));
  if (const auto jnd = mean_figure(jnds))
    put_value(all, of, jnd_by_start, jnd->value, jnd->censored);
}

// Mean start and JND of staircases that began high and low. With a single start, all are from
// above.
void put_starts(Estimates& all, const StudyEstimate& of, const Results& results) {
  const auto [low, high] = std::ranges::minmax(results, {}, &StaircaseResult::start_g);
  const double middle_g = (low->start_g + high->start_g) / 2;
  const bool is_one = low->start_g == high->start_g;
  Results above, below;
  for (const StaircaseResult* result : results)
    (is_one || result->start_g > middle_g ? above : below).push_back(result);
  put_started(all, of, "from above", above);
  put_started(all, of, "from below", below);
}

// The mean of the staircases' posterior estimates, and the interval of a single one.
StudyEstimate posterior_of(StudyEstimate own, const Results& results) {
  own.measure = &posterior;
  std::vector<std::optional<CensoredValue>> values;
  for (const StaircaseResult* result : results) values.push_back(censored_value(*result));
  const std::optional<CensoredValue> figure = mean_figure(values);
  if (!figure) {
    own.why = results.front()->why;
    return own;
  }
  own.value = figure->value;
  own.censored = figure->censored;
  if (results.size() > 1) return own;
  own.low = results.front()->low_g;
  own.high = results.front()->high_g;
  return own;
}

// By each kind of Bayesian procedure at the reference and in the condition.
void put_posteriors(Estimates& all, StudyEstimate of, Key key,
                    const std::map<Key, Results>& results) {
  ProcedureKinds::for_each([&](const auto& config) {
    key.first.method = config.kind;
    const auto found = results.find(key);
    if (found == results.end() || !ProcedureKinds::is_bayesian(config.kind)) return;
    of.by = {{"method", key.first.method}};
    all.push_back(posterior_of(of, found->second));
  });
}

EstimateTable sensitivity_table() {
  return {
      "sensitivity",
      "75 %-correct discrimination thresholds",
      {key_column("reference_g", "reference g"),
       key_column("condition", "condition"),
       column(threshold, Field::n, "n", "n"),
       column(threshold, Field::value, "threshold_75_g", "threshold g"),
       column(threshold, Field::low, "low_g", "95 % low"),
       column(threshold, Field::high, "high_g", "high"),
       column(weber_fraction, Field::value, "weber_fraction", "Weber fraction", 2),
       column(weber_fraction, Field::low, "weber_fraction_low"),
       column(weber_fraction, Field::high, "weber_fraction_high"),
       column(indecision, Field::value, "indecision", "criterion half-width", 2),
       column(indecision, Field::low, "indecision_low", "95 % low", 2),
       column(indecision, Field::high, "indecision_high", "high", 2),
       column(sensitivity, Field::value, "sensitivity_per_g", "", 5),
       json_column(sensitivity, Field::low, "sensitivity_low_per_g"),
       json_column(sensitivity, Field::high, "sensitivity_high_per_g"),
       column(lapse, Field::value, "lapse_rate", "lapse rate", 2),
       column(lapse, Field::low, "lapse_rate_low", "95 % low", 2),
       column(lapse, Field::high, "lapse_rate_high", "high", 2),
       column(sensitivity_sd, Field::value, "sd_log_sensitivity", "", 2),
       json_column(threshold, Field::n_trials, "n_trials"),
       json_column(threshold, Field::identifiable, "identifiable"),
       column(threshold, Field::why, "why", "no threshold: why")},
      "mixed indecision model (left, none, right): each participant has a sensitivity, a criterion "
      "half-width and a side bias; a lapse rate is shared. Threshold: of the median participant in "
      "a forced choice, free of the criterion. Weber fraction: threshold by reference, as is its "
      "interval. Criterion "
      "half-width: in SDs of the internal noise. "
      "Intervals: profile likelihood. Thresholds that are not identifiable are not printed.",
      TablePlace::results,
      "sensitivity[]"};
}

EstimateTable lapse_table() {
  return {"thresholds_at_lapse_rates",
          "Thresholds at lapse rates, where these are not identifiable",
          {key_column("reference_g", "reference g"), key_column("condition", "condition"),
           key_column("lapse", "lapse rate"),
           column(threshold_at_lapse, Field::value, "threshold_75_g", "threshold g")},
          "answers fit lapse rates up to .2; the threshold depends on the rate as shown",
          TablePlace::results};
}

EstimateTable threshold_table() {
  EstimateTable table{
      "thresholds_by_participant",
      "Each participant's own threshold",
      {key_column("reference_g", "reference g"), key_column("condition", "condition"),
       key_column("participant", "participant"),
       column(threshold, Field::n_trials, "n_trials", "trials"),
       column(threshold, Field::value, "threshold_75_g", "threshold g"),
       column(threshold, Field::low, "low_g", "95 % low"),
       column(threshold, Field::high, "high_g", "high"),
       column(participant_jnd, Field::value, "jnd_g", "", 1, "-"),
       column(participant_jnd, Field::censored, "censored", "", 1, "-")},
      "the 75 %-correct threshold by this person's trials, with the lapse rate and the spread of "
      "criteria of all; the paper's JND of the staircases that began high and low beside, each "
      "with its start; quest, quest_plus, psi: mean and 95 % interval of the posterior of a "
      "staircase "
      "of this kind",
      TablePlace::report,
      "thresholds[]"};
  add_weber_fraction(table.columns, weber_fraction);
  for (const auto& [side, name] : {std::pair("from above", "above"), {"from below", "below"}}) {
    EstimateColumn began = column(start, Field::value, fmt::format("start_{}_g", name),
                                  fmt::format("start {} g", name), 1, "-");
    EstimateColumn of =
        column(jnd_by_start, Field::value, fmt::format("jnd_{}_g", name), "its JND", 1, "-");
    began.only = of.only = {"staircases", side};
    table.columns.push_back(began);
    table.columns.push_back(of);
  }
  for (const auto& [field, name, heading] : {std::tuple(Field::value, "_g", " g"),
                                             {Field::low, "_low_g", " 95 % low"},
                                             {Field::high, "_high_g", " high"}}) {
    table.columns.push_back(column(posterior, field, name, heading));
    table.columns.back().spread = "method";
  }
  table.columns.push_back(
      column(threshold, Field::why_in_short, "why", "no threshold: why", 1, "-"));
  table.columns.push_back(json_column(threshold, Field::why, "why"));
  table.columns.push_back(json_column(threshold, Field::identifiable, "identifiable"));
  table.participants = true;
  return table;
}

class SensitivitySection final : public Section {
 public:
  void add(const SessionData& data) override { runs_.add(data); }
  void put(Summary& summary) override {
    const ComparisonTrials& trials = summary.shared->comparisons;
    sensitivity_ = sensitivities_of(trials);
    put_sensitivities(summary.estimates, sensitivity_);
    if (summary.checks_models) put_model_fit(summary.estimates, sensitivity_, trials, runs_);
    runs_ = {};
  }

  Estimates of_participants(const Summary& summary) const override {
    const ComparisonTrials& trials = summary.shared->comparisons;
    const StaircaseCollector& staircases = summary.shared->staircases;
    const auto jnds = jnds_by_person(staircases);
    const auto results = results_by_person(staircases.results());
    Estimates all;
    for (const auto& [compared, theirs] : trials.by_compared())
      for (const auto& [participant, answers] : answers_by_side(trials, compared)) {
        const Key key{compared, participant};
        StudyEstimate of = estimate_at(threshold, compared);
        of.participant = participant;
        of.n = 1;
        StudyEstimate& own = all.emplace_back(of);
        const auto [threshold_g, interval_g, why] =
            own_threshold(answers, own_of(key, sensitivity_));
        own.value = threshold_g;
        own.set(interval_g);
        own.n_trials = static_cast<int>(trials_in(answers));
        own.why = why;
        if (const auto fraction = weber_fraction_of(own, weber_fraction)) all.push_back(*fraction);
        if (const auto jnd = jnds.find(key); jnd != jnds.end())
          put_value(all, of, participant_jnd, jnd->second.jnd_g, jnd->second.censored);
        if (const auto found = results.find(key); found != results.end())
          put_starts(all, of, found->second);
        put_posteriors(all, of, key, results);
      }
    return all;
  }

  std::vector<std::string> findings(const Summary& summary) const override {
    std::map<std::string, std::vector<std::string>> by_condition;
    const auto thresholds = estimates_of(summary.estimates, threshold.name);
    for (const StudyEstimate* one : thresholds)
      if (one->value)
        by_condition[one->condition].push_back(fmt::format(
            "{} g{} at {:g} g", in_grams(*one->value), grams_between(*one), *one->reference_g));
    std::vector<std::string> found;
    for (const auto& [condition, values] : by_condition)
      found.push_back(fmt::format("75 %-correct discrimination threshold in {}: {}.", condition,
                                  some_of(values, 6)));
    if (!thresholds.empty() && found.empty())
      found.emplace_back(
          "75 %-correct discrimination threshold: not identifiable from these trials.");
    found.push_back(model_fit_sentence(summary.estimates));
    return found;
  }

  std::vector<EstimateTable> tables() const override {
    return {sensitivity_table(),        lapse_table(),     threshold_ratio_table(),
            threshold_exponent_table(), model_fit_table(), predictive_checks_table(),
            threshold_table()};
  }

  std::vector<ChartSpec> charts() const override {
    return {
        {.name = "thresholds",
         .title = "75 %-correct discrimination thresholds, 95 % intervals",
         .caption = "The median participant's threshold at each reference and in each "
                    "condition, where the data identify one; small points: participants whose "
                    "own trials do.",
         .csv = "sensitivity.csv",
         .importance = 28,
         .series = {{&threshold, "threshold"}},
         .x = "reference_g",
         .split = {"condition"},
         .participants = true,
         .x_label = "reference mass (g)",
         .y_label = "threshold (g)",
         .axes = "set yrange [0:*]\n"},
        {.name = "thresholds_by_participant",
         .title = "Each participant's threshold, the paper's JND and its start",
         .caption = "A column for each participant, ordered by threshold, a panel for each "
                    "reference and condition: the 75 %-correct threshold with its likelihood "
                    "interval, where their trials identify one; the paper's JND of their "
                    "staircases from above and from below apart (censored ones at what they lie "
                    "beyond); where these began.",
         .csv = "thresholds_by_participant.csv",
         .shape = ChartShape::people,
         .importance = 30,
         .series = {{&threshold, "threshold"},
                    {&jnd_by_start, "JND from above", {"staircases", "from above"}},
                    {&jnd_by_start, "JND from below", {"staircases", "from below"}},
                    {&start, "start"}},
         .panels = {"reference_g", "condition"},
         .x_label = "participant, ordered by threshold",
         .y_label = "difference (g)",
         .axes = "set logscale y\n"},
        {.name = "jnd_against_start",
         .title = "JND against the start of its staircase",
         .caption =
             "The paper's JND of each participant's staircases against the difference that "
             "they began with; on the line a JND is its start. \"> this\", \"< this\": known "
             "to lie above or below only.",
         .csv = "thresholds_by_participant.csv",
         .shape = ChartShape::scatter,
         .importance = 40,
         .series = {{&start}, {&jnd_by_start}},
         .split = {"reference_g", "condition"},
         .diagonal = true,
         .x_label = "start (g)",
         .y_label = "JND (g)",
         .axes = "set xrange [0:*]\nset yrange [0:*]\n"}};
  }

 private:
  StaircaseRuns runs_;
  std::vector<ReferenceSensitivity> sensitivity_;
};
}  // namespace

std::vector<ReferenceSensitivity> sensitivities_of(const ComparisonTrials& trials) {
  std::vector<ReferenceSensitivity> all;
  for (const auto& [compared, theirs] : trials.by_compared())
    all.push_back({compared, fit_mixed_indecision(answers_by_side(trials, compared)),
                   trials.as_published(compared)});
  return all;
}

void put_sensitivities(Estimates& all, std::span<const ReferenceSensitivity> rows) {
  for (const ReferenceSensitivity& row : rows) put_fit(all, row);
  put_threshold_contrasts(all, rows);
}

std::shared_ptr<Section> sensitivity_section() {
  return std::make_shared<SensitivitySection>();
}

}  // namespace heft
