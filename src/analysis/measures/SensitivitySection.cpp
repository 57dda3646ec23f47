// How well masses are discriminated, whatever the criterion: 75 % thresholds by reference and
// condition, and of each participant beside their JND and its start.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "analysis/dataset/Sensitivity.h"
#include "analysis/measures/Section.h"
#include "analysis/report/Notes.h"

namespace heft {

namespace {
constexpr Measure threshold{"threshold_75", "g", "threshold",
                            "75 %-correct discrimination threshold of the median participant in a "
                            "forced choice, free of the criterion (indecision model)"};
constexpr Measure sensitivity{
    "sensitivity", "1/g", "sensitivity",
    "sensitivity of the median participant: d' per gram (indecision model)"};
constexpr Measure indecision{"indecision", "SD", "criterion half-width",
                             "half the width between the median participant's criteria, in SDs of "
                             "the internal noise"};
constexpr Measure ratio{"threshold_ratio", "", "ratio of thresholds",
                        "threshold at a reference over the threshold at the next lighter one"};
constexpr Measure ratio_of_several{"threshold_ratio_of_several", "", "ratio of thresholds",
                                   "ratio of thresholds with a simultaneous interval over the "
                                   "condition's ratios (Bonferroni)"};
constexpr Measure jnd_by_start{
    "jnd_by_start", "g", "JND",
    "a participant's JND by whether the staircases started above or below"};
constexpr Measure start{"staircase_start", "g", "start",
                        "mean first level of a participant's staircases from above or from below"};
constexpr Measure participant_jnd{"participant_jnd", "g", "JND",
                                  "a participant's JND, all staircases of a reference together"};

StudyEstimate estimate_at(const Measure& measure, const Compared& compared) {
  return {&measure, "comparison", compared.condition, compared.reference_g};
}

void put_pooled(Estimates& all, const ReferenceSensitivity& row) {
  const PooledSensitivity& pooled = row.pooled;
  const auto put = [&](const Measure& measure, const std::optional<double>& value,
                       const std::optional<Interval>& interval) {
    StudyEstimate& estimate = all.emplace_back(estimate_at(measure, row.compared));
    estimate.value = value;
    estimate.set(interval);
    estimate.n = pooled.n;
    estimate.n_trials = static_cast<int>(pooled.n_trials);
    estimate.method = "indecision model, bootstrap over participants";
    estimate.why = pooled.why;
    estimate.as_published = row.as_published;
  };
  put(threshold, pooled.threshold_75_g, pooled.threshold_interval_g);
  put(sensitivity, pooled.sensitivity, pooled.sensitivity_interval);
  put(indecision, pooled.indecision, pooled.indecision_interval);
}

// What one ratio of several is to show has more chances to come about by chance (Bonferroni).
void put_ratios(Estimates& all, const std::vector<const ReferenceSensitivity*>& rows) {
  const double n_ratios = static_cast<double>(rows.size()) - 1;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const PooledSensitivity &lighter = rows[i - 1]->pooled, &heavier = rows[i]->pooled;
    if (!lighter.identifiable() || !heavier.identifiable()) continue;
    for (const auto& [measure, confidence] :
         {std::pair(&ratio, confidence_level),
          std::pair(&ratio_of_several, 1 - (1 - confidence_level) / n_ratios)}) {
      StudyEstimate& estimate = all.emplace_back(estimate_at(*measure, rows[i]->compared));
      estimate.by = {at("lighter_reference_g", rows[i - 1]->compared.reference_g)};
      estimate.value = *heavier.threshold_75_g / *lighter.threshold_75_g;
      estimate.set(threshold_ratio_interval(lighter, heavier, confidence));
      estimate.n = heavier.n;
      estimate.method = "bootstrap over participants";
      estimate.as_published = rows[i]->as_published;
    }
  }
}

using Key = std::pair<Compared, std::string>;

// Null: too few people to draw on.
const OwnSensitivity* own_of(const Key& key, const std::vector<ReferenceSensitivity>& all) {
  const auto reference = std::ranges::find(all, key.first, &ReferenceSensitivity::compared);
  if (reference == all.end()) return nullptr;
  const auto own = reference->pooled.people.find(key.second);
  return own == reference->pooled.people.end() ? nullptr : &own->second;
}

using Results = std::vector<const StaircaseResult*>;

std::map<Key, Results> results_by_person(const std::deque<StaircaseResult>& all) {
  std::map<Key, Results> results;
  for (const StaircaseResult& result : all)
    results[{result.compared, result.participant}].push_back(&result);
  return results;
}

std::map<Key, ParticipantJnd> jnds_by_person(const StaircaseFold& staircases) {
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

// Of the staircases that began high and low; of a single start all are from above.
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

EstimateTable sensitivity_table() {
  return {
      "sensitivity",
      "75 %-correct discrimination thresholds",
      {key_column("reference_g", "reference g"), key_column("condition", "condition"),
       column(threshold, Field::n, "n", "n"),
       column(threshold, Field::value, "threshold_75_g", "threshold g"),
       column(threshold, Field::low, "low_g", "95 % low"),
       column(threshold, Field::high, "high_g", "high"),
       column(indecision, Field::value, "indecision", "criterion half-width", 2),
       column(indecision, Field::low, "indecision_low"),
       column(indecision, Field::high, "indecision_high"),
       column(sensitivity, Field::value, "sensitivity_per_g", "", 5),
       json_column(sensitivity, Field::low, "sensitivity_low_per_g"),
       json_column(sensitivity, Field::high, "sensitivity_high_per_g"),
       json_column(threshold, Field::n_trials, "n_trials"),
       json_column(threshold, Field::identifiable, "identifiable"),
       column(threshold, Field::why, "why", "no threshold: why")},
      "indecision model (left, none, right; lapse rate .02) with criteria and side bias of each "
      "participant's own; the median participant's threshold of a forced choice, free of the "
      "criterion. Interval: bootstrap over participants. Criterion half-width: half the width "
      "between the median participant's criteria in SDs of the internal noise. Thresholds that are "
      "not "
      "identifiable are not printed.",
      TablePlace::results,
      "sensitivity[]"};
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
      "the 75 %-correct threshold by this person's trials alone; the paper's JND of "
      "the staircases that began high and low beside, each with its start",
      TablePlace::report,
      "thresholds[]"};
  for (const auto& [side, name] : {std::pair("from above", "above"), {"from below", "below"}}) {
    EstimateColumn began = column(start, Field::value, fmt::format("start_{}_g", name),
                                  fmt::format("start {} g", name), 1, "-");
    EstimateColumn of =
        column(jnd_by_start, Field::value, fmt::format("jnd_{}_g", name), "its JND", 1, "-");
    began.only = of.only = {"staircases", side};
    table.columns.push_back(began);
    table.columns.push_back(of);
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
  void put(Summary& summary) override {
    sensitivity_ = sensitivities_of(summary.shared->comparisons);
    put_sensitivities(summary.estimates, sensitivity_);
  }

  Estimates of_participants(const Summary& summary) const override {
    const ComparisonTrials& trials = summary.shared->comparisons;
    const StaircaseFold& staircases = summary.shared->staircases;
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
        if (const auto jnd = jnds.find(key); jnd != jnds.end())
          put_value(all, of, participant_jnd, jnd->second.jnd_g, jnd->second.censored);
        if (const auto found = results.find(key); found != results.end())
          put_starts(all, of, found->second);
      }
    return all;
  }

  std::vector<std::string> findings(const Summary& summary) const override {
    std::map<std::string, std::vector<std::string>> by_condition;
    const auto thresholds = estimates_of(summary.estimates, threshold.name);
    for (const StudyEstimate* one : thresholds)
      if (one->value)
        by_condition[one->condition].push_back(fmt::format("{:.0f} g [{:.0f}, {:.0f}] at {:g} g",
                                                           *one->value, *one->low, *one->high,
                                                           *one->reference_g));
    std::vector<std::string> found;
    for (const auto& [condition, values] : by_condition)
      found.push_back(fmt::format("75 %-correct discrimination threshold in {}: {}.", condition,
                                  some_of(values, 6)));
    if (!thresholds.empty() && found.empty())
      found.emplace_back(
          "75 %-correct discrimination threshold: not identifiable from these trials.");
    return found;
  }

  std::vector<EstimateTable> tables() const override {
    return {sensitivity_table(), threshold_table()};
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
  std::vector<ReferenceSensitivity> sensitivity_;
};
}  // namespace

std::vector<ReferenceSensitivity> sensitivities_of(const ComparisonTrials& trials) {
  const std::set<std::string> study(trials.participants().begin(), trials.participants().end());
  std::vector<ReferenceSensitivity> all;
  for (const auto& [compared, theirs] : trials.by_compared())
    all.push_back({compared, pooled_sensitivity(answers_by_side(trials, compared), study),
                   trials.as_published(compared)});
  return all;
}

void put_sensitivities(Estimates& all, std::span<const ReferenceSensitivity> rows) {
  std::map<std::pair<std::string, bool>, std::vector<const ReferenceSensitivity*>> conditions;
  for (const ReferenceSensitivity& row : rows) {
    put_pooled(all, row);
    conditions[{row.compared.condition, row.as_published}].push_back(&row);
  }
  for (const auto& [condition, of_condition] : conditions) put_ratios(all, of_condition);
}

std::shared_ptr<Section> sensitivity_section() {
  return std::make_shared<SensitivitySection>();
}

}  // namespace heft
