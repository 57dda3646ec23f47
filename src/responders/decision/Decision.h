// From percepts to an answer: what is remembered of them, a criterion, guesses and lapses. Knows
// neither frames nor the screen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/Random.h"
#include "responders/Responder.h"
#include "responders/ResponderParameters.h"

namespace heft {

class Decision {
 public:
  Decision(const ResponderParameters& parameters, std::uint64_t seed, const TrialView& trial);

  /// @param percepts_mm by cube, leftmost first
  /// @param wrong_slots chosen wrongly so far, oldest first, where the task asks again
  Answer decide(std::span<const double> percepts_mm, std::span<const int> wrong_slots);

 private:
  std::vector<double> remembered_mm(std::span<const double> percepts_mm);
  bool differ(std::span<const double> remembered_mm) const;

  ResponderParameters parameters_;
  Task task_;
  std::any offer_;
  RandomStream stream_;
};

/// What a mind that does not look says to a trial of any task.
Answer blind_answer(const TrialView& trial, const WithoutPercepts& unseen, RandomStream& stream);

}  // namespace heft
