// Logs of several labs: the threshold in each lab, and how the labs differ. The participants of two
// labs are different people, each lab's thresholds a population's.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "analysis/display/Phrases.h"
#include "analysis/measures/Section.h"
#include "analysis/measures/Sensitivity.h"

namespace heft {

namespace {
constexpr Measure lab_threshold{
    "lab_threshold_75", "g", "threshold",
    "75 %-correct discrimination threshold of the median participant of one lab (one log)"};
constexpr Measure lab_ratio{"lab_threshold_ratio", "", "ratio of labs",
                            "threshold in a lab over the threshold in another one, at the same "
                            "reference and condition; 1: they do not differ"};
constexpr Measure lab_smallest_ratio{
    "lab_smallest_threshold_ratio", "", "smallest ratio",
    "smallest ratio of two labs' thresholds that 80 % of studies of this size and spread would "
    "distinguish from 1"};

using FitsByLab = std::map<std::string, MixedFit>;

StudyEstimate estimate_at(const Measure& measure, const Compared& compared,
                          const std::string& lab) {
  StudyEstimate estimate{&measure, "comparison", compared.condition, compared.reference_g};
  estimate.by = {{"lab", lab}};
  return estimate;
}

void put_threshold(Estimates& all, const Compared& compared, const std::string& lab,
                   const MixedFit& fit) {
  StudyEstimate& one = all.emplace_back(estimate_at(lab_threshold, compared, lab));
  one.n = fit.n;
  one.n_trials = static_cast<int>(fit.n_trials);
  one.method = "mixed indecision model, profile likelihood";
  one.why = fit.why;
  if (!fit.threshold_75_g) return;
  one.value = fit.threshold_75_g->value;
  one.low = fit.threshold_75_g->low;
  one.high = fit.threshold_75_g->high;
}

void put_ratio(Estimates& all, const Compared& compared, const FitsByLab::value_type& lab,
               const FitsByLab::value_type& other) {
  const Contrast contrast =
      threshold_contrast(std::array{&other.second, &lab.second}, std::array{-1.0, 1.0});
  const auto [low, high] = contrast.interval();
  StudyEstimate ratio = estimate_at(lab_ratio, compared, lab.first);
  ratio.by.push_back({"other_lab", other.first});
  ratio.n = contrast.n;
  ratio.method = "infinitesimal jackknife over participants";
  StudyEstimate smallest = ratio;
  smallest.measure = &lab_smallest_ratio;
  smallest.value = std::exp(contrast.smallest_effect());
  ratio.value = std::exp(contrast.value);
  ratio.set(Interval{std::exp(low), std::exp(high)});
  all.push_back(std::move(ratio));
  all.push_back(std::move(smallest));
}

class LabSection final : public Section {
 public:
  void add(const SessionData& data) override { labs_[data.participant()] = data.lab; }

  void put(Summary& summary) override {
    const ComparisonTrials& trials = summary.shared->comparisons;
    for (const auto& [compared, theirs] : trials.by_compared()) {
      std::map<std::string, AnswersByPerson> by_lab;
      for (auto& [participant, answers] : answers_by_side(trials, compared))
        by_lab[labs_.at(participant)][participant] = answers;
      if (by_lab.size() < 2) continue;
      FitsByLab fits;
      for (const auto& [lab, people] : by_lab) {
        fits[lab] = fit_mixed_indecision(people);
        put_threshold(summary.estimates, compared, lab, fits[lab]);
      }
      std::erase_if(fits, [](const auto& one) {
        return !one.second.identifiable() || one.second.n < least_people;
      });
      for (auto lab = fits.begin(); lab != fits.end(); ++lab)
        for (auto other = fits.begin(); other != lab; ++other)
          put_ratio(summary.estimates, compared, *lab, *other);
    }
    labs_ = {};
  }

  std::vector<std::string> findings(const Summary& summary) const override {
    std::vector<std::string> ratios;
    for (const StudyEstimate* one : estimates_of(summary.estimates, lab_ratio.name))
      ratios.push_back(fmt::format("{} over {} {:.2f} [{:.2f}, {:.2f}] at {:g} g in {}",
                                   one->text_at("lab"), one->text_at("other_lab"), *one->value,
                                   *one->low, *one->high, *one->reference_g, one->condition));
    if (ratios.empty()) return {};
    return {fmt::format("Ratio of the labs' thresholds: {}.", some_of(ratios, 4))};
  }

  std::vector<EstimateTable> tables() const override {
    return {{"labs",
             "Thresholds of each lab",
             {key_column("reference_g", "reference g"), key_column("condition", "condition"),
              key_column("lab", "lab"), column(lab_threshold, Field::n, "n", "n"),
              column(lab_threshold, Field::value, "threshold_75_g", "threshold g"),
              column(lab_threshold, Field::low, "low_g", "95 % low"),
              column(lab_threshold, Field::high, "high_g", "high"),
              column(lab_threshold, Field::n_trials, "n_trials"),
              column(lab_threshold, Field::why, "why", "no threshold: why")},
             "75 %-correct thresholds as above, of the participants of one log each"},
            {"lab_ratios",
             "Differences between labs",
             {key_column("reference_g", "reference g"), key_column("condition", "condition"),
              key_column("lab", "lab"), key_column("other_lab", "over lab"),
              column(lab_ratio, Field::n, "n", "n"),
              column(lab_ratio, Field::value, "ratio", "ratio", 2),
              column(lab_ratio, Field::low, "low", "95 % low", 2),
              column(lab_ratio, Field::high, "high", "high", 2),
              column(lab_smallest_ratio, Field::value, "smallest_ratio", "detectable", 2)},
             "threshold in a lab over that in another; 1: they do not differ. Detectable: the "
             "smallest ratio that 80 % of studies of this size and spread would find."}};
  }

  std::vector<ChartSpec> charts() const override {
    return {{.name = "labs",
             .title = "Thresholds of each lab, 95 % intervals",
             .caption = "The median participant's 75 %-correct threshold at each reference, by "
                        "lab and condition, where the data identify one.",
             .csv = "labs.csv",
             .importance = 29,
             .series = {{&lab_threshold}},
             .x = "reference_g",
             .split = {"lab", "condition"},
             .x_label = "reference mass (g)",
             .y_label = "threshold (g)",
             .axes = "set yrange [0:*]\n"}};
  }

 private:
  std::map<std::string, std::string> labs_;  // by participant
};
}  // namespace

std::shared_ptr<Section> lab_section() {
  return std::make_shared<LabSection>();
}

}  // namespace heft
