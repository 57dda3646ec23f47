// Comparisons by difference: curves of choices and response times, and hits against false alarms of
// each participant.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "analysis/measures/Section.h"

namespace heft {

namespace {
constexpr Measure right{
    "chosen_heavier", "%", "the heavier cube",
    "share of comparisons in a bin of differences in which the heavier cube was chosen"};
constexpr Measure wrong{
    "chosen_lighter", "%", "the lighter cube",
    "share of comparisons in a bin of differences in which the lighter cube was chosen"};
constexpr Measure none{"chosen_none", "%", "no difference",
                       "share of comparisons in a bin of differences answered \"no difference\""};
constexpr Measure time_by_level{"response_time_by_level", "s", "response time",
                                "median response time of comparisons in a bin of differences, "
                                "quartiles as low and high"};
constexpr Measure hits{
    "hits", "%", "hits",
    "a participant's share of comparisons of different masses in which a cube was chosen"};
constexpr Measure alarms{
    "alarms", "%", "false alarms",
    "a participant's share of comparisons of equal masses in which a cube was chosen"};

StudyEstimate at_compared(StudyEstimate estimate, const Compared& compared) {
  estimate.task = "comparison";
  estimate.condition = compared.condition;
  estimate.reference_g = compared.reference_g;
  return estimate;
}

constexpr std::size_t most_lines = 60;  // more participants are not drawn one by one

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
  for (const auto& [compared, theirs] : of.by_compared())
    for (const ComparedTrials& bin : binned(pointers_to(theirs)))
      use(compared, BinChoices(bin, of));
}

void put_bin(Estimates& all, const Compared& compared, const BinChoices& bin) {
  bin.put(all, compared, rate_estimate(right, rate_of(bin.chose_right)));
  bin.put(all, compared, rate_estimate(wrong, rate_of(bin.chose_wrong)));
  bin.put(all, compared, rate_estimate(none, rate_of(bin.chose_none)));
  if (!bin.times_s.empty()) bin.put(all, compared, quartiles_estimate(time_by_level, bin.times_s));
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
       {std::pair(&right, "heavier"), {&wrong, "lighter"}, {&none, "none"}}) {
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

class CurveSection final : public Section {
 public:
  void put(Summary& summary) override {
    each_bin(summary.shared->comparisons, [&](const Compared& compared, const BinChoices& bin) {
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
    return {curves_table(), times_table(), detection_table()};
  }

  std::vector<ChartSpec> charts() const override {
    return {
        {.name = "choice_curves",
         .title = "Choices by difference",
         .caption =
             "Percentage of trials in which the heavier cube, the lighter cube or neither "
             "was chosen; trials of all participants in bins of about as many, those without "
             "a difference apart, with 95 % intervals over participants. Thin lines: how "
             "often each participant chose the heavier cube in those bins (not drawn of more "
             "than 60). Bands: what the mixed indecision model predicts of 95 % of such studies, "
             "along the staircases that the participants ran, where the data identify one.",
         .csv = "choice_curves.csv",
         .importance = 25,
         .series = {{&right, "", {}, "predicted_heavier"},
                    {&wrong, "", {}, "predicted_lighter"},
                    {&none, "", {}, "predicted_none"}},
         .x = "mean_level_g",
         .panels = {"reference_g", "condition"},
         .participants = true,
         .x_label = "difference (g)",
         .y_label = "% of trials",
         .axes = "set yrange [0:100]\n"},
        {.name = "hits_and_false_alarms",
         .title = "Hits against false alarms",
         .caption = "Each participant's percentage of \"different\" in comparisons with a "
                    "difference, against those without. On the line a participant says "
                    "\"different\" whatever is shown.",
         .csv = "hits_and_false_alarms.csv",
         .shape = ChartShape::scatter,
         .importance = 70,
         .series = {{&alarms}, {&hits}},
         .split = {"condition"},
         .diagonal = true,
         .x_label = "% \"different\" without a difference",
         .y_label = "% \"different\" with one",
         .axes = "set xrange [-3:103]\nset yrange [-3:103]\n"},
        {.name = "times_by_level",
         .title = "Response time by difference",
         .caption =
             "From all cubes shown to the answer, without pauses and time out of view: median "
             "and quartiles of comparisons, by reference and condition.",
         .csv = "times_by_level.csv",
         .shape = ChartShape::lines,
         .importance = 80,
         .series = {{&time_by_level}},
         .x = "mean_level_g",
         .split = {"reference_g", "condition"},
         .x_label = "difference (g)",
         .y_label = "response time (s)",
         .axes = "set yrange [0:*]\n"}};
  }
};
}  // namespace

std::shared_ptr<Section> curve_section() {
  return std::make_shared<CurveSection>();
}

}  // namespace heft
