// The sorting task: how many trials were sorted correctly, incorrectly or not at all, and which
// cubes were taken for each other.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
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

  /// How many of its trials a random order gets right on average; none without trials.
  std::optional<double> chance_percent() const;
};

/// Completed trials by condition. A participant's sessions count together. The paper's figures are
/// beside where all cubes have the paper's masses.
class SortingFold {
 public:
  void add(const SessionData& data);
  /// The paper's conditions first, there or not; others as they came.
  std::vector<ConditionSorting> result() const;

 private:
  struct Counted {
    Tallies correct, incorrect, none, answered_correct, answered_incorrect;
    std::array<int, 4> swaps{};
    std::map<int, int> n_trials_by_cubes;
    bool as_published = true;
  };
  static void count(Counted& counted, const std::string& participant, const Attempt& attempt);
  static ConditionSorting sorting_in(const std::string& condition, const Counted& counted);
  Counted& counted_in(const std::string& condition);

  std::vector<std::pair<std::string, Counted>> conditions_{{"C1", {}}, {"C2", {}}};
};

inline std::vector<ConditionSorting> sorting_of(std::span<const SessionData> sessions) {
  return folded<SortingFold>(sessions);
}

}  // namespace heft
