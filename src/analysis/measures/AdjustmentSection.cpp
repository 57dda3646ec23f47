// Adjustments: how far the masses that participants set are from the reference (bias, in g and in
// percent), how much they vary (spread), and how much they follow the mass that the comparison had
// at first (start effect).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "analysis/display/Phrases.h"
#include "analysis/measures/Section.h"

namespace heft {

namespace {
constexpr Measure bias{
    "adjustment_bias", "g", "bias",
    "mass set equal to the reference minus the reference: mean over participants of each one's "
    "mean, Student's t interval"};
constexpr Measure bias_percent{
    "adjustment_bias_percent", "%", "bias in percent",
    "mass set equal to the reference over the reference, minus 1: geometric mean over participants "
    "of each one's geometric mean, Student's t interval on the logarithms"};
constexpr Measure spread{
    "adjustment_spread", "g", "spread",
    "standard deviation of a participant's settings: mean over participants, Student's t interval"};

constexpr Measure start_effect{
    "adjustment_start_effect", "", "start effect",
    "slope of a participant's settings on the first masses of the comparison, least squares: 0 if "
    "the start has no influence, 1 if settings differ as the starts do; mean over participants, "
    "Student's t interval"};

struct Compared {
  std::string condition;
  double reference_g = 0;
  auto operator<=>(const Compared&) const = default;
};

// Settings of one participant, by trial.
struct Settings {
  std::vector<double> set_g, start_g;
};

double mean_ratio(const Settings& settings, double reference_g) {
  std::vector<double> logs;
  for (const double set_g : settings.set_g) logs.push_back(std::log(set_g / reference_g));
  return std::exp(*mean(logs));
}

// None for fewer than three settings, or where all started alike.
std::optional<double> slope_on_start(const Settings& settings) {
  constexpr std::size_t least_settings = 3;
  const auto [least, greatest] = std::ranges::minmax(settings.start_g);
  if (settings.set_g.size() < least_settings || least == greatest) return std::nullopt;
  return slope(settings.start_g, settings.set_g);
}

double percent_of(double ratio) {
  return 100 * (ratio - 1);
}

class AdjustmentSection final : public Section {
 public:
  void add(const SessionData& data) override {
    for (const Attempt& attempt : data.attempts) {
      const TrialRow& trial = attempt.trial;
      if (!attempt.completed() || trial.plan.task != "adjustment" || !trial.value ||
          !trial.plan.reference_g || !trial.plan.level_g)
        continue;
      const Compared compared{trial.plan.condition, *trial.plan.reference_g};
      Settings& settings = people_[compared][data.participant()];
      settings.set_g.push_back(*trial.value);
      settings.start_g.push_back(compared.reference_g + *trial.plan.level_g);
    }
  }

  Estimates of_participants(const Summary&) const override {
    Estimates all = own_estimates();
    for (StudyEstimate& own : all)
      if (own.measure == &bias_percent) own.value = percent_of(*own.value);
    return all;
  }

  void put(Summary& summary) override {
    const Estimates all = own_estimates();
    std::map<std::tuple<Compared, std::string_view>, std::vector<const StudyEstimate*>> groups;
    for (const StudyEstimate& own : all)
      groups[{{own.condition, *own.reference_g}, own.measure->name}].push_back(&own);
    for (const auto& [key, people] : groups) {
      const bool is_ratio = people.front()->measure == &bias_percent;
      StudyEstimate over_people = mean_over_people(people, is_ratio);
      for (auto* figure : {&over_people.value, &over_people.low, &over_people.high})
        if (is_ratio && *figure) *figure = percent_of(**figure);
      summary.estimates.push_back(std::move(over_people));
    }
  }

  std::vector<std::string> findings(const Summary& summary) const override {
    std::vector<std::string> parts;
    for (const StudyEstimate* one : estimates_of(summary.estimates, bias_percent.name)) {
      const std::string interval =
          one->low ? fmt::format(" [{:+.1f}, {:+.1f}]", *one->low, *one->high) : "";
      parts.push_back(fmt::format("{:+.1f} %{} at {:g} g {}", *one->value, interval,
                                  *one->reference_g, in_condition(summary, one->condition)));
    }
    if (parts.empty()) return {};
    return {fmt::format("Adjustment: masses set equal to the reference differ from it by {}.",
                        some_of(parts, 4))};
  }

  std::vector<EstimateTable> tables() const override {
    EstimateTable over_people{
        "adjustment",
        "Adjustment: masses set equal to the reference",
        {key_column("condition", "condition"), key_column("reference_g", "reference g"),
         column(bias, Field::n, "n_participants", "n"),
         column(bias, Field::n_trials, "n_trials", "trials"),
         column(bias, Field::value, "bias_g", "bias g"), column(bias, Field::sd, "sd_g", "SD")},
        "over participants, each of whom counts once; bias in percent by geometric means; spread: "
        "standard deviation of a participant's settings; start effect: slope of settings on the "
        "first mass, of three settings or more",
        TablePlace::results,
        "adjustment[]"};
    add_interval(over_people.columns, bias, "low_g", "high_g");
    over_people.columns.push_back(column(bias_percent, Field::value, "bias_percent", "bias %"));
    add_interval(over_people.columns, bias_percent, "low_percent", "high_percent");
    over_people.columns.push_back(column(spread, Field::value, "spread_g", "spread g"));
    add_interval(over_people.columns, spread, "spread_low_g", "spread_high_g");
    over_people.columns.push_back(
        column(start_effect, Field::value, "start_effect", "start effect", 2));
    add_interval(over_people.columns, start_effect, "start_effect_low", "start_effect_high", 2);
    over_people.columns.push_back(column(spread, Field::why, "why", "no spread: why"));

    EstimateTable people{
        "adjustment_by_participant",
        "Each participant's bias and spread",
        {key_column("condition", "condition"), key_column("reference_g", "reference g"),
         key_column("participant", "participant"), column(bias, Field::value, "bias_g", "bias g"),
         column(bias, Field::n_trials, "n_trials", "trials"),
         column(bias_percent, Field::value, "bias_percent", "bias %"),
         column(spread, Field::value, "spread_g", "spread g"),
         column(start_effect, Field::value, "start_effect", "start effect", 2),
         column(spread, Field::why, "why", "no spread: why")},
        "",
        TablePlace::csv};
    people.participants = true;
    return {over_people, people};
  }

  std::vector<ChartSpec> charts() const override {
    return {{.name = "adjustment",
             .title = "Adjustment: bias by reference, 95 % intervals",
             .caption = "Mass set equal to the reference, relative to the reference; small points: "
                        "each participant.",
             .csv = "adjustment.csv",
             .importance = 38,
             .series = {{&bias_percent}},
             .x = "reference_g",
             .split = {"condition"},
             .participants = true,
             .x_label = "reference (g)",
             .y_label = "bias (%)"}};
  }

 private:
  // With bias_percent as a ratio.
  Estimates own_estimates() const {
    Estimates all;
    for (const auto& [compared, people] : people_)
      for (const auto& [participant, settings] : people)
        add_own(all, compared, participant, settings);
    return all;
  }

  static void add_own(Estimates& all, const Compared& compared, const std::string& participant,
                      const Settings& settings) {
    const auto put = [&](const Measure& measure, std::optional<double> value) -> StudyEstimate& {
      StudyEstimate& own = all.emplace_back(
          StudyEstimate{&measure, "adjustment", compared.condition, compared.reference_g});
      own.participant = participant;
      own.value = value;
      own.n = 1;
      own.n_trials = static_cast<int>(settings.set_g.size());
      return own;
    };
    put(bias, *mean(settings.set_g) - compared.reference_g);
    put(bias_percent, mean_ratio(settings, compared.reference_g));
    const auto sd = sample_sd(settings.set_g);
    put(spread, sd).why = sd ? "" : "a single setting";
    const auto effect = slope_on_start(settings);
    put(start_effect, effect).why = effect ? "" : "fewer than three settings, or equal starts";
  }

  std::map<Compared, std::map<std::string, Settings>> people_;
};
}  // namespace

std::shared_ptr<Section> adjustment_section() {
  return std::make_shared<AdjustmentSection>();
}

}  // namespace heft
