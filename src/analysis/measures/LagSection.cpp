// How far the clone lagged behind the hand and turned against it, by mass: what people saw.
#include <cmath>
#include <deque>

#include "analysis/measures/Section.h"

namespace heft {

namespace {
constexpr Measure lag{
    "lag", "mm", "lag",
    "largest distance of the clone from the effector while it touched a cube, as "
    "displayed, and its upper bound, the path of the hand since the touch began: median "
    "over cubes and trials, quartiles as low and high"};

constexpr Measure yaw{
    "clone_yaw", "deg", "turn of the clone",
    "largest turn of the clone against the effector about its vertical axis while it touched a "
    "cube, in frames that were kept: median over cubes and trials, quartiles as low and high"};

class LagSection final : public Section {
 public:
  void add(const SessionData& data) override {
    for (const Attempt& attempt : data.attempts) {
      if (!attempt.completed()) continue;
      const std::string& condition = attempt.trial.plan.condition;
      for (const CubeRow& cube : attempt.cubes) {
        if (!(cube.mass_g > 0)) continue;
        // Five bands a decade, called by their middle.
        const double mass_g = std::pow(10, std::round(5 * std::log10(cube.mass_g)) / 5);
        if (const auto turn = attempt.clone_yaw_deg.find(cube.slot);
            turn != attempt.clone_yaw_deg.end()) {
          yaw_deg_[condition][mass_g].push_back(turn->second);
          turns_ = turns_ || turn->second > visible_deg;
        }
        if (!cube.peak_lag_m) continue;
        values_mm_[{condition, condition}][mass_g].push_back(1e3 * *cube.peak_lag_m);
        if (cube.max_push_displacement_m)
          values_mm_[{condition, condition + ", the hand's way"}][mass_g].push_back(
              1e3 * *cube.max_push_displacement_m);
      }
    }
  }

  void put(Summary& summary) override {
    for (const auto& [of, masses] : values_mm_)
      for (const auto& [mass_g, values] : masses) {
        StudyEstimate estimate = quartiles_estimate(lag, values);
        estimate.condition = of.first;
        estimate.n = summary.n_participants;
        estimate.by = {{"group", of.second}, at("mass_g", mass_g)};
        summary.estimates.push_back(std::move(estimate));
      }
    for (const auto& [condition, masses] : yaw_deg_)
      for (const auto& [mass_g, values] : masses) {
        if (!turns_) continue;
        StudyEstimate estimate = quartiles_estimate(yaw, values);
        estimate.condition = condition;
        estimate.n = summary.n_participants;
        estimate.by = {at("mass_g", mass_g)};
        summary.estimates.push_back(std::move(estimate));
      }
    values_mm_.clear();
    yaw_deg_.clear();
  }

  std::vector<EstimateTable> tables() const override {
    EstimateTable table{"lag_by_mass",
                        "Largest lag by mass, and the hand's way",
                        {key_column("group", "group"), key_column("mass_g", "mass g")},
                        "",
                        TablePlace::csv};
    add_quartiles(table.columns, lag);
    EstimateTable turns{"clone_yaw_by_mass",
                        "Largest turn of the clone against the hand, by mass",
                        {key_column("condition", "condition"), key_column("mass_g", "mass g")},
                        "",
                        TablePlace::csv};
    add_quartiles(turns.columns, yaw);
    return {table, turns};
  }

  std::vector<ChartSpec> charts() const override {
    return {
        {.name = "lag_by_mass",
         .title = "Lag seen, by mass",
         .caption = "Largest distance of the clone from the effector while it touched a cube, as "
                    "displayed: median and quartiles over cubes and trials; beside it how far the "
                    "hand went from where the touch began: a lag comes to about that and no more. "
                    "Masses in five bands a decade.",
         .csv = "lag_by_mass.csv",
         .shape = ChartShape::lines,
         .importance = 75,
         .series = {{&lag}},
         .x = "mass_g",
         .split = {"group"},
         .x_label = "mass (g)",
         .y_label = "mm",
         .axes = "set logscale x\nset yrange [0:*]\n"},
        {.name = "clone_yaw_by_mass",
         .title = "Turn of the clone seen, by mass",
         .caption = "Largest turn of the clone against the hand about its vertical axis while "
                    "it touched a cube, as displayed: pushes beside a cube's middle turn a "
                    "clone on a soft torsional spring. Median and quartiles over cubes and "
                    "trials. Masses in five bands a decade.",
         .csv = "clone_yaw_by_mass.csv",
         .shape = ChartShape::lines,
         .importance = 76,
         .series = {{&yaw}},
         .x = "mass_g",
         .split = {"condition"},
         .x_label = "mass (g)",
         .y_label = "degrees",
         .axes = "set logscale x\nset yrange [0:*]\n"}};
  }

 private:
  using Group = std::pair<std::string, std::string>;  // condition, what
  using ByMass = std::map<double, std::deque<double>>;
  // A spring that locks the orientation turns by less.
  static constexpr double visible_deg = 0.1;
  std::map<Group, ByMass> values_mm_;
  std::map<std::string, ByMass> yaw_deg_;  // by condition
  bool turns_ = false;                     // by more than visible_deg in some trial
};
}  // namespace

std::shared_ptr<Section> lag_section() {
  return std::make_shared<LagSection>();
}

}  // namespace heft
