#include "population/Tuning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/Parallel.h"
#include "base/Random.h"
#include "inference/Fit.h"
#include "population/LoggedAnswers.h"
#include "psychophysics/Constant.h"
#include "responders/ResponderParameters.h"
#include "tasks/Comparison.h"

namespace heft {

namespace {
// Comparison minus reference, as fractions of the reference.
constexpr std::array differences{-0.8, -0.4, -0.2, -0.1, -0.05, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6};

// n numbers, evenly spaced in logarithms, rounded to that many significant digits.
std::vector<double> between(double low, double high, int n, int digits) {
  std::vector<double> all;
  for (int i = 0; i < n; ++i) {
    const double part = n == 1 ? 0.5 : static_cast<double>(i) / (n - 1);
    all.push_back(std::stod(fmt::format("{:.{}g}", low * std::pow(high / low, part), digits)));
  }
  return all;
}

Protocol protocol_for(const TuningRequest& request, const Technique& technique, double mass_g) {
  Comparison::Block block;
  block.name = "comparison";
  block.condition = technique.name;
  block.answers = ComparisonAnswers::heavier;
  std::vector<double> levels_g;
  for (const double difference : differences) levels_g.push_back(difference * mass_g);
  block.staircases.push_back(
      {mass_g, Procedure("levels", ConstantConfig{levels_g, request.repeats})});
  Protocol protocol = request.protocol;
  protocol.techniques = {technique};
  protocol.blocks = {TaskBlock(block)};
  protocol.screens.questionnaires.clear();
  return protocol;
}

// Answers "the reference" and "the comparison", by level.
AnswersByLevel choices_of(const AnswerCounts& counts) {
  AnswersByLevel choices;
  for (const auto& [stimulus, answers] : counts)
    for (const auto& [answer, n] : answers)
      choices[*stimulus.level_g][answer.is_correct == (*stimulus.level_g > 0) ? 1 : 0] += n;
  return choices;
}

ThresholdAtMass threshold_of(const TuningRequest& request, const Technique& technique,
                             double mass_g) {
  const std::uint64_t seed =
      RandomStream(request.seed, "tuning", static_cast<std::uint64_t>(mass_g * 1000)).bits() >> 1;
  const ResolvedConfig config =
      resolve(request.session, protocol_for(request, technique, mass_g), seed);
  ResponderOptions median = config->model.options;
  median.seed = seed;
  if (find_row("participant_spread", config->model.entry->parts))
    median.parameters.push_back({"participant_spread", 0.0, {}});
  const auto person = config->model.entry->make(median);
  const AnswersByLevel choices = choices_of(answers_of_one(config, *person, seed));
  const ForcedChoiceFit fit = fit_forced_choice(choices);
  if (!fit.why.empty()) return {mass_g, {}, {}, {}, fit.why};
  return {mass_g, fit.threshold.value, fit.threshold.low, fit.threshold.high, ""};
}
}  // namespace

std::optional<double> TunedTechnique::worst() const {
  double most = 0;
  for (const ThresholdAtMass& one : masses) {
    if (!one.threshold_g) return std::nullopt;
    most = std::max(most, one.ratio());
  }
  return most;
}

std::vector<Technique> springs_between(double low_n_per_m, double high_n_per_m, int n,
                                       const Coupling& others) {
  std::vector<Technique> all;
  for (const double stiffness : between(low_n_per_m, high_n_per_m, n, 2)) {
    Coupling coupling = others;
    coupling.decoupled = true;
    coupling.stiffness_n_per_m = stiffness;
    all.push_back({fmt::format("spring {:g} N/m", coupling.stiffness_n_per_m), coupling});
  }
  return all;
}

std::vector<double> masses_between(double low_g, double high_g, int n) {
  return between(low_g, high_g, n, 3);
}

std::optional<std::vector<TunedTechnique>> thresholds_of(
    const TuningRequest& request, const std::function<void(double)>& progress,
    const std::atomic<bool>& stop) {
  std::vector<TunedTechnique> all;
  for (const Technique& technique : request.techniques)
    all.push_back({technique, std::vector<ThresholdAtMass>(request.masses_g.size())});
  const std::size_t n_masses = request.masses_g.size();
  const auto work = [&](int i) {
    const std::size_t technique = static_cast<std::size_t>(i) / n_masses,
                      mass = static_cast<std::size_t>(i) % n_masses;
    if (!stop)
      all[technique].masses[mass] =
          threshold_of(request, request.techniques[technique], request.masses_g[mass]);
    return !stop;
  };
  if (!run_jobs(static_cast<int>(all.size() * n_masses), request.jobs, work, progress))
    return std::nullopt;
  return all;
}

const TunedTechnique* best_of(const std::vector<TunedTechnique>& all) {
  const TunedTechnique* best = nullptr;
  for (const TunedTechnique& one : all)
    if (one.worst() && (!best || *one.worst() < *best->worst())) best = &one;
  return best;
}

}  // namespace heft
