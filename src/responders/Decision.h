// From percepts to an answer: what is remembered of them, a criterion, guesses and lapses. Knows
// neither frames nor the screen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/Random.h"
#include "experiment/Task.h"
#include "responders/Responder.h"
#include "responders/ResponderParameters.h"

namespace heft {

class Decision {
 public:
  Decision(const ResponderParameters& parameters, std::uint64_t seed, const TrialView& trial);

  /// @param percepts_mm by cube, leftmost first
  /// @param wrong_slots introduction: slots chosen wrongly so far, oldest first
  Answer decide(std::span<const double> percepts_mm, std::span<const int> wrong_slots);

 private:
  std::vector<double> remembered_mm(std::span<const double> percepts_mm);
  bool differ(std::span<const double> remembered_mm) const;
  Answer compare(std::span<const double> remembered_mm, bool lapse);
  Answer sort(std::span<const double> remembered_mm, bool lapse);

  ResponderParameters parameters_;
  Task task_;
  RandomStream stream_;
};

/// Slot of the largest value among those not ruled out. All but the latest n - 1 wrong choices are
/// ruled in again: after as many the cubes must have been shuffled.
int heaviest_slot(std::span<const double> values, std::span<const int> wrong_slots);

/// Labels by slot that put the values in order.
std::vector<Label> labels_in_order(std::span<const double> values);

}  // namespace heft
