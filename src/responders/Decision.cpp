#include "responders/Decision.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "responders/Responder.h"

namespace heft {

Decision::Decision(const ResponderParameters& parameters, std::uint64_t seed,
                   const TrialView& trial)
    : parameters_(parameters), task_(trial.task), stream_(trial_stream(seed, "decision", trial)) {}

Answer Decision::decide(std::span<const double> percepts_mm, std::span<const int> wrong_slots) {
  std::vector<double> remembered = remembered_mm(percepts_mm);
  const bool lapse = stream_.coin(parameters_.lapse_rate);
  // A lapse answers as if something else had been seen; all of it equally likely.
  if (lapse)
    for (double& value : remembered) value = stream_.uniform();
  switch (task_) {
    case Task::comparison:
      return compare(remembered, lapse);
    case Task::sorting:
      return sort(remembered, lapse);
    case Task::introduction:
      break;
  }
  return {.slot = heaviest_slot(remembered, wrong_slots), .labels = {}};
}

// Noise in proportion to the percept, and some that is there even when nothing was seen.
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
  const auto [least, most] = std::ranges::minmax(remembered_mm);
  return most - least >
         parameters_.criterion_mm + parameters_.criterion_fraction * std::max(0.0, most);
}

Answer Decision::compare(std::span<const double> remembered_mm, bool lapse) {
  // One of n cubes or none of them, equally likely.
  const bool different =
      lapse ? stream_.below(remembered_mm.size() + 1) > 0 : differ(remembered_mm);
  if (!different) return {};
  return {.slot = heaviest_slot(remembered_mm, {}), .labels = {}};
}

Answer Decision::sort(std::span<const double> remembered_mm, bool lapse) {
  const bool guess = stream_.coin(parameters_.guess_probability);
  const bool corrected = stream_.coin(parameters_.correction_probability);
  if (!lapse && !guess && !differ(remembered_mm)) return {};
  return {.slot = {}, .labels = labels_in_order(remembered_mm), .first_label_corrected = corrected};
}

int heaviest_slot(std::span<const double> values, std::span<const int> wrong_slots) {
  const auto ruled_out = wrong_slots.last(std::min(wrong_slots.size(), values.size() - 1));
  int best_slot = 0;
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int slot = static_cast<int>(i) + 1;
    if (std::ranges::find(ruled_out, slot) != ruled_out.end() || values[i] <= best) continue;
    best_slot = slot;
    best = values[i];
  }
  return best_slot;
}

std::vector<Label> labels_in_order(std::span<const double> values) {
  std::vector<std::size_t> from_lightest(values.size());
  std::iota(from_lightest.begin(), from_lightest.end(), std::size_t{0});
  std::ranges::stable_sort(from_lightest, {}, [&](std::size_t i) { return values[i]; });
  const auto from_lightest_on = labels_for(static_cast<int>(values.size()));
  std::vector<Label> labels(values.size());
  for (std::size_t rank = 0; rank < labels.size(); ++rank)
    labels[from_lightest[rank]] = from_lightest_on[rank];
  return labels;
}

}  // namespace heft
