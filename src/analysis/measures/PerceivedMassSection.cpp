// Sorting: perceived masses of cubes in each condition, from the participants' orders (Thurstone's
// case V).
#include <fmt/format.h>

#include <map>
#include <set>

#include "analysis/dataset/Sorting.h"
#include "analysis/measures/Section.h"
#include "inference/rankings/Thurstone.h"
#include "tasks/Sorting.h"

namespace heft {

namespace {
constexpr Measure perceived{
    "perceived_mass", "SD", "perceived mass",
    "perceived mass of a cube above that of the lightest one, in SDs of a difference of two "
    "percepts: the normal quantile of the share of trials in which it would be sorted above the "
    "lightest one (Thurstone's case V, of answered trials of all participants together)"};
constexpr Measure distance{
    "perceived_distance", "SD", "from the next lighter cube",
    "perceived mass of a cube above that of the next lighter one of its condition, as "
    "perceived_mass"};

constexpr Measure contrast{
    "perceived_mass_contrast", "SD", "difference of perceived masses",
    "perceived_mass of a cube in a condition less that in another one with the same lightest cube"};
constexpr Measure smallest_contrast{
    "smallest_perceived_mass_contrast", "SD", "smallest difference",
    "smallest difference of perceived masses that 80 % of studies of this size and spread would "
    "distinguish from 0"};

// Completed trials of one condition.
struct Sorted {
  std::map<double, int> n_answered;  // by mass; also of masses that were never sorted
  OrdersByPerson people;

  void add(const std::string& participant, const Attempt& attempt) {
    const std::vector<double> masses_g = attempt.masses_g();
    const int n_cubes = static_cast<int>(masses_g.size());
    for (const double mass_g : masses_g) n_answered[mass_g] += 0;
    if (*attempt.trial.outcome == "dont_know") return;
    const auto given = final_labels(attempt.answers, n_cubes);
    RankOrder order;
    for (const std::string_view label : Sorting::labels_for(n_cubes))
      if (const auto found = std::ranges::find(given, label); found != given.end())
        order.push_back(masses_g[static_cast<std::size_t>(found - given.begin())]);
    if (order.size() < masses_g.size()) return;
    for (const double mass_g : masses_g) n_answered[mass_g] += 1;
    people[participant][order] += 1;
  }
};

class PerceivedMassSection final : public Section {
 public:
  void add(const SessionData& data) override {
    for (const Attempt& attempt : data.attempts)
      if (attempt.trial.plan.task == "sorting" && attempt.completed() && attempt.trial.outcome)
        conditions_[attempt.trial.plan.condition].add(data.participant(), attempt);
  }

  void put(Summary& summary) override {
    std::map<std::string, Perceived> perceived_in;
    for (const auto& [condition, sorted] : conditions_) {
      for (PerceivedStimulus& one : perceived_values(sorted.people))
        perceived_in[condition].emplace(one.stimulus, std::move(one));
      put(summary.estimates, condition, sorted, perceived_in[condition]);
    }
    for (auto one = perceived_in.begin(); one != perceived_in.end(); ++one)
      for (auto other = perceived_in.begin(); other != one; ++other)
        put_contrasts(summary.estimates, *other, *one);
    conditions_.clear();
  }

  std::vector<EstimateTable> tables() const override {
    EstimateTable table{
        "perceived_mass",
        "Perceived mass by sorting (Thurstone's case V)",
        {key_column("condition", "condition"), key_column("mass_g", "mass g"),
         column(perceived, Field::n, "n", "n"),
         column(perceived, Field::n_trials, "n_trials", "trials"),
         column(perceived, Field::value, "perceived_mass", "perceived mass", 2),
         column(perceived, Field::low, "low", "95 % low", 2),
         column(perceived, Field::high, "high", "high", 2),
         column(perceived, Field::why, "why", "none: why"),
         column(distance, Field::value, "distance", "from the next lighter", 2),
         column(distance, Field::low, "distance_low", "95 % low", 2),
         column(distance, Field::high, "distance_high", "high", 2),
         column(distance, Field::why, "distance_why")},
        "above the lightest cube, and above the next lighter one, in SDs of a difference of two "
        "percepts: two cubes at a distance of 0, 0.67, 1, 2 are sorted correctly in 50, 75, 84, "
        "98 % of answered trials. Maximum likelihood over all orders; intervals over participants.",
        TablePlace::results,
        "perceived_mass[]"};
    EstimateTable contrasts{
        "perceived_mass_contrasts",
        "Differences of perceived masses between conditions",
        {key_column("condition", "condition"), key_column("other_condition", "less condition"),
         key_column("mass_g", "mass g"), column(contrast, Field::n, "n", "n"),
         column(contrast, Field::value, "difference", "difference", 2),
         column(contrast, Field::low, "low", "95 % low", 2),
         column(contrast, Field::high, "high", "high", 2),
         column(smallest_contrast, Field::value, "smallest_difference", "detectable", 2)},
        "of perceived masses above the same lightest cube, in SDs of a difference of two percepts; "
        "participants are compared with themselves where they sorted in both. Detectable: the "
        "smallest difference that 80 % of studies of this size and spread would find."};
    return {table, contrasts};
  }

  std::vector<ChartSpec> charts() const override {
    return {{.name = "perceived_mass",
             .title = "Perceived mass of sorted cubes, 95 % intervals",
             .caption = "Perceived mass above that of the lightest cube, in SDs of a difference of "
                        "two percepts (Thurstone's case V), where the orders identify it.",
             .csv = "perceived_mass.csv",
             .importance = 47,
             .series = {{&perceived}},
             .x = "mass_g",
             .split = {"condition"},
             .x_label = "mass (g)",
             .y_label = "perceived mass (SD)"}};
  }

 private:
  using Perceived = std::map<double, PerceivedStimulus>;  // by mass

  static void put_contrasts(Estimates& all, const std::pair<const std::string, Perceived>& from,
                            const std::pair<const std::string, Perceived>& to) {
    if (from.second.empty() || to.second.empty() ||
        from.second.begin()->first != to.second.begin()->first)
      return;
    for (const auto& [mass_g, there] : to.second) {
      const auto here = from.second.find(mass_g);
      if (here == from.second.end() || here->second.from_lowest.influence.empty() ||
          there.from_lowest.influence.empty())
        continue;
      const Contrast found = perceived_contrast(here->second.from_lowest, there.from_lowest);
      StudyEstimate one{&contrast, "sorting", to.first};
      one.by = {{"other_condition", from.first}, at("mass_g", mass_g)};
      one.n = found.n;
      one.value = found.value;
      one.set(found.interval());
      one.method = "jackknife over participants";
      all.push_back(one);
      one.measure = &smallest_contrast;
      one.value = found.smallest_effect();
      one.low = one.high = std::nullopt;
      all.push_back(one);
    }
  }

  static void put(Estimates& all, const std::string& condition, const Sorted& sorted,
                  const Perceived& stimuli) {
    const auto put_one = [&](const Measure& measure, double mass_g,
                             const PerceivedDistance& found) {
      StudyEstimate& one = all.emplace_back(StudyEstimate{&measure, "sorting", condition});
      one.by = {at("mass_g", mass_g)};
      one.value = found.value;
      one.set(found.interval);
      one.n = found.n;
      one.n_trials = sorted.n_answered.at(mass_g);
      one.method = "maximum likelihood";
      one.why = found.why;
    };
    for (const auto& [mass_g, n] : sorted.n_answered) {
      const auto found = stimuli.find(mass_g);
      if (found == stimuli.end()) {
        put_one(perceived, mass_g, {.why = "no trial with this cube was answered"});
        continue;
      }
      put_one(perceived, mass_g, found->second.from_lowest);
      if (found != stimuli.begin()) put_one(distance, mass_g, found->second.from_previous);
    }
  }

  std::map<std::string, Sorted> conditions_;
};
}  // namespace

std::shared_ptr<Section> perceived_mass_section() {
  return std::make_shared<PerceivedMassSection>();
}

}  // namespace heft
