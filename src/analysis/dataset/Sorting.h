// Scoring of a sorting trial: the final labels of the cubes, the pair that was exchanged, and the
// confusion matrix.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "base/Names.h"
#include "experiment/Rows.h"
#include "experiment/TrialPlan.h"

namespace heft {

/// Error of an incorrect sorting of three cubes: one pair exchanged, or all three in a cycle.
enum class Swap { light_intermediate, intermediate_heavy, light_heavy, all_three };
template <>
struct EnumNames<Swap> {
  static constexpr std::array<std::string_view, 4> names{"light_intermediate", "intermediate_heavy",
                                                         "light_heavy", "all_three"};
};

/// One of the n! orders of n cubes is right. @return percent
double chance_percent(int n_cubes);

/// The labels of the cubes after a trial's answers, by slot. A used label moves.
std::vector<std::optional<Label>> final_labels(std::span<const AnswerRow> answers, int n_slots);

/// @param masses_g, labels  of three cubes by slot
/// @return none where the order is correct, or there are not three differently labeled cubes
std::optional<Swap> swap_of(std::span<const double> masses_g,
                            std::span<const std::optional<Label>> labels);

/// Number of cubes -> labels given [cube][label], both from the lightest on.
using LabelMatrices = std::map<int, std::vector<std::vector<int>>>;

/// Counts a trial's labels by the rank of their cubes. @param masses_g, given  by slot
void count_labels(LabelMatrices& matrices, std::span<const double> masses_g,
                  std::span<const std::optional<Label>> given);

}  // namespace heft
