// Choices in comparisons: incorrect choices (the lighter cube) and false alarms (a choice between
// equal masses), by reference, condition and level.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/measures/Section.h"

namespace heft {

namespace {
constexpr Measure trials{"comparisons", "", "trials", "completed comparisons"};
constexpr Measure difference{
    "choice", "%", "a cube was chosen",
    "share of comparisons, without catch trials, in which a cube was chosen"};
constexpr Measure incorrect_choice{
    "incorrect_choice", "%", "incorrect choices",
    "share of choices between different masses in which the lighter cube was chosen"};
constexpr Measure false_alarm{"false_alarm", "%", "false alarms",
                              "share of catch trials in which a cube was chosen"};
constexpr Measure at_zero{"choice_at_zero", "%", "chosen at 0 g",
                          "share of a procedure's own trials at difference 0 in which a cube was "
                          "chosen"};
struct Counts {
  int n_trials = 0;
  Tallies difference, incorrect_choice, false_alarm, at_zero;

  void add(const std::string& participant, const ComparedTrial& trial) {
    const bool equal = trial.level_g == 0;
    n_trials += 1;
    if (trial.is_catch) false_alarm[participant].add(trial.difference);
    if (!trial.is_catch) difference[participant].add(trial.difference);
    if (!trial.is_catch && equal) at_zero[participant].add(trial.difference);
    if (trial.difference && !equal && trial.correct)
      incorrect_choice[participant].add(!*trial.correct);
  }
};

// @param at task, condition, reference and coordinates
void put_choices(Estimates& all, const StudyEstimate& at, const Counts& counts,
                 bool of_catches = true) {
  const auto put = [&](StudyEstimate estimate) {
    estimate.task = at.task;
    estimate.condition = at.condition;
    estimate.reference_g = at.reference_g;
    estimate.by = at.by;
    all.push_back(std::move(estimate));
  };
  StudyEstimate number{&trials};
  number.value = number.n_trials = counts.n_trials;
  put(std::move(number));
  put(rate_estimate(difference, rate_of(counts.difference)));
  put(rate_estimate(incorrect_choice, rate_of(counts.incorrect_choice)));
  if (!of_catches) return;
  put(rate_estimate(false_alarm, rate_of(counts.false_alarm)));
  put(rate_estimate(at_zero, rate_of(counts.at_zero)));
}

// One level at a time, so that only its counts are in memory.
void put_levels(Estimates& all, StudyEstimate place, ComparedTrials sorted,
                const ComparisonTrials& of) {
  std::ranges::stable_sort(sorted, {}, &ComparedTrial::level_g);
  for (auto first = sorted.begin(); first != sorted.end();) {
    const double level_g = (*first)->level_g;
    Counts counts;
    for (; first != sorted.end() && (*first)->level_g == level_g; ++first)
      if (!(*first)->is_catch) counts.add(of.participant(**first), **first);
    place.by = {{"over", "level"}, {"shown", "no"}, at("level_g", level_g)};
    if (counts.n_trials > 0) put_choices(all, place, counts, false);
  }
}

void add_rate(std::vector<EstimateColumn>& columns, const Measure& measure, const std::string& name,
              const std::string& csv, bool shown) {
  const auto add = [&](Field field, const std::string& suffix, const char* heading,
                       const char* key) {
    EstimateColumn added = column(measure, field, csv.empty() ? "" : csv + suffix,
                                  shown ? heading : "", 1, name + key);
    columns.push_back(std::move(added));
  };
  add(Field::value, "_percent", "%", ".percent");
  add(Field::low, "_low_percent", "low", ".low");
  add(Field::high, "_high_percent", "high", ".high");
}

std::vector<EstimateColumn> only(std::string_view name, const std::string& text,
                                 std::vector<EstimateColumn> columns) {
  for (EstimateColumn& one : columns)
    if (one.measure) one.only = {name, text};
  return columns;
}

std::vector<EstimateColumn> choice_columns() {
  std::vector<EstimateColumn> columns{key_column("reference_g", "reference g"),
                                      key_column("condition", "condition"),
                                      column(trials, Field::value, "n_trials", "trials", 0),
                                      column(incorrect_choice, Field::n_trials, "n_choices",
                                             "choices", 0, "incorrect_choice.n_trials"),
                                      column(incorrect_choice, Field::n_hits, "n_incorrect_choice",
                                             "incorrect", 0, "incorrect_choice.n_hits")};
  add_rate(columns, incorrect_choice, "incorrect_choice", "incorrect_choice", true);
  columns.push_back(
      column(false_alarm, Field::n_trials, "n_catch", "catch", 0, "false_alarm.n_trials"));
  columns.push_back(
      column(false_alarm, Field::n_hits, "n_false_alarm", "alarms", 0, "false_alarm.n_hits"));
  add_rate(columns, false_alarm, "false_alarm", "false_alarm", true);
  columns.push_back(
      column(at_zero, Field::n_trials, "n_level_zero", "at 0 g", 0, "at_zero.n_trials"));
  columns.push_back(
      column(at_zero, Field::n_hits, "n_chosen_level_zero", "chosen", 0, "at_zero.n_hits"));
  add_rate(columns, at_zero, "at_zero", "", false);
  columns.push_back(json_column(difference, Field::n_trials, "difference.n_trials"));
  columns.push_back(json_column(difference, Field::n_hits, "difference.n_hits"));
  add_rate(columns, difference, "difference", "", false);
  return columns;
}

EstimateTable choices_table() {
  return {
      "choices",
      "Choices in comparisons: incorrect choices and false alarms",
      only("shown", "yes", choice_columns()),
      "choices between cubes that differ, and incorrect ones; catch trials and false alarms; at "
      "0 g: a procedure's own trials whose difference was 0. 95 % intervals over participants, "
      "of whom one with more trials counts more. The paper gives no such figures.",
      TablePlace::results,
      ""};
}

EstimateTable references_json() {
  return {"choices_by_reference",
          "",
          only("over", "each", choice_columns()),
          "",
          TablePlace::json_only,
          "comparison.by_reference[]"};
}

EstimateTable all_choices_json() {
  std::vector<EstimateColumn> columns;
  for (const auto& [measure, name] : {std::pair(&incorrect_choice, "incorrect_choice"),
                                      {&false_alarm, "false_alarm"},
                                      {&at_zero, "at_zero"}}) {
    columns.push_back(json_column(*measure, Field::n_trials, std::string(name) + ".n_trials"));
    columns.push_back(json_column(*measure, Field::n_hits, std::string(name) + ".n_hits"));
    add_rate(columns, *measure, name, "", false);
  }
  return {"all_choices",         "",          only("over", "all", std::move(columns)), "",
          TablePlace::json_only, "comparison"};
}

EstimateTable level_table() {
  std::vector<EstimateColumn> columns{
      key_column("reference_g", "reference g"),
      key_column("condition", "condition"),
      key_column("level_g", "difference g"),
      column(trials, Field::value, "n_trials", "trials", 0),
      column(difference, Field::n_hits, "n_chosen", "chosen", 0, "difference.n_hits"),
      column(incorrect_choice, Field::n_trials, "n_choices", "choices between different cubes", 0,
             "incorrect_choice.n_trials"),
      column(incorrect_choice, Field::n_hits, "n_incorrect_choice", "incorrect", 0,
             "incorrect_choice.n_hits"),
      json_column(difference, Field::n_trials, "difference.n_trials")};
  add_rate(columns, difference, "difference", "", false);
  add_rate(columns, incorrect_choice, "incorrect_choice", "", false);
  return {"choices_by_level",
          "Choices in comparisons by difference, without catch trials",
          only("over", "level", std::move(columns)),
          "",
          TablePlace::csv,
          "comparison.by_level[]"};
}

class ChoiceSection final : public Section {
 public:
  void put(Summary& summary) override {
    const ComparisonTrials& of = summary.shared->comparisons;
    StudyEstimate place;
    place.task = "comparison";
    const auto put_at = [&](const Compared& compared) {
      place.condition = compared.condition;
      place.reference_g = compared.reference_g;
    };
    Counts all;
    for (const auto& [compared, theirs] : of.by_compared()) {
      Counts counts;
      for (const ComparedTrial& trial : theirs)
        for (Counts* sum : {&all, &counts}) sum->add(of.participant(trial), trial);
      put_at(compared);
      place.by = {{"over", "each"}, {"shown", "yes"}};
      put_choices(summary.estimates, place, counts);
    }
    place.condition = "all";
    place.reference_g.reset();
    place.by = {{"over", "all"}, {"shown", of.by_compared().size() > 1 ? "yes" : "no"}};
    put_choices(summary.estimates, place, all);
    for (const auto& [compared, theirs] : of.by_compared()) {
      put_at(compared);
      put_levels(summary.estimates, place, pointers_to(theirs), of);
    }
  }

  std::vector<std::string> findings(const Summary& summary) const override {
    std::vector<std::string> parts;
    const auto add = [&](const Measure& measure, std::string_view of) {
      const StudyEstimate* one = find_estimate(summary.estimates, measure.name, {{"over", "all"}});
      if (!one || one->n_trials == 0) return;
      parts.push_back(fmt::format("{} of {} {}", one->n_hits, one->n_trials, of));
      if (one->value && one->low)
        parts.back() +=
            fmt::format(", {:.0f} % [{:.0f}, {:.0f}]", *one->value, *one->low, *one->high);
    };
    add(incorrect_choice, "choices took the lighter cube");
    add(false_alarm, "catch trials were false alarms");
    if (parts.empty()) return {};
    return {fmt::format("Comparisons: {}.", fmt::join(parts, "; "))};
  }

  std::vector<EstimateTable> tables() const override {
    return {choices_table(), references_json(), all_choices_json(), level_table()};
  }
};
}  // namespace

std::shared_ptr<Section> choice_section() {
  return std::make_shared<ChoiceSection>();
}

}  // namespace heft
