#include <cmath>

#include "psychophysics/ResponseModel.h"
#include "results/procedures/ProceduresStudy.h"

namespace heft {

namespace {
constexpr double change_ends = 100;  // trial
constexpr auto all_observers = std::to_array<Observer>({
    {.name = "typical"},
    {.name = "threshold 70 g", .threshold_g = 70},
    {.name = "threshold 280 g", .threshold_g = 280},
    {.name = "threshold 3 times smaller than expected", .threshold_g = 47},
    {.name = "threshold 3 times larger than expected", .threshold_g = 420},
    {.name = "criterion 0", .criterion_sd = 0},
    {.name = "criterion 0.3 SD", .criterion_sd = 0.3},
    {.name = "criterion 1.28 SD (false alarms 20 %)", .criterion_sd = 1.28},
    {.name = "criterion 1.96 SD (false alarms 5 %)", .criterion_sd = 1.96},
    {.name = "criterion 2.4 SD (false alarms 2 %)", .criterion_sd = 2.4},
    {.name = "no lapses", .lapse = 0},
    {.name = "lapses 5 %", .lapse = 0.05},
    {.name = "bias to the reference", .bias_sd = -0.5},
    {.name = "bias to the comparison", .bias_sd = 0.5},
    {.name = "criterion drifts 0.8 to 2.4 SD", .criterion_sd = 0.8, .later_criterion_sd = 2.4},
    {.name = "criterion drifts 2.4 to 0.8 SD", .criterion_sd = 2.4, .later_criterion_sd = 0.8},
    {.name = "tires: threshold 140 to 280 g", .later_threshold_g = 280},
    {.name = "learns: threshold 280 to 140 g", .threshold_g = 280, .later_threshold_g = 140},
    {.name = "lapses grow from 0 to 10 %", .lapse = 0, .later_lapse = 0.1},
    {.name = "280 g + false alarms 20 % + lapses 5 %",
     .threshold_g = 280,
     .criterion_sd = 1.28,
     .lapse = 0.05},
    {.name = "70 g + criterion 2.4 SD + bias",
     .threshold_g = 70,
     .criterion_sd = 2.4,
     .bias_sd = 0.5},
    {.name = "coin", .kind = Observer::Kind::coin},
    {.name = "always the comparison", .kind = Observer::Kind::always_heavier},
    {.name = "never a difference", .kind = Observer::Kind::never_different},
});

double share_of_change(int trial) {
  return std::min(trial / change_ends, 1.0);
}
}  // namespace

std::span<const Observer> study_observers() {
  return all_observers;
}

double Observer::threshold_in(int trial) const {
  const double later = later_threshold_g.value_or(threshold_g);
  return threshold_g * std::pow(later / threshold_g, share_of_change(trial));
}

double Observer::criterion_in(int trial) const {
  return std::lerp(criterion_sd, later_criterion_sd.value_or(criterion_sd), share_of_change(trial));
}

Choice Observer::answer(double level_g, int trial, AnswerSet answers, RandomStream& stream) const {
  const bool forced = answers == AnswerSet::forced_choice;
  const double criterion = forced ? 0 : criterion_in(trial);
  IndecisionShares shares{0, 0, 1};
  if (kind == Kind::coin) {
    shares = forced ? IndecisionShares{0.5, 0, 0.5} : IndecisionShares{1. / 3, 1. / 3, 1. / 3};
  } else if (kind == Kind::never_different) {  // a forced choice needs one: the reference
    shares = forced ? IndecisionShares{1, 0, 0} : IndecisionShares{0, 1, 0};
  } else if (kind == Kind::person) {
    const double lapses = std::lerp(lapse, later_lapse.value_or(lapse), share_of_change(trial));
    shares = indecision_shares(
        {threshold_75_times_sensitivity / threshold_in(trial), criterion, bias_sd, 0}, level_g);
    const double each = lapses / (forced ? 2 : 3);
    shares = {(1 - lapses) * shares.reference + each,
              (1 - lapses) * shares.none + (forced ? 0 : each),
              (1 - lapses) * shares.comparison + each};
  }
  const double drawn = stream.uniform();
  if (drawn < shares.comparison) return Choice::comparison;
  return drawn < shares.comparison + shares.reference || forced ? Choice::reference : Choice::none;
}

}  // namespace heft
