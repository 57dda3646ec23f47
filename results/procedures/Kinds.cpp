// The procedures of the study, all set for a threshold of about 140 g at a reference of 200 g.
#include <cmath>

#include "psychophysics/ProcedureKinds.h"
#include "results/procedures/ProceduresStudy.h"

namespace heft {

namespace {
constexpr double heaviest_g = 600, lightest_g = -180, expected_g = 140;
constexpr int endless = 1000;  // trials

ValueGrid spaced(double from, double to, int n) {
  ValueGrid grid;
  for (int i = 0; i < n; ++i) grid.values.push_back(std::lerp(from, to, i / (n - 1.0)));
  return grid;
}

ValueGrid ratios(double from, double to, int n) {
  ValueGrid grid;
  for (int i = 0; i < n; ++i) grid.values.push_back(from * std::pow(to / from, i / (n - 1.0)));
  return grid;
}

UpDownConfig papers_staircase() {
  return {.start = 600,
          .step = 150,
          .halve_every = 2,
          .floor = 0,
          .stop_reversals = 8,
          .discard_reversals = 2};
}

// Kaernbach (1991): converges where upward steps times errors equal downward steps times successes.
UpDownConfig weighted_for_75_percent() {
  return {.start = 450,
          .steps = {50, 25, 12},
          .steps_up = {150, 75, 36},
          .floor = 0,
          .ceiling = heaviest_g,
          .stop_reversals = 8,
          .discard_reversals = 2};
}

UpDownConfig one_up_three_down() {
  return {.start = 450,
          .steps = {120, 60, 30},
          .down = 3,
          .floor = 5,
          .ceiling = heaviest_g,
          .stop_reversals = 8,
          .discard_reversals = 2};
}

ConstantConfig constant_stimuli() {
  return {.levels = {-160, -80, 0, 80, 160, 320}, .n_per_level = 20};
}

// Its slope at the threshold is that of the median person's curve of correct choices.
QuestConfig quest(double p_threshold, double gamma) {
  QuestConfig config;
  config.guess = expected_g;
  config.guess_sd = expected_g;
  config.p_threshold = p_threshold;
  config.beta = 0.004;
  config.delta = 0.02;
  config.gamma = gamma;
  config.grain = 4;
  config.range = 1600;
  config.floor = 0;
  config.ceiling = heaviest_g;
  config.stop_trials = endless;
  return config;
}

template <typename Config>
Config least_entropy(AnswerSet answers) {
  const bool forced = answers == AnswerSet::forced_choice;
  const double expected = threshold_75_times_sensitivity / expected_g;
  Config config;
  config.function = ResponseFunction::indecision;
  config.levels = spaced(lightest_g, heaviest_g, 40);
  config.sensitivity = ratios(expected / 8, 8 * expected, 33);
  config.indecision = forced ? ValueGrid{{0}} : spaced(0, 3, 13);
  config.bias = spaced(-0.6, 0.6, 5);
  config.lapse = {{0.02}};
  config.stop_trials = endless;
  return config;
}

PsiConfig psi(AnswerSet answers) {
  auto config = least_entropy<PsiConfig>(answers);
  config.nuisance = {"bias"};
  if (answers == AnswerSet::three_way) config.nuisance.emplace_back("indecision");
  return config;
}
}  // namespace

std::vector<StudiedProcedure> studied_procedures() {
  using enum AnswerSet;
  using Own = StudiedProcedure::Own;
  constexpr bool correct = true;
  const auto named = [](const auto& config) { return Procedure("studied", config); };
  return {
      {"1-up-1-down of differences (the paper's)", three_way, named(papers_staircase()), !correct,
       Own::reversals},
      {"1-up-1-down of correct choices", three_way, named(papers_staircase()), correct,
       Own::reversals},
      {"weighted up-down of correct choices", three_way, named(weighted_for_75_percent()), correct,
       Own::reversals},
      {"constant stimuli", three_way, named(constant_stimuli())},
      {"QUEST of correct choices", three_way, named(quest(0.5, 0.05)), correct, Own::posterior},
      {"QUEST+", three_way, named(least_entropy<QuestPlusConfig>(three_way)), !correct,
       Own::posterior},
      {"Psi", three_way, named(psi(three_way)), !correct, Own::posterior},
      {"1-up-3-down", forced_choice, named(one_up_three_down()), correct, Own::reversals},
      {"weighted up-down", forced_choice, named(weighted_for_75_percent()), correct,
       Own::reversals},
      {"constant stimuli", forced_choice, named(constant_stimuli())},
      {"QUEST", forced_choice, named(quest(0.75, 0.5)), correct, Own::posterior},
      {"QUEST+", forced_choice, named(least_entropy<QuestPlusConfig>(forced_choice)), correct,
       Own::posterior},
      {"Psi", forced_choice, named(psi(forced_choice)), correct, Own::posterior},
  };
}

}  // namespace heft
