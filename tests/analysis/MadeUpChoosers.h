// Simulated people with known parameters, in comparisons as the protocols run them.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "MadeUpSessions.h"
#include "base/Random.h"
#include "psychophysics/UpDown.h"

namespace heft::made_up {

/// One person: see MixedIndecision.h for the model.
struct Chooser {
  double sensitivity_per_g = 0;  ///< 0: sees nothing
  double indecision = 1, side_bias = 0;
  bool is_coin = false;  ///< always says that there is a difference
  double lapse_rate = 0.02;
  /// The indecision at the end of the comparisons, over that at their start.
  double growth = 1;

  /// @param part of the comparisons that are done, 0...1
  Chooser at(double part) const {
    Chooser now = *this;
    now.indecision *= std::pow(growth, part - 0.5);
    return now;
  }

  /// 0: left, 1: none, 2: right
  int answer(double right_minus_left_g, RandomStream& stream) const {
    if (is_coin) return stream.coin(0.5) ? 0 : 2;
    if (stream.coin(lapse_rate)) return static_cast<int>(stream.below(3));
    const double felt = sensitivity_per_g * right_minus_left_g + side_bias + stream.normal();
    return felt > indecision ? 2 : felt < -indecision ? 0 : 1;
  }
};

/// People around a 75 % threshold; none (0): they see nothing.
struct Population {
  double threshold_75_g = 0, spread = 0.3, indecision = 1;
  bool is_coin = false;

  double lapse_rate = 0.02;
  double correlation = 0;  ///< of the logarithms of sensitivity and indecision
  double growth = 1;       ///< see Chooser

  Chooser draw(RandomStream& stream) const {
    const double median = threshold_75_g > 0 ? 0.6744897501960817 / threshold_75_g : 0;
    const double of_s = stream.normal(), own = stream.normal(), of_bias = stream.normal();
    const double of_tau = correlation * of_s + std::sqrt(1 - correlation * correlation) * own;
    return {median * std::exp(spread * of_s),
            indecision * std::exp(0.4 * of_tau),
            0.2 * of_bias,
            is_coin,
            lapse_rate,
            growth};
  }
};

struct ComparisonDesign {
  double reference_g = 200;
  std::vector<double> starts_g{600, 20};  ///< of a staircase each
  double step_g = 150;
  int stop_reversals = 8;
  double catch_fraction = 0.15;
  bool only_right_choices = true;  ///< move a staircase down
};

inline ComparisonDesign paired_at(double reference_g) {
  if (reference_g < 100) return {reference_g, {175, 10}, 50};
  if (reference_g < 500) return {reference_g, {600, 20}, 150};
  return {reference_g, {700, 20}, 200};
}

inline ComparisonDesign papers_at(double reference_g) {
  ComparisonDesign design = paired_at(reference_g);
  design.starts_g.pop_back();
  design.stop_reversals = 10;
  design.catch_fraction = 0;
  design.only_right_choices = false;
  return design;
}

/// Gives a planned comparison an answer of Chooser::answer.
inline void answer(Attempt& attempt, int given) {
  TrialRow& trial = attempt.trial;
  trial.outcome = given == 1 ? "no_difference" : "difference";
  if (given == 1) return;
  trial.chosen_slot = given == 0 ? 1 : 2;
  const bool names_comparison = *trial.chosen_slot != trial.plan.reference_slot;
  trial.choice_correct = *trial.plan.level_g != 0 && names_comparison == (*trial.plan.level_g > 0);
}

/// Adds the trials and estimates of one person's comparisons at one reference.
inline void compare(SessionData& data, const Chooser& chooser, const ComparisonDesign& design,
                    RandomStream& stream) {
  const auto name_of = [&design](std::size_t index) {
    return std::to_string(static_cast<int>(design.reference_g)) + "g " + std::to_string(index);
  };
  std::vector<UpDown> staircases;
  for (double start_g : design.starts_g) {
    UpDownConfig config;
    config.start = start_g;
    config.step = design.step_g;
    config.halve_every = 2;
    config.floor = 0;
    config.ceiling = 1500;
    config.stop_reversals = design.stop_reversals;
    config.stop_trials = 60;
    const std::string name = name_of(staircases.size());
    staircases.emplace_back(config);
    data.staircases[name] = {std::make_shared<const Procedure>(name, config),
                             design.only_right_choices};
  }
  constexpr double usual_trials = 40;
  for (int n_trials = 0;;) {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < staircases.size(); ++i)
      if (!staircases[i].finished()) open.push_back(i);
    if (open.empty()) break;
    const bool is_catch = stream.coin(design.catch_fraction);
    const std::size_t index = open[stream.below(open.size())];
    const double level_g = is_catch ? 0 : staircases[index].level();
    const int reference_slot = stream.coin(0.5) ? 1 : 2;
    const Chooser now = chooser.at(std::min(1.0, n_trials++ / usual_trials));
    const int given = now.answer(reference_slot == 1 ? level_g : -level_g, stream);
    const std::string name = name_of(index);
    Attempt& attempt = add_comparison(data, is_catch ? "" : name, design.reference_g, level_g);
    attempt.trial.plan.is_catch = is_catch;
    attempt.trial.plan.reference_slot = reference_slot;
    answer(attempt, given);
    if (is_catch) continue;
    const bool right = attempt.trial.choice_correct.value_or(false);
    const Update update = staircases[index].respond(design.only_right_choices ? right : given != 1);
    attempt.is_reversal = update.reversal.has_value();
    if (!update.finish) continue;
    data.estimates.push_back(row_of(name, staircases[index].estimates().at(0), *update.finish));
  }
}

/// @param people who were drawn
inline std::vector<SessionData> study(int n_people, const Population& population,
                                      const std::vector<ComparisonDesign>& designs,
                                      RandomStream& stream,
                                      std::vector<Chooser>* people = nullptr) {
  std::vector<SessionData> sessions;
  for (int i = 0; i < n_people; ++i) {
    sessions.push_back(session(i + 1, std::to_string(100 + i)));
    const Chooser chooser = population.draw(stream);
    if (people) people->push_back(chooser);
    for (const ComparisonDesign& design : designs)
      compare(sessions.back(), chooser, design, stream);
  }
  return sessions;
}

}  // namespace heft::made_up
