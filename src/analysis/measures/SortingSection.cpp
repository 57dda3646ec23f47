// Sorting: answers by condition and by participant, and the confusion matrix.
#include <fmt/format.h>

#include <functional>
#include <set>

#include "analysis/dataset/Sorting.h"
#include "analysis/display/Phrases.h"
#include "analysis/measures/Section.h"
#include "tasks/Sorting.h"

namespace heft {

namespace {
constexpr Measure answers{
    "sorting_answers", "%", "answers",
    "share of completed (or of answered) sorting trials with this answer: mean over "
    "participants of each one's percentage"};
constexpr Measure chance{"sorting_chance", "%", "correct by chance",
                         "share of the same trials that a random order gets right, one of the n! "
                         "orders of n cubes"};
constexpr Measure chance_by_cubes{
    "sorting_chance_by_cubes", "%", "correct by chance",
    "share of trials with this number of cubes that a random order gets right"};
constexpr Measure equivalence{"sorting_equivalence", "%", "correct, of answered",
                              "share of answered trials sorted correctly, with its 90 % interval, "
                              "for the test of equivalence to chance"};
constexpr Measure n_incorrect{"sorting_n_incorrect", "", "incorrect",
                              "number of trials of three cubes sorted incorrectly"};
constexpr Measure swapped{
    "sorting_swapped", "", "exchanged",
    "number of incorrect trials of three cubes by the pair that was exchanged"};
constexpr Measure labels{"sorting_confusion_count", "", "labels",
                         "confusion matrix: number of answered trials in which a cube got a label"};

// Completed trials of one condition. A participant's sessions count together.
struct Counted {
  Tallies correct, incorrect, none, answered_correct, answered_incorrect;
  int n_incorrect_of_three = 0;
  std::array<int, 4> swaps{};
  std::map<int, int> n_trials_by_cubes;
  LabelMatrices labels;
  published::Comparable comparable;

  void add(const std::string& participant, const Attempt& attempt) {
    const Outcome outcome = *attempt.trial.outcome;
    correct[participant].add(outcome == "correct");
    incorrect[participant].add(outcome == "incorrect");
    none[participant].add(outcome == "dont_know");
    n_trials_by_cubes[static_cast<int>(attempt.cubes.size())] += 1;
    if (outcome == "dont_know") return;
    answered_correct[participant].add(outcome == "correct");
    answered_incorrect[participant].add(outcome == "incorrect");
    const std::vector<double> masses_g = attempt.masses_g();
    const auto given = final_labels(attempt.answers, static_cast<int>(masses_g.size()));
    count_labels(labels, masses_g, given);
    if (outcome != "incorrect" || masses_g.size() != 3) return;
    n_incorrect_of_three += 1;
    if (const auto swap = swap_of(masses_g, given)) swaps.at(static_cast<std::size_t>(*swap)) += 1;
  }
};

StudyEstimate share(const Tallies& tallies, std::string of, std::string answer,
                    const published::Figure* figure) {
  const Proportion found = proportion_of(tallies);
  StudyEstimate estimate{&answers};
  estimate.by = {{"trials", std::move(of)}, {"answer", std::move(answer)}};
  estimate.value = found.mean_percent;
  estimate.sd = found.sd_percent;
  estimate.set(found.interval_percent);
  estimate.n = found.n_participants;
  estimate.n_trials = found.trials.n_trials;
  estimate.n_hits = found.trials.n_hits;
  if (found.method != IntervalMethod::none) estimate.method = name_of(found.method);
  if (found.mean_percent) estimate.published = figure;
  return estimate;
}

// The share of answered trials that are correct, with the 90 % interval of the equivalence test.
StudyEstimate equivalence_of(const Tallies& answered_correct) {
  StudyEstimate estimate = share(answered_correct, "answered", "correct", nullptr);
  estimate.measure = &equivalence;
  estimate.low = estimate.high = std::nullopt;
  estimate.set(interval_percent_of(answered_correct, 0.9));
  return estimate;
}

// Each number of cubes apart, and how many of all trials a random order gets right on average.
std::vector<StudyEstimate> chances_of(const std::map<int, int>& n_trials_by_cubes) {
  StudyEstimate all{&chance};
  all.by = {{"trials", "all"}, {"answer", "correct"}};
  std::vector<StudyEstimate> chances;
  double sum = 0;
  for (const auto& [n_cubes, n_trials] : n_trials_by_cubes) {
    StudyEstimate& one = chances.emplace_back(StudyEstimate{&chance_by_cubes});
    one.by = {at("n_cubes", n_cubes)};
    one.value = chance_percent(n_cubes);
    one.n_trials = n_trials;
    all.n_trials += n_trials;
    sum += n_trials * *one.value;
  }
  if (all.n_trials > 0) all.value = sum / all.n_trials;
  chances.push_back(std::move(all));
  return chances;
}

StudyEstimate counted(const Measure& measure, std::vector<Coordinate> by, int n) {
  StudyEstimate estimate{&measure};
  estimate.by = std::move(by);
  estimate.value = n;
  return estimate;
}

void put_condition(Estimates& all, const std::string& condition, const Counted& found) {
  const auto papers = found.comparable.condition();
  const published::Sorting* paper = papers ? &published::sorting_in(*papers) : nullptr;
  const StudyEstimate correct =
      share(found.correct, "all", "correct", paper ? &paper->correct : nullptr);
  const auto put = [&](StudyEstimate estimate) {
    estimate.task = "sorting";
    estimate.condition = condition;
    estimate.as_published = paper != nullptr;
    all.push_back(std::move(estimate));
  };
  const auto put_of_all = [&](StudyEstimate estimate) {
    estimate.n = correct.n;
    put(std::move(estimate));
  };
  put(correct);
  put(share(found.incorrect, "all", "incorrect", paper ? &paper->incorrect : nullptr));
  put(share(found.none, "all", "I don't know", paper ? &paper->none : nullptr));
  put(share(found.answered_correct, "answered", "correct",
            paper && paper->answered_correct ? &*paper->answered_correct : nullptr));
  put(share(found.answered_incorrect, "answered", "incorrect", nullptr));
  put(equivalence_of(found.answered_correct));
  for (StudyEstimate& one : chances_of(found.n_trials_by_cubes)) put_of_all(std::move(one));
  const bool any_of_three = found.n_trials_by_cubes.contains(3);
  if (any_of_three) put_of_all(counted(n_incorrect, {}, found.n_incorrect_of_three));
  for (std::size_t i = 0; any_of_three && i < found.swaps.size(); ++i)
    put_of_all(counted(swapped, {{"exchanged", std::string(EnumNames<Swap>::names.at(i))}},
                       found.swaps.at(i)));
  for (const auto& [n_cubes, matrix] : found.labels) {
    const auto ranks = Sorting::labels_for(n_cubes);
    for (std::size_t cube = 0; cube < ranks.size(); ++cube)
      for (std::size_t label = 0; label < ranks.size(); ++label)
        put_of_all(counted(labels,
                           {{"n_cubes", fmt::format("{} cubes", n_cubes)},
                            {"cube", std::string(ranks[cube])},
                            {"label", std::string(ranks[label])}},
                           matrix[cube][label]));
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
      "the trials that their differences leave effective, and Student's t; exact "
      "(Clopper-Pearson) over people where all have the same percentage, over the trials of one "
      "alone. The paper's 10.1 % "
      "of answered trials is a ratio of means, nearest to pooled; its figures are beside its own "
      "techniques and masses only."};
  table.json = "sorting.{condition}.{trials}.{answer}";
  return table;
}

EstimateTable chance_table() {
  return {"sorting_chance",
          "Sorting: correct by chance",
          {key_column("condition", "condition"),
           column(chance, Field::value, "chance_percent", "chance %", 1, "chance"),
           column(chance, Field::n_trials, "n_trials", "trials"),
           column(chance, Field::n, "n_participants", "n")},
          "",
          TablePlace::report,
          "sorting.{condition}"};
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
  EstimateTable table{"sorting_confusion",
                      "Confusion matrix of labels and cubes",
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
                      {key_column("participant", "participant")},
                      "",
                      TablePlace::csv};
  EstimateColumn each = column(answers, Field::value, "_percent", " %");
  each.spread = "condition";
  table.columns.push_back(each);
  table.participants = true;
  return table;
}

// "all 5 were", "1 of 5 was", "none of 5 were"
std::string hits_in_words(int n_hits, int n) {
  if (n == 1) return n_hits == 1 ? "the only trial was" : "the only trial was not";
  if (n_hits == n) return fmt::format("all {} were", n);
  return fmt::format("{} of {} {}", n_hits == 0 ? "none" : fmt::format("{}", n_hits), n,
                     n_hits == 1 ? "was" : "were");
}

std::string percent_in_words(const StudyEstimate& share) {
  std::string text = fmt::format("{:.0f} %", *share.value);
  if (share.low) text += fmt::format(" [{:.0f}, {:.0f}]", *share.low, *share.high);
  return text;
}

const StudyEstimate& answers_in(const Summary& summary, const std::string& condition,
                                std::string_view trials, std::string_view answer) {
  return *find_estimate(summary.estimates, answers.name,
                        {{"condition", condition}, {"trials", trials}, {"answer", answer}});
}

// Chance applies to answers, so "I don't know" is counted apart: "with decoupling (C2) all 5 were
// correct, 100 % [48, 100]"; "without decoupling (C1) 42 % [21, 67] were "I don't know", and 12 %
// [4, 32] of the others were correct".
std::string condition_in_words(const Summary& summary, const std::string& condition) {
  const StudyEstimate& none = answers_in(summary, condition, "all", "I don't know");
  const StudyEstimate& correct = answers_in(summary, condition, "answered", "correct");
  const std::string where = in_condition(summary, condition);
  if (!correct.value)
    return fmt::format("{} all {} answers were \"I don't know\"", where, none.n_hits);
  if (correct.n == 1)
    return fmt::format(
        "{} {} correct, {}{}", where, hits_in_words(correct.n_hits, correct.n_trials),
        percent_in_words(correct),
        none.n_hits == 0 ? "" : fmt::format(", and {} \"I don't know\"", none.n_hits));
  if (none.n_hits == 0) return fmt::format("{} {} were correct", where, percent_in_words(correct));
  return fmt::format("{} {} were \"I don't know\", and {} of the others were correct", where,
                     percent_in_words(none), percent_in_words(correct));
}

std::string chance_in_words(const Summary& summary, const std::string& condition) {
  return fmt::format(
      "{:.0f} %",
      find_estimate(summary.estimates, chance.name, {{"condition", condition}})->value.value_or(0));
}

// The best conditions in a sentence.
std::string first_few(std::span<const std::string> conditions) {
  constexpr std::size_t most = 4;
  if (conditions.size() <= most) return fmt::format("{}", fmt::join(conditions, "; "));
  return fmt::format("{}; {} more conditions in the tables",
                     fmt::join(conditions.first(most), "; "), conditions.size() - most);
}

class SortingSection final : public Section {
 public:
  void add(const SessionData& data) override {
    const std::string participant = data.participant();
    for (const Attempt& attempt : data.attempts) {
      if (attempt.trial.plan.task != "sorting") continue;
      const std::string& condition = attempt.trial.plan.condition;
      Counted& counted = conditions_[condition];
      if (!attempt.completed() || !attempt.trial.outcome) continue;
      counted.add(participant, attempt);
      counted.comparable.add(data.published_condition(condition),
                             attempt.shows(published::sorting_masses_g));
    }
  }

  void put(Summary& summary) override {
    for (auto& [condition, counted] : conditions_) {
      put_condition(summary.estimates, condition, counted);
      correct_[condition] = std::move(counted.correct);
    }
    conditions_.clear();
  }

  Estimates of_participants(const Summary&) const override {
    Estimates all;
    for (const auto& [condition, people] : correct_)
      for (const auto& [participant, tally] : people) {
        StudyEstimate& own = all.emplace_back(own_share(answers, participant, tally));
        own.task = "sorting";
        own.condition = condition;
        own.by = {{"answer", "correct"}};
      }
    return all;
  }

  std::vector<std::string> findings(const Summary& summary) const override {
    if (!find_estimate(summary.estimates, answers.name)) return {};
    std::vector<const StudyEstimate*> conditions =
        estimates_of(summary.estimates, answers.name, {{"trials", "all"}, {"answer", "correct"}});
    std::erase_if(conditions, [](const StudyEstimate* one) { return !one->value; });
    if (conditions.empty()) return {"Sorting: no trial was completed."};
    std::ranges::stable_sort(conditions, std::greater(), &StudyEstimate::value);
    std::vector<std::string> parts;
    std::set<std::string> chances;
    for (const StudyEstimate* one : conditions) {
      parts.push_back(condition_in_words(summary, one->condition));
      chances.insert(chance_in_words(summary, one->condition));
    }
    return {fmt::format("Sorting: {}. Chance is {}.", first_few(parts), fmt::join(chances, " or ")),
            sorting_verdicts(summary)};
  }

  std::vector<EstimateTable> tables() const override {
    return {sorting_table(), chance_table(), label_table(), swaps_table(), participants_table()};
  }

  std::vector<ChartSpec> charts() const override {
    return {
        {.name = "sorting",
         .title = "Sorting: answers per condition, 95 % intervals",
         .caption = "Percentage of completed trials, mean over participants with 95 % intervals. "
                    "Dashed: correct by chance.",
         .csv = "sorting.csv",
         .importance = 10,
         .series = {{&answers, "", {"trials", "all"}}},
         .x = "answer",
         .split = {"condition"},
         .reference = &chance,
         .y_label = "% of trials, mean over participants",
         .axes = "set yrange [0:100]\n"},
        {.name = "sorting_by_participant",
         .title = "Correct sortings of each participant",
         .caption = "Percentage of completed trials; a line joins a participant's conditions.",
         .csv = "sorting_by_participant.csv",
         .shape = ChartShape::linked,
         .importance = 45,
         .series = {{&answers, "", {"answer", "correct"}}},
         .x = "condition",
         .reference = &chance,
         .y_label = "% of trials sorted correctly",
         .axes = "set yrange [-3:103]\n"},
        {.name = "sorting_confusion",
         .title = "Confusion matrix of labels and cubes",
         .caption = "Sorted trials of all participants, without \"I don't know\": counts, and "
                    "percent of the cube's labels. Correct labels are on the diagonal.",
         .csv = "sorting_confusion.csv",
         .shape = ChartShape::matrix,
         .importance = 50,
         .series = {{&labels}},
         .x = "label",
         .y = "cube",
         .panels = {"condition", "n_cubes"},
         .x_label = "label",
         .y_label = "cube"}};
  }

 private:
  std::map<std::string, Counted> conditions_;
  std::map<std::string, Tallies> correct_;  // of each condition
};
}  // namespace

std::shared_ptr<Section> sorting_section() {
  return std::make_shared<SortingSection>();
}

}  // namespace heft
