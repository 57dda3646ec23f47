// The sorting task: how many trials were sorted correctly, incorrectly or not at all, and which
// cubes were taken for each other.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/Fold.h"
#include "experiment/Task.h"
#include "inference/Proportion.h"

namespace heft {

/// What is wrong in an incorrect sorting of three cubes: one pair exchanged, or all three moved on
/// in a cycle.
enum class Swap { light_intermediate, intermediate_heavy, light_heavy, all_three };
template <>
struct EnumNames<Swap> {
  static constexpr std::array<std::string_view, 4> names{"light_intermediate", "intermediate_heavy",
                                                         "light_heavy", "all_three"};
};

/// One of the n! orders of n cubes is right. @return percent
double chance_percent(int n_cubes);

/// The labels that the cubes bear after a trial's answers, by slot. A used label moves.
std::vector<std::optional<Label>> final_labels(std::span<const AnswerRow> answers, int n_slots);

/// @param masses_g, labels  of three cubes by slot
/// @return none where the order is correct, or there are not three differently labeled cubes
std::optional<Swap> swap_of(std::span<const double> masses_g,
                            std::span<const std::optional<Label>> labels);

struct ConditionSorting {
  std::string condition;
  int n_trials = 0;
  int n_participants = 0;
  Proportion correct, incorrect, none;  ///< of all completed trials; none: "I don't know"
  Proportion answered_correct, answered_incorrect;  ///< of the trials that were answered
  /// As answered_correct's, at 90 %: for the test of equivalence.
  std::optional<Interval> answered_correct_90_percent;
  std::array<int, 4> swaps{};            ///< by Swap, of the incorrect trials
  std::map<int, int> n_trials_by_cubes;  ///< number of cubes -> trials with so many
  Tallies correct_by_participant;
  /// Number of cubes -> labels given [cube][label], both from the lightest on.
  std::map<int, std::vector<std::vector<int>>> labels;
  /// The paper's condition that this is, where all cubes have the paper's masses.
  std::optional<published::Condition> published{};

  /// How many of its trials a random order gets right on average; none without trials.
  std::optional<double> chance_percent() const;
};

/// Completed trials by condition. A participant's sessions count together.
class SortingFold {
 public:
  void add(const SessionData& data);
  /// By name, of all conditions that a trial began in.
  std::vector<ConditionSorting> result() const;

 private:
  struct Counted {
    Tallies correct, incorrect, none, answered_correct, answered_incorrect;
    std::array<int, 4> swaps{};
    std::map<int, int> n_trials_by_cubes;
    std::map<int, std::vector<std::vector<int>>> labels;
    published::Comparable comparable;
  };
  static void count(Counted& counted, const std::string& participant, const Attempt& attempt);
  static ConditionSorting sorting_in(const std::string& condition, const Counted& counted);

  std::map<std::string, Counted> conditions_;
};

inline std::vector<ConditionSorting> sorting_of(std::span<const SessionData> sessions) {
  return folded<SortingFold>(sessions);
}

}  // namespace heft
