// Sorting: what the answers were in each condition, of each participant, and which cube was taken
// for which.
#include <fmt/format.h>

#include "analysis/Section.h"
#include "tasks/Sorting.h"

namespace heft {

namespace {
constexpr Measure answers{
    "sorting_answers", "%", "answers",
    "share of the completed sorting trials with an answer (of all, or of those "
    "that were answered): mean over participants of each one's percentage"};
constexpr Measure chance{"sorting_chance", "%", "correct by chance",
                         "share of the same trials that a random order gets right, one of the n! "
                         "orders of n cubes"};
constexpr Measure n_incorrect{"sorting_n_incorrect", "", "incorrect",
                              "number of trials sorted incorrectly"};
constexpr Measure swapped{"sorting_swapped", "", "exchanged",
                          "number of incorrect trials of three cubes by what was exchanged"};
constexpr Measure labels{"sorting_labels", "", "labels",
                         "how often each cube got each label, in answered trials"};

std::vector<std::string> ranks(int n_cubes) {
  std::vector<std::string> names;
  for (const std::string_view label : Sorting::labels_for(n_cubes)) names.emplace_back(label);
  return names;
}

StudyEstimate share(const ConditionSorting& sorting, std::string of, std::string answer,
                    const Proportion& proportion, const published::Figure* figure) {
  StudyEstimate estimate{&answers, "sorting", sorting.condition};
  estimate.by = {{"trials", std::move(of)}, {"answer", std::move(answer)}};
  estimate.value = proportion.mean_percent;
  estimate.sd = proportion.sd_percent;
  estimate.set(proportion.interval_percent);
  estimate.n = proportion.n_participants;
  estimate.n_trials = proportion.trials.n_trials;
  estimate.n_hits = proportion.trials.n_hits;
  if (proportion.method != IntervalMethod::none) estimate.method = name_of(proportion.method);
  if (proportion.mean_percent) estimate.published = figure;
  return estimate;
}

void put_shares(Estimates& all, const ConditionSorting& sorting) {
  const published::Sorting* paper =
      sorting.published ? &published::sorting_in(*sorting.published) : nullptr;
  const auto of_paper = [&](const published::Figure& figure) { return paper ? &figure : nullptr; };
  const published::Sorting& figures = paper ? *paper : published::sorting_coupled;
  all.push_back(share(sorting, "all", "correct", sorting.correct, of_paper(figures.correct)));
  all.push_back(share(sorting, "all", "incorrect", sorting.incorrect, of_paper(figures.incorrect)));
  all.push_back(share(sorting, "all", "I don't know", sorting.none, of_paper(figures.none)));
  all.push_back(share(sorting, "answered", "correct", sorting.answered_correct,
                      figures.answered_correct ? of_paper(*figures.answered_correct) : nullptr));
  all.push_back(share(sorting, "answered", "incorrect", sorting.answered_incorrect, nullptr));
}

void put_chance(Estimates& all, const ConditionSorting& sorting) {
  StudyEstimate estimate{&chance, "sorting", sorting.condition};
  estimate.by = {{"trials", "all"}, {"answer", "correct"}};
  estimate.value = sorting.chance_percent();
  estimate.n = sorting.n_participants;
  estimate.n_trials = sorting.n_trials;
  all.push_back(std::move(estimate));
}

void put_swaps(Estimates& all, const ConditionSorting& sorting) {
  StudyEstimate estimate{&n_incorrect, "sorting", sorting.condition};
  estimate.value = sorting.incorrect.trials.n_hits;
  estimate.n = sorting.n_participants;
  all.push_back(estimate);
  estimate.measure = &swapped;
  for (std::size_t i = 0; i < sorting.swaps.size(); ++i) {
    estimate.by = {{"exchanged", std::string(EnumNames<Swap>::names.at(i))}};
    estimate.value = sorting.swaps.at(i);
    all.push_back(estimate);
  }
}

void put_labels(Estimates& all, const ConditionSorting& sorting) {
  for (const auto& [n_cubes, matrix] : sorting.labels) {
    const std::vector<std::string> names = ranks(n_cubes);
    for (std::size_t cube = 0; cube < names.size(); ++cube)
      for (std::size_t label = 0; label < names.size(); ++label) {
        StudyEstimate estimate{&labels, "sorting", sorting.condition};
        estimate.by = {{"n_cubes", fmt::format("{} cubes", n_cubes)},
                       {"cube", names[cube]},
                       {"label", names[label]}};
        estimate.value = matrix[cube][label];
        estimate.n = sorting.n_participants;
        all.push_back(std::move(estimate));
      }
  }
}

void put_participants(Estimates& all, const ConditionSorting& sorting) {
  for (const auto& [participant, tally] : sorting.correct_by_participant) {
    StudyEstimate estimate{&answers, "sorting", sorting.condition};
    estimate.participant = participant;
    estimate.by = {{"answer", "correct"}};
    estimate.value = tally.percent();
    estimate.n = 1;
    estimate.n_trials = tally.n_trials;
    estimate.n_hits = tally.n_hits;
    all.push_back(std::move(estimate));
  }
}

EstimateTable sorting_table() {
  EstimateTable table{
      "sorting",
      "Sorting: percentage of trials, mean over participants",
      {key_column("condition", "condition"), key_column("trials", "of trials"),
       key_column("answer", "answer"),
       column(answers, Field::value, "mean_percent", "mean %", 1, "mean"),
       column(answers, Field::sd, "sd_percent", "SD", 1, "sd"),
       column(answers, Field::low, "low_percent", "95 % low", 1, "low"),
       column(answers, Field::high, "high_percent", "high", 1, "high"),
       column(answers, Field::method, "interval", "interval"),
       column(answers, Field::n, "n_participants", "n"), column(answers, Field::n_hits, "n_hits"),
       column(answers, Field::n_trials, "n_trials", "trials"),
       column(answers, Field::pooled, "pooled_percent", "pooled %", 1, "pooled"),
       column(answers, Field::published, "published_percent", "published %", 1, "published"),
       column(answers, Field::published_sd, "published_sd_percent", "published SD", 1,
              "published_sd")},
      "n participants; SD between them (n-1). Interval over participants: a score interval with "
      "the "
      "trials that their differences leave effective, and Student's t; exact (Clopper-Pearson) "
      "over "
      "people where all have the same percentage, over the trials of one alone. The paper's 10.1 % "
      "of answered trials is a ratio of means, nearest to pooled; its figures stand beside its own "
      "techniques and masses only."};
  table.json = "sorting.{condition}.{trials}.{answer}";
  return table;
}

EstimateTable chance_table() {
  EstimateTable table{"sorting_chance",
                      "Sorting: correct by chance",
                      {key_column("condition", "condition"),
                       column(chance, Field::value, "chance_percent", "chance %", 1, "chance"),
                       column(chance, Field::n_trials, "n_trials", "trials"),
                       column(chance, Field::n, "n_participants", "n")}};
  table.place = TablePlace::report;
  table.json = "sorting.{condition}";
  return table;
}

EstimateTable swaps_table() {
  EstimateTable table{"swapped",
                      "Incorrect sortings of three cubes: which cubes were taken for each other",
                      {key_column("condition", "condition"),
                       column(n_incorrect, Field::value, "n_incorrect", "incorrect", 0, "-")},
                      "numbers of trials"};
  EstimateColumn each = column(swapped, Field::value, "", "", 0, "swapped.");
  each.spread = "exchanged";
  table.columns.push_back(each);
  table.json = "sorting.{condition}";
  return table;
}

EstimateTable label_table() {
  EstimateTable table{"labels_by_mass",
                      "Confusion matrix: which label which cube was given",
                      {key_column("condition", "condition"), key_column("n_cubes", "of"),
                       key_column("cube", "cube")},
                      "numbers of sorted trials, without \"I don't know\"; right answers on the "
                      "diagonal"};
  EstimateColumn each = column(labels, Field::value, "", "", 0);
  each.spread = "label";
  table.columns.push_back(each);
  return table;
}

EstimateTable participants_table() {
  EstimateTable table{"sorting_by_participant",
                      "Correct sortings of each participant",
                      {key_column("participant", "participant")}};
  EstimateColumn each = column(answers, Field::value, "_percent", " %");
  each.spread = "condition";
  table.columns.push_back(each);
  table.place = TablePlace::csv;
  table.participants = true;
  return table;
}

class SortingSection final : public Section {
 public:
  void add(const SessionData& data) override { fold_.add(data); }

  void put(Summary& summary) override {
    summary.sorting = fold_.result();
    for (const auto& put_all : {put_shares, put_chance, put_swaps, put_labels})
      for (const ConditionSorting& sorting : summary.sorting) put_all(summary.estimates, sorting);
    fold_ = {};
  }

  Estimates of_participants(const Summary& summary) const override {
    Estimates all;
    for (const ConditionSorting& sorting : summary.sorting) put_participants(all, sorting);
    return all;
  }

  std::vector<EstimateTable> tables() const override {
    return {sorting_table(), chance_table(), label_table(), swaps_table(), participants_table()};
  }

  std::vector<ChartSpec> charts() const override {
    ChartSpec shares{
        "sorting", "Sorting: answers per condition, 95 % intervals",
        "Percentage of completed trials, mean over participants with 95 % intervals "
        "over participants, side by side for each condition; diamonds: the paper's "
        "means. \"I don't know\" is an outcome of its own. Dashed: what a random order "
        "gets right.",
        "sorting.csv"};
    shares.importance = 10;
    shares.series = {{&answers, "", {"trials", "all"}}};
    shares.x = "answer";
    shares.split = {"condition"};
    shares.reference = &chance;
    shares.y_label = "% of trials, mean over participants";
    shares.axes = "set yrange [0:100]\n";
    ChartSpec people{"sorting_by_participant", "Correct sortings of each participant",
                     "Percentage of each participant's completed trials that were sorted "
                     "correctly; a line joins one's conditions. \"I don't know\" is not correct.",
                     "sorting_by_participant.csv", ChartShape::linked};
    people.importance = 45;
    people.series = {{&answers, "", {"answer", "correct"}}};
    people.x = "condition";
    people.reference = &chance;
    people.y_label = "% of trials sorted correctly";
    people.axes = "set yrange [-3:103]\n";
    ChartSpec matrix{
        "labels_by_mass", "Confusion matrix: which label which cube was given",
        "Sorted trials, all participants together, without \"I don't know\": how often "
        "each cube got each label, and in how many percent of its labels. Right ones on "
        "the diagonal.",
        "labels_by_mass.csv", ChartShape::matrix};
    matrix.importance = 50;
    matrix.series = {{&labels, "", {}}};
    matrix.x = "label";
    matrix.y = "cube";
    matrix.panels = {"condition", "n_cubes"};
    matrix.x_label = "label";
    matrix.y_label = "cube";
    return {shares, people, matrix};
  }

 private:
  SortingFold fold_;
};
}  // namespace

std::shared_ptr<Section> sorting_section() {
  return std::make_shared<SortingSection>();
}

}  // namespace heft
