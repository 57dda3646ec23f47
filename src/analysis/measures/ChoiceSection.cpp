// What was chosen in comparisons, whatever the staircases made of it: incorrect choices and false
// alarms, choices by difference, hits of each participant, response times by difference.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "analysis/Comparison.h"
#include "analysis/Section.h"

namespace heft {

namespace {
constexpr Measure trials{"comparisons", "", "trials", "completed comparisons"};
constexpr Measure difference{
    "choice", "%", "a cube was chosen",
    "share of comparisons, without catch trials, in which a cube was chosen"};
constexpr Measure wrong_cube{
    "incorrect_choice", "%", "incorrect choices",
    "share of choices between cubes that differ in which the lighter one was "
    "chosen"};
constexpr Measure false_alarm{"false_alarm", "%", "false alarms",
                              "share of catch trials in which a cube was chosen"};
constexpr Measure at_zero{"choice_at_zero", "%", "chosen at 0 g",
                          "share of a procedure's own trials at difference 0 in which a cube was "
                          "chosen"};
constexpr Measure right{
    "chosen_heavier", "%", "the heavier cube",
    "share of comparisons of about one difference in which the heavier cube was "
    "chosen"};
constexpr Measure wrong{"chosen_lighter", "%", "the lighter cube",
                        "share of them in which the lighter cube was chosen"};
constexpr Measure none{"chosen_none", "%", "no difference",
                       "share of them in which no difference was seen"};
constexpr Measure time_by_level{"response_time_by_level", "s", "response time",
                                "median response time of comparisons of about one difference, "
                                "quartiles as low and high"};
constexpr Measure hits{"hits", "%", "hits",
                       "a participant's share of comparisons with a difference in which a cube was "
                       "chosen"};
constexpr Measure alarms{"alarms", "%", "false alarms",
                         "the same of comparisons without a difference"};

StudyEstimate at_compared(StudyEstimate estimate, const Compared& compared) {
  estimate.task = "comparison";
  estimate.condition = compared.condition;
  estimate.reference_g = compared.reference_g;
  return estimate;
}

struct RateOf {
  const Measure* measure;
  Rate ComparisonChoices::*rate;
};
constexpr std::array rates{RateOf{&difference, &ComparisonChoices::difference},
                           RateOf{&wrong_cube, &ComparisonChoices::wrong_cube},
                           RateOf{&false_alarm, &ComparisonChoices::false_alarm},
                           RateOf{&at_zero, &ComparisonChoices::at_zero}};

// @param over "each" reference, each "level" or "all"
void put_choices(Estimates& all, const ComparisonChoices& choices, std::string over,
                 bool shown = true) {
  const auto put = [&](StudyEstimate estimate) {
    estimate = at_compared(std::move(estimate), choices.compared);
    if (over == "all") estimate.reference_g.reset();
    estimate.by = {{"over", over}, {"shown", shown && over != "level" ? "yes" : "no"}};
    if (choices.level_g) estimate.by.push_back(at("level_g", *choices.level_g));
    all.push_back(std::move(estimate));
  };
  StudyEstimate number{&trials};
  number.value = choices.n_trials;
  number.n_trials = choices.n_trials;
  put(number);
  for (const RateOf& one : rates) {
    const bool of_catches = one.measure == &false_alarm || one.measure == &at_zero;
    if (!choices.level_g || !of_catches) put(rate_estimate(*one.measure, choices.*one.rate));
  }
}

constexpr std::size_t most_lines = 60;  // more participants have no line of their own

double mean_level_g(const ComparedTrials& bin) {
  const double sum =
      std::accumulate(bin.begin(), bin.end(), 0.0,
                      [](double so_far, const auto* one) { return so_far + one->level_g; });
  return sum / static_cast<double>(bin.size());
}

// What was chosen in a bin. At 0 either choice is half right, half wrong, and not counted.
struct BinChoices {
  BinChoices(const ComparedTrials& bin, const ComparisonTrials& of)
      : level(at("mean_level_g", mean_level_g(bin))) {
    for (const ComparedTrial* trial : bin) {
      const std::string& participant = of.participant(*trial);
      const bool rightly = trial->correct.value_or(false);
      chose_none[participant].add(!trial->difference);
      if (trial->response_s) times_s.push_back(*trial->response_s);
      if (trial->level_g == 0) continue;
      chose_right[participant].add(trial->difference && rightly);
      chose_wrong[participant].add(trial->difference && !rightly);
    }
  }

  void put(Estimates& all, const Compared& compared, StudyEstimate estimate) const {
    estimate = at_compared(std::move(estimate), compared);
    estimate.by = {level};
    all.push_back(std::move(estimate));
  }

  Coordinate level;
  Tallies chose_right, chose_wrong, chose_none;
  std::deque<double> times_s;
};

void each_bin(const ComparisonTrials& of,
              const std::function<void(const Compared&, const BinChoices&)>& use) {
  for (const auto& [compared, theirs] : of.by_compared()) {
    ComparedTrials sorted;
    for (const ComparedTrial& trial : theirs) sorted.push_back(&trial);
    for (const ComparedTrials& bin : binned(std::move(sorted))) use(compared, BinChoices(bin, of));
  }
}

void put_bin(Estimates& all, const Compared& compared, const BinChoices& bin) {
  bin.put(all, compared, rate_estimate(right, rate_of(bin.chose_right)));
  bin.put(all, compared, rate_estimate(wrong, rate_of(bin.chose_wrong)));
  bin.put(all, compared, rate_estimate(none, rate_of(bin.chose_none)));
  if (!bin.times_s.empty()) bin.put(all, compared, quartiles_estimate(time_by_level, bin.times_s));
}

StudyEstimate own_share(const Measure& measure, const std::string& participant,
                        const Tally& tally) {
  StudyEstimate own{&measure};
  own.participant = participant;
  own.value = tally.percent();
  own.n = 1;
  own.n_trials = tally.n_trials;
  own.n_hits = tally.n_hits;
  return own;
}

void put_detection(Estimates& all, const ComparisonTrials& of) {
  std::map<std::pair<std::string, std::string>, std::pair<Tally, Tally>> people;
  for (const auto& [compared, theirs] : of.by_compared())
    for (const ComparedTrial& trial : theirs) {
      auto& [with, without] = people[{of.participant(trial), compared.condition}];
      (trial.level_g == 0 ? without : with).add(trial.difference);
    }
  for (const auto& [person, tallies] : people) {
    if (tallies.first.n_trials == 0 || tallies.second.n_trials == 0) continue;
    for (const auto& [measure, tally] :
         {std::pair(&hits, tallies.first), std::pair(&alarms, tallies.second)}) {
      all.push_back(own_share(*measure, person.first, tally));
      all.back().task = "comparison";
      all.back().condition = person.second;
    }
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

std::vector<EstimateColumn> only(std::string_view name, std::string text,
                                 std::vector<EstimateColumn> columns) {
  for (EstimateColumn& one : columns)
    if (one.measure) one.only = {name, text};
  return columns;
}

std::vector<EstimateColumn> choice_columns() {
  std::vector<EstimateColumn> columns{
      key_column("reference_g", "reference g"), key_column("condition", "condition"),
      column(trials, Field::value, "n_trials", "trials", 0),
      column(wrong_cube, Field::n_trials, "n_choices", "choices", 0, "wrong_cube.n_trials"),
      column(wrong_cube, Field::n_hits, "n_wrong_cube", "incorrect", 0, "wrong_cube.n_hits")};
  add_rate(columns, wrong_cube, "wrong_cube", "wrong_cube", true);
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
  for (const auto& [measure, name] : {std::pair(&wrong_cube, "wrong_cube"),
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
      column(wrong_cube, Field::n_trials, "n_choices", "choices between different cubes", 0,
             "wrong_cube.n_trials"),
      column(wrong_cube, Field::n_hits, "n_wrong_cube", "incorrect", 0, "wrong_cube.n_hits"),
      json_column(difference, Field::n_trials, "difference.n_trials")};
  add_rate(columns, difference, "difference", "", false);
  add_rate(columns, wrong_cube, "wrong_cube", "", false);
  return {"choices_by_level",
          "Choices in comparisons by difference, without catch trials",
          only("over", "level", std::move(columns)),
          "",
          TablePlace::csv,
          "comparison.by_level[]"};
}

EstimateTable curves_table() {
  EstimateTable table{
      "choice_curves",
      "Choices by difference",
      {key_column("reference_g", "reference g"), key_column("condition", "condition"),
       key_column("mean_level_g", "difference g"),
       column(none, Field::n_trials, "n_trials", "trials")},
      "",
      TablePlace::csv};
  for (const auto& [measure, name] :
       {std::pair(&right, "right"), {&wrong, "wrong"}, {&none, "none"}}) {
    table.columns.push_back(column(*measure, Field::value, std::string(name) + "_percent",
                                   std::string(measure->heading) + " %"));
    table.columns.push_back(
        column(*measure, Field::low, std::string(name) + "_low_percent", "low"));
    table.columns.push_back(
        column(*measure, Field::high, std::string(name) + "_high_percent", "high"));
  }
  return table;
}

EstimateTable times_table() {
  return {
      "times_by_level",
      "Response times by difference",
      {key_column("reference_g", "reference g"), key_column("condition", "condition"),
       key_column("mean_level_g", "difference g"), column(time_by_level, Field::n_trials, "n", "n"),
       column(time_by_level, Field::value, "median_s", "median", 2),
       column(time_by_level, Field::low, "lower_quartile_s", "25 %", 2),
       column(time_by_level, Field::high, "upper_quartile_s", "75 %", 2)},
      "",
      TablePlace::csv};
}

EstimateTable detection_table() {
  EstimateTable table{
      "hits_and_false_alarms",
      "Hits against false alarms of each participant",
      {key_column("participant", "participant"), key_column("condition", "condition"),
       column(hits, Field::value, "hits_percent", "hits %"),
       column(hits, Field::n_trials, "n_trials", "trials"),
       column(alarms, Field::value, "false_alarms_percent", "false alarms %"),
       column(alarms, Field::n_trials, "n_without", "trials")},
      "",
      TablePlace::csv};
  table.participants = true;
  return table;
}

// The model of a participant in the middle, without side bias.
std::string model_curves(const Summary& summary, const StudyEstimate& of) {
  const auto row =
      std::ranges::find(summary.sensitivity, Compared{of.reference_g.value_or(0), of.condition},
                        &ReferenceSensitivity::compared);
  if (row == summary.sensitivity.end() || !row->pooled.identifiable() || !row->pooled.indecision)
    return "";
  const double s = *row->pooled.sensitivity, t = *row->pooled.indecision;
  const auto share = [](const std::string& z) {
    return fmt::format("100*({0}/3 + (1-{0})*norm({1}))", fixed_lapse, z);
  };
  const std::string heavier = share(fmt::format("{}*x-{}", s, t));
  const std::string lighter = share(fmt::format("-{}*x-{}", s, t));
  return fmt::format(
      "{0} with lines dashtype 1 linecolor '#2f6fb0' notitle, {1} with lines dashtype 2 linecolor "
      "'#8a8f98' notitle, 100-({0})-({1}) with lines dashtype 4 linecolor '#3c8d5a'",
      heavier, lighter);
}

class ChoiceSection final : public Section {
 public:
  void put(Summary& summary) override {
    const ComparisonTrials& of = summary.shared->comparisons;
    const ComparisonSummary comparison = comparisons_of(of);
    ComparisonChoices all{
        {0, "all"}, {}, 0, {}, comparison.wrong_cube, comparison.false_alarm, comparison.at_zero};
    for (const ComparisonChoices& choices : comparison.by_reference) {
      put_choices(summary.estimates, choices, "each");
      all.n_trials += choices.n_trials;
    }
    put_choices(summary.estimates, all, "all", comparison.by_reference.size() > 1);
    for (const ComparisonChoices& choices : comparison.by_level)
      put_choices(summary.estimates, choices, "level");
    each_bin(of, [&](const Compared& compared, const BinChoices& bin) {
      put_bin(summary.estimates, compared, bin);
    });
  }

  Estimates of_participants(const Summary& summary) const override {
    Estimates all;
    const ComparisonTrials& of = summary.shared->comparisons;
    if (of.participants().size() <= most_lines)
      each_bin(of, [&](const Compared& compared, const BinChoices& bin) {
        for (const auto& [participant, tally] : bin.chose_right)
          bin.put(all, compared, own_share(right, participant, tally));
      });
    put_detection(all, of);
    return all;
  }

  std::vector<EstimateTable> tables() const override {
    return {choices_table(), references_json(), all_choices_json(), level_table(),
            curves_table(),  times_table(),     detection_table()};
  }

  std::vector<ChartSpec> charts() const override {
    ChartSpec curves{
        "choice_curves", "Choices by difference",
        "Percentage of trials in which the heavier cube, the lighter cube or neither "
        "was chosen; trials of all participants in bins of about as many, those without "
        "a difference apart, with 95 % intervals over participants. Thin lines: how "
        "often each participant chose the heavier cube in those bins (not drawn of more "
        "than 60). Curves: indecision model of the median participant, where the data "
        "identify one.",
        "choice_curves.csv"};
    curves.importance = 25;
    curves.series = {{&right, "", {}}, {&wrong, "", {}}, {&none, "", {}}};
    curves.x = "mean_level_g";
    curves.panels = {"reference_g", "condition"};
    curves.participants = true;
    curves.x_label = "difference (g)";
    curves.y_label = "% of trials";
    curves.axes = "set yrange [0:100]\nset samples 200\n";
    curves.curve = model_curves;
    ChartSpec detection{"hits_and_false_alarms", "Hits against false alarms",
                        "Each participant's percentage of \"different\" in comparisons with a "
                        "difference, against those without. On the line a participant says "
                        "\"different\" whatever is shown.",
                        "hits_and_false_alarms.csv", ChartShape::scatter};
    detection.importance = 70;
    detection.series = {{&alarms, "", {}}, {&hits, "", {}}};
    detection.split = {"condition"};
    detection.diagonal = true;
    detection.x_label = "% \"different\" without a difference";
    detection.y_label = "% \"different\" with one";
    detection.axes = "set xrange [-3:103]\nset yrange [-3:103]\n";
    ChartSpec times{
        "times_by_level", "Response time by difference",
        "From all cubes shown to the answer, without pauses and time out of view: median "
        "and quartiles of comparisons, by reference and condition.",
        "times_by_level.csv", ChartShape::lines};
    times.importance = 80;
    times.series = {{&time_by_level, "", {}}};
    times.x = "mean_level_g";
    times.split = {"reference_g", "condition"};
    times.x_label = "difference (g)";
    times.y_label = "response time (s)";
    times.axes = "set yrange [0:*]\n";
    return {curves, detection, times};
  }
};
}  // namespace

std::shared_ptr<Section> choice_section() {
  return std::make_shared<ChoiceSection>();
}

}  // namespace heft
