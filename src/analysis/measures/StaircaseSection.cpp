// The paper's JND: by reference and condition, from above and from below, of each participant; and
// how the staircases went.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "analysis/display/Phrases.h"
#include "analysis/measures/Section.h"

namespace heft {

namespace {
constexpr Measure jnd{
    "jnd", "g", "JND",
    "the paper's JND: mean level of a staircase's reversals without the first ones, by the "
    "side on which staircases started; log-normal mean over participants"};
constexpr Measure jnd_overall{
    "jnd_overall", "g", "JND",
    "the paper's JND over all staircases of a participant; log-normal mean over participants"};
constexpr Measure jnd_paper_mean{
    "jnd_paper_mean", "g", "paper's mean",
    "the paper's own mean of JNDs: arithmetic mean over the participants with a JND by the "
    "paper's rule, censored ones at the mean of their reversals"};
constexpr Measure n_above{"jnd_n_above", "", "above",
                          "participants whose JND is censored: it is larger than shown"};
constexpr Measure n_below{"jnd_n_below", "", "below",
                          "participants whose JND is censored: it is smaller than shown"};
constexpr Measure n_known{"jnd_n_known", "", "known", "participants with a JND, exact or censored"};
constexpr Measure n_missing{"jnd_n_missing", "", "missing", "participants without a JND"};

constexpr Measure jnd_rising{
    "jnd_rising", "%", "rising JNDs",
    "share of participants whose JND rises with the reference, of those with "
    "an exact JND at each of the paper's references"};

// A count of staircases, and its columns.
struct Counted {
  Measure measure;
  std::string_view column, heading, json;
  std::optional<double> (*of)(const ReferenceJnd& row);
};
template <auto member>
std::optional<double> counted(const ReferenceJnd& row) {
  return row.*member;
}
template <auto member>
std::optional<double> of_finished(const ReferenceJnd& row) {
  return row.n_staircases > 0 ? std::optional<double>(row.*member) : std::nullopt;
}
constexpr std::array staircase_counts{
    Counted{{"staircases_finished", "", "finished", "finished staircases"},
            "n_staircases",
            "finished",
            "n_staircases",
            counted<&ReferenceJnd::n_staircases>},
    Counted{{"staircases_unfinished", "", "unfinished", "staircases that began and did not finish"},
            "n_unfinished",
            "unfinished",
            "n_unfinished",
            counted<&ReferenceJnd::n_unfinished>},
    Counted{{"staircase_trials", "", "trials", "mean number of trials of a finished staircase"},
            "mean_trials",
            "trials",
            "trials.mean",
            of_finished<&ReferenceJnd::mean_trials>},
    Counted{{"staircase_trials_least", "", "least", "fewest trials of a finished staircase"},
            "least_trials",
            "least",
            "trials.least",
            of_finished<&ReferenceJnd::least_trials>},
    Counted{{"staircase_trials_most", "", "most", "most trials of a finished staircase"},
            "most_trials",
            "most",
            "trials.most",
            of_finished<&ReferenceJnd::most_trials>},
    Counted{{"staircases_at_limit", "", "at limit", "staircases that the trial limit ended"},
            "n_trial_limit",
            "at limit",
            "n_trial_limit",
            counted<&ReferenceJnd::n_trial_limit>},
    Counted{{"staircases_without_jnd", "", "no JND", "finished staircases without an estimate"},
            "n_without_estimate",
            "no JND",
            "n_without_estimate",
            counted<&ReferenceJnd::n_without_estimate>},
    Counted{{"floor_hits", "", "floor", "moves that the floor cut short"},
            "n_floor",
            "floor",
            "n_floor",
            counted<&ReferenceJnd::n_floor>},
    Counted{{"floor_staircases", "", "in", "staircases with such moves"},
            "n_floor_staircases",
            "in",
            "n_floor_staircases",
            counted<&ReferenceJnd::n_floor_staircases>},
    Counted{{"ceiling_hits", "", "ceiling", "moves that the ceiling cut short"},
            "n_ceiling",
            "ceiling",
            "n_ceiling",
            counted<&ReferenceJnd::n_ceiling>},
    Counted{{"ceiling_staircases", "", "in", "staircases with such moves"},
            "n_ceiling_staircases",
            "in",
            "n_ceiling_staircases",
            counted<&ReferenceJnd::n_ceiling_staircases>}};

StudyEstimate estimate_at(const Measure& measure, const ReferenceJnd& row) {
  StudyEstimate estimate{&measure, "comparison", row.compared.condition, row.compared.reference_g};
  estimate.as_published = row.published != nullptr;
  estimate.by = {{"method", row.compared.method}};
  return estimate;
}

// Adds the mean of JNDs, and the numbers that are censored above and below.
void put_jnds(Estimates& all, StudyEstimate estimate, const Jnds& jnds) {
  set_mean(estimate, jnds);
  all.push_back(estimate);
  StudyEstimate number{estimate};
  number.sd = number.low = number.high = std::nullopt;
  number.method = {};
  number.why.clear();
  number.published = nullptr;
  const auto put_number = [&](const Measure& measure, int n) {
    number.measure = &measure;
    number.value = n;
    all.push_back(number);
  };
  put_number(n_above, jnds.n_censored(Censored::above));
  put_number(n_below, jnds.n_censored(Censored::below));
  put_number(n_missing, static_cast<int>(jnds.missing.size()));
  put_number(n_known, jnds.n() - static_cast<int>(jnds.missing.size()));
  number.measure = &jnd_paper_mean;
  number.value = jnds.by_paper.mean;
  number.sd = jnds.by_paper.sd;
  number.n = jnds.by_paper.n;
  all.push_back(number);
}

// JNDs by where the staircases began.
struct Began {
  const char* staircases;
  Jnds jnds;
  bool beside_paper;  // its staircases began above
};

std::vector<Began> began_in(const ReferenceJnd& row) {
  if (!row.starts) return {{"all", row.as_published(), true}};
  return {{"from above", row.starts->from_above_g, true},
          {"from below", row.starts->from_below_g, false},
          {"above - below", row.starts->difference_g, false}};
}

StudyEstimate estimate_of(const ReferenceJnd& row, const Began& began) {
  StudyEstimate estimate = estimate_at(jnd, row);
  estimate.by.push_back({"staircases", began.staircases});
  estimate.published = began.beside_paper ? row.published : nullptr;
  return estimate;
}

void put_overall(Estimates& all, const ReferenceJnd& row) {
  StudyEstimate estimate = estimate_at(jnd_overall, row);
  estimate.published = row.published;
  put_jnds(all, std::move(estimate), row.overall);
  for (const Counted& count : staircase_counts) {
    all.push_back(estimate_at(count.measure, row));
    all.back().value = count.of(row);
  }
}

// Of the participants with an exact JND at every reference where the paper has one, those whose
// JND rises at each step.
void put_rising(Estimates& all, const std::vector<ReferenceJnd>& rows) {
  std::map<std::string, std::vector<double>> jnds;
  std::size_t n_references = 0;
  for (const ReferenceJnd& row : rows) {
    const Jnds& began = row.as_published();
    if (!row.published || !began.mean) continue;
    ++n_references;
    for (const ParticipantJnd& one : began.participants)
      if (one.censored == Censored::none) jnds[one.participant].push_back(one.jnd_g);
  }
  if (n_references < 2) return;
  Tally rising;
  for (const auto& [participant, values] : jnds)
    if (values.size() == n_references)
      rising.add(std::ranges::adjacent_find(values, std::greater_equal()) == values.end());
  StudyEstimate& estimate = all.emplace_back(rate_estimate(jnd_rising, rate_of_people(rising)));
  estimate.task = "comparison";
  estimate.as_published = true;
}

std::vector<EstimateColumn> columns_of(std::vector<EstimateColumn> columns, const Measure& measure,
                                       std::string_view json,
                                       std::pair<std::string_view, std::string> only) {
  const auto add = [&](const Measure& of, Field field, const char* name, const char* heading,
                       int decimals = 1) {
    EstimateColumn added = column(of, field, name, heading, decimals);
    if (!json.empty() || !heading) added.json = std::string(json) + name;
    added.only = only;
    columns.push_back(std::move(added));
  };
  add(measure, Field::value, "mean_g", "JND g");
  add(measure, Field::sd, "sd_g", "SD");
  add(measure, Field::low, "low_g", "95 % low");
  add(measure, Field::high, "high_g", "high");
  add(measure, Field::method, "summary", "is the");
  add(measure, Field::n, "n", "n");
  add(n_above, Field::value, "n_censored_above", "above", 0);
  add(n_below, Field::value, "n_censored_below", "below", 0);
  add(n_missing, Field::value, "n_missing", "missing", 0);
  add(jnd_paper_mean, Field::value, "paper_mean_g", "paper's mean");
  add(jnd_paper_mean, Field::sd, "paper_sd_g", "SD");
  add(jnd_paper_mean, Field::n, "paper_n", "n");
  return columns;
}

EstimateTable jnd_table() {
  EstimateTable table{
      "jnd", "JND by reference mass, mean over participants",
      columns_of({key_column("reference_g", "reference g"), key_column("condition", "condition"),
                  key_column("staircases", "staircases")},
                 jnd, "", {}),
      "n participants; SD between them (n-1). The paper's JND: it moves with the criterion as much "
      "as with what is perceived, and with where its staircase began: where they began on both "
      "sides, these are apart, and above - below is by how much each participant's JND follows the "
      "start. Above, below: participants of whom it is only known to lie there, because a bound "
      "cut a move of a staircase, or it ended at its trial limit or with fewer than 4 reversals; "
      "missing: not even that. JND: mean of the log-normal model of exact and censored ones "
      "together with its profile interval, which needs three exact ones; a JND of 0 counts as "
      "below the smallest other one. Above - below, which may be negative: Student's t, or the "
      "Tobit mean of the normal model where some are censored. None where half or more are not "
      "exact. Paper's mean: arithmetic, with censored JNDs at the mean of their reversals."};
  table.columns.push_back(column(jnd, Field::published, "published_g", "published g"));
  table.columns.push_back(column(jnd, Field::published_sd, "published_sd_g", "published SD"));
  table.columns.push_back(key_column("method", "method"));
  return table;
}

// The fields of a reference in JSON, except its counts.
EstimateTable jnd_json() {
  std::vector<EstimateColumn> columns =
      columns_of({key_column("reference_g", "reference g"), key_column("condition", "condition"),
                  key_column("method", "method")},
                 jnd_overall, "", {"staircases", ""});
  for (const auto& [began, json] :
       {std::pair("from above", "from_above?."), std::pair("from below", "from_below?."),
        std::pair("above - below", "above_minus_below?.")})
    columns = columns_of(std::move(columns), jnd, json, {"staircases", began});
  EstimateColumn known = json_column(n_known, Field::value, "n_participants");
  known.decimals = 0;
  known.only = {"staircases", ""};
  columns.push_back(std::move(known));
  columns.push_back(json_column(jnd_overall, Field::published, "published_g"));
  columns.push_back(json_column(jnd_overall, Field::published_sd, "published_sd_g"));
  return {"jnd_overall",         "",
          std::move(columns),    "",
          TablePlace::json_only, "jnd[reference_g,condition,method]"};
}

EstimateTable participants_json() {
  EstimateTable table{
      "jnd_by_participant",
      "Each participant's JND",
      {key_column("reference_g", "reference g"), key_column("condition", "condition"),
       key_column("method", "method"), key_column("participant", "participant"),
       column(jnd_overall, Field::value, "jnd_g", "JND g"),
       column(jnd_overall, Field::censored, "censored", "censored")},
      "",
      TablePlace::csv,
      "jnd[reference_g,condition,method].participants[]"};
  table.participants = true;
  return table;
}

EstimateTable health_table() {
  EstimateTable table{
      "staircase_health",
      "Staircases: trials, bounds and estimates",
      {key_column("reference_g", "reference g"), key_column("condition", "condition"),
       key_column("method", "method")},
      "staircases; trials: mean, least and most of the finished; at limit: ended by "
      "the trial limit; floor, ceiling: moves that the bound cut short, and in how "
      "many staircases"};
  for (const Counted& count : staircase_counts)
    table.columns.push_back(column(count.measure, Field::value, std::string(count.column),
                                   std::string(count.heading),
                                   count.column == "mean_trials" ? 1 : 0, std::string(count.json)));
  table.json = "jnd[reference_g,condition,method]";
  return table;
}

class StaircaseSection final : public Section {
 public:
  void put(Summary& summary) override {
    jnds_ = summary.shared->staircases.jnds();
    for (const ReferenceJnd& row : jnds_) {
      for (const Began& began : began_in(row))
        put_jnds(summary.estimates, estimate_of(row, began), began.jnds);
      put_overall(summary.estimates, row);
    }
    put_rising(summary.estimates, jnds_);
  }

  Estimates of_participants(const Summary&) const override {
    Estimates all;
    for (const ReferenceJnd& row : jnds_) {
      for (const Began& began : began_in(row))
        put_participants(all, estimate_of(row, began), began.jnds);
      put_participants(all, estimate_at(jnd_overall, row), row.overall);
    }
    return all;
  }

  std::vector<std::string> findings(const Summary& summary) const override {
    std::map<std::pair<std::string, std::string>, std::vector<std::string>> by_method;
    for (const StudyEstimate* one : estimates_of(summary.estimates, jnd.name)) {
      const std::string staircases = one->text_at("staircases");
      if (staircases == "above - below") continue;
      std::string text =
          one->value ? fmt::format("{}{} g", beyond_sign(one->censored), in_grams(*one->value))
                     : "none";
      text += grams_between(*one);
      const StudyEstimate* by_paper = find_estimate(summary.estimates, jnd_paper_mean.name,
                                                    {{"staircases", staircases},
                                                     {"condition", one->condition},
                                                     {"reference_g", one->text_at("reference_g")},
                                                     {"method", one->text_at("method")}});
      if (by_paper && by_paper->value && one->text_at("method") == jnd_method)
        text += fmt::format(" (arithmetic mean {} g)", in_grams(*by_paper->value));
      text += fmt::format(" at {:g} g", *one->reference_g);
      if (staircases != "all") text += " " + staircases;
      by_method[{one->text_at("method"), one->condition}].push_back(std::move(text));
    }
    std::vector<std::string> found;
    for (const auto& [of, values] : by_method)
      found.push_back(fmt::format(
          "{} in {}: {}.",
          of.first == jnd_method ? "The paper's JND" : fmt::format("JND ({})", of.first), of.second,
          some_of(values, 6)));
    return found;
  }

  std::vector<EstimateTable> tables() const override {
    return {jnd_json(), jnd_table(), health_table(), participants_json()};
  }

  std::vector<ChartSpec> charts() const override {
    return {{.name = "jnd",
             .title = "JND against reference mass, 95 % intervals",
             .caption =
                 "The paper's JND, which moves with the criterion and the start as much as with "
                 "what is perceived; of staircases from above and from below apart. Large points: "
                 "mean over participants where more than half have an exact JND; arrows: "
                 "participants of whom it is known only to lie above or below; diamonds: "
                 "published, of staircases from above.",
             .csv = "jnd.csv",
             .importance = 35,
             .series = {{&jnd, "mean", {"staircases", "all"}},
                        {&jnd, "mean from above", {"staircases", "from above"}},
                        {&jnd, "mean from below", {"staircases", "from below"}}},
             .x = "reference_g",
             .split = {"condition", "method"},
             .participants = true,
             .x_label = "reference mass (g)",
             .y_label = "JND (g)",
             .axes = "set yrange [0:*]\n"}};
  }

 private:
  std::vector<ReferenceJnd> jnds_;
};
}  // namespace

std::shared_ptr<Section> staircase_section() {
  return std::make_shared<StaircaseSection>();
}

}  // namespace heft
