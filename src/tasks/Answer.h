// What a participant has made up their mind to say of a trial, and what a simulated mind has to
// make it up from. Each task turns the one into the other.
#pragma once

#include <span>
#include <vector>

#include "experiment/Action.h"

namespace heft {

/// The actions of one answer, steps in order of the cubes; empty: no answer.
struct Answer {
  std::vector<Action> actions;
  bool first_step_corrected = false;  ///< the first label is put wrong and moved

  bool operator==(const Answer&) const = default;
};

/// What a simulated mind has of a trial when it answers.
struct Percepts {
  std::vector<double> remembered_mm;      ///< of the cue, by cube, leftmost first
  bool differ = false;                    ///< by more than its criterion
  bool lapse = false;                     ///< what is remembered are any numbers from 0 to 1
  double guess_probability = 0;           ///< of labels though nothing differs
  double correction_probability = 0;      ///< of a first label that is put wrong and moved
  std::span<const int> wrong_slots = {};  ///< chosen wrongly in this trial so far, oldest first
};

/// What a mind has that does not look: baselines.
struct WithoutPercepts {
  int n_slots = 0;
  bool differ = false;
  std::span<const int> wrong_slots = {};
};

/// Slot of the largest value among those not ruled out. All but the latest n - 1 wrong choices are
/// ruled in again: after as many the cubes must have been shuffled.
int heaviest_slot(std::span<const double> values, std::span<const int> wrong_slots);

}  // namespace heft
