#include "responders/decision/Decision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/Random.h"
#include "responders/Responder.h"

namespace heft {

namespace {
// An autoregressive drift of the criterion up to a trial, from one draw for each trial before, so
// that nothing has to be remembered.
double drift_mm(const ResponderParameters& parameters, std::uint64_t seed, int trial_number) {
  double drift = 0;
  for (int trial = 1; trial <= trial_number; ++trial)
    drift = parameters.criterion_persistence * drift +
            RandomStream(seed, "criterion drift", static_cast<std::uint64_t>(trial)).normal();
  return parameters.criterion_drift_mm * drift;
}
}  // namespace

Decision::Decision(const ResponderParameters& parameters, std::uint64_t seed,
                   const TrialView& trial)
    : parameters_(parameters),
      task_(trial.task),
      offer_(trial.offer),
      lifted_g_(trial.lifted_g),
      stream_(trial_stream(seed, "decision", trial)) {
  double& criterion_mm = parameters_.criterion_mm;
  if (parameters.criterion_drift_mm > 0)
    criterion_mm += drift_mm(parameters, seed, trial.trial_number);
  if (trial.last_differed)
    criterion_mm += *trial.last_differed ? -parameters.repetition_mm : parameters.repetition_mm;
}

Answer Decision::decide(std::span<const double> percepts_mm, std::span<const int> wrong_slots) {
  std::vector<double> all_mm(percepts_mm.begin(), percepts_mm.end());
  if (lifted_g_) all_mm.push_back(mm_per_g * *lifted_g_);
  Percepts percepts{.remembered_mm = remembered_mm(all_mm),
                    .lapse = stream_.coin(parameters_.lapse_rate),
                    .guess_probability = parameters_.guess_probability,
                    .correction_probability = parameters_.correction_probability,
                    .wrong_slots = wrong_slots};
  // A lapse answers as for another percept; all answers are equally likely.
  if (percepts.lapse)
    for (double& value : percepts.remembered_mm) value = stream_.uniform();
  percepts.differ = differ(percepts.remembered_mm);
  return simulated_answer(task_, offer_, percepts, stream_);
}

// Noise proportional to the percept plus constant noise.
std::vector<double> Decision::remembered_mm(std::span<const double> percepts_mm) {
  std::vector<double> remembered;
  for (double percept : percepts_mm) {
    const double noise_mm =
        std::hypot(parameters_.judgment_noise_mm, parameters_.memory_noise * percept);
    remembered.push_back(percept + noise_mm * stream_.normal());
  }
  return remembered;
}

bool Decision::differ(std::span<const double> remembered_mm) const {
  const auto [smallest, largest] = std::ranges::minmax(remembered_mm);
  return largest - smallest >
         parameters_.criterion_mm + parameters_.criterion_fraction * std::max(0.0, largest);
}

Answer blind_answer(const TrialView& trial, const WithoutPercepts& unseen, RandomStream& stream) {
  return blind_answer(trial.task, trial.offer, unseen, stream);
}

namespace {
std::string any_whole_number(double least, double most, RandomStream& stream) {
  const double from = std::ceil(least), n = std::floor(most) - from + 1;
  if (n < 1) return fmt::format("{}", least);
  return fmt::format("{:.0f}",
                     from + static_cast<double>(stream.below(static_cast<std::uint64_t>(n))));
}
}  // namespace

std::optional<std::string> any_answer_to(const FormQuestion& question, std::uint64_t seed,
                                         const std::string& key) {
  RandomStream stream(seed, "questionnaire " + key);
  switch (question.kind) {
    case QuestionKind::choice:
      return question.choices.at(stream.below(question.choices.size())).value;
    case QuestionKind::likert:
      return any_whole_number(question.from, question.to, stream);
    case QuestionKind::slider:
      return any_whole_number(0, 100, stream);
    case QuestionKind::number:
      return any_whole_number(question.least, question.most, stream);
    case QuestionKind::text:
      break;
  }
  return std::nullopt;
}

}  // namespace heft
