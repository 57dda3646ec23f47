// The words of trials as protocols and logs write them, and the plan of an attempt at a trial.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/Names.h"
#include "base/SimulationChoices.h"

namespace heft {

/// A word of one of the tasks' lists (src/tasks). Words of different lists are different types.
template <typename List>
class Word : public std::string {
 public:
  using std::string::string;
  Word(std::string word) : std::string(std::move(word)) {}
  Word(std::string_view word) : std::string(word) {}
};

template <typename Type>
inline constexpr bool is_word = false;
template <typename List>
inline constexpr bool is_word<Word<List>> = true;

using Task = Word<struct TaskList>;
/// A label that the participant gives to a cube.
using Label = Word<struct LabelList>;
/// A kind of action of the participant.
using ActionKind = Word<struct ActionList>;
/// Outcome of a trial.
using Outcome = Word<struct OutcomeList>;

template <typename List>
std::string_view name_of(const Word<List>& word) {
  return word;
}

enum class TrialStatus { open, completed, voided };
template <>
struct EnumNames<TrialStatus> {
  static constexpr std::array<std::string_view, 3> names{"open", "completed", "void"};
};

/// One attempt at a trial, drawn by the engine. Secret, except for its number of slots.
struct TrialPlan {
  int trial_number = 0;  ///< of the planned trial, from 1; shared by its attempts
  int attempt = 1;       ///< from 1; +1 after a veto or a lost camera, unchanged after a crash
  std::string block;
  Task task;
  std::string condition = spring_technique;  ///< name of the technique
  std::string staircase;                     ///< empty: none (for example catch trials)
  std::optional<double> reference_g;         ///< none: nothing is compared with one
  std::optional<double> level_g;             ///< comparison - reference, as presented first
  bool is_catch = false;
  bool is_practice = false;
  std::vector<double> masses_g;        ///< by slot, leftmost first
  std::vector<double> table_friction;  ///< of each cube; empty: the protocol's friction
  std::optional<int> reference_slot;   ///< likewise; slots count from 1
  int n_reshuffles = 0;  ///< how often cubes were shuffled or replaced in this attempt

  /// Mass of a real object that is the reference, in the place after the cubes'; none: there is
  /// none.
  std::optional<double> real_reference_g() const {
    return reference_slot && *reference_slot > n_slots() ? reference_g : std::nullopt;
  }
  int n_slots() const { return static_cast<int>(masses_g.size()); }
};

}  // namespace heft
