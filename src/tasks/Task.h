// What a task declares about itself as data. Reader, engine, responders, recordings, log and
// exports take its words and the columns of its answers from here.
// What a participant has made up their mind to say of a trial, and what a simulated mind has to
// make it up from. Each task turns the one into the other.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

#include "experiment/EventPayloads.h"

namespace heft {

/// Something that a participant can do in a trial, and which columns it fills.
struct ActionSpec {
  std::string_view kind;
  bool slot = false, label = false, value = false;
  /// Part of an answer: it never ends a trial, and is taken before every cube was touched.
  bool is_step = false;
  /// Taken only once the steps before it are complete (ScreenState::can_validate).
  bool after_steps = false;
};

struct TaskDeclaration {
  std::string_view name;
  int edition = 1;         ///< counts what changes the meaning of its words
  std::string_view about;  ///< what is asked, for descriptions of exported data
  std::span<const ActionSpec> actions = {};
  std::span<const std::string_view> labels = {}, outcomes = {};
  double trial_s = 10;   ///< that a trial takes, for plans; the paper sets no limit, gives no times
  bool detects = false;  ///< an answer is "none" or says that the cubes differ

  /// @return null: the task has no such action
  constexpr const ActionSpec* action(std::string_view kind) const {
    const auto found = std::ranges::find(actions, kind, &ActionSpec::kind);
    return found == actions.end() ? nullptr : &*found;
  }
};

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
