// The possible answers to comparisons and judgments, as far as the analysis of a log needs them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/Names.h"
#include "experiment/ScreenTexts.h"

namespace heft {

/// The possible answers to a comparison.
///
/// - heavier_or_none: the heavier cube, or no difference (the paper).
/// - heavier: a cube (forced choice). The response to every procedure is "the comparison was
///   chosen": a correct choice if the comparison is heavier, an incorrect one if it is lighter. So
///   levels of both signs make one psychometric function.
/// - same_different: whether the cubes are equally heavy. The response is "different", for levels
///   of either sign.
enum class ComparisonAnswers { heavier_or_none, heavier, same_different };
template <>
struct EnumNames<ComparisonAnswers> {
  static constexpr std::array<std::string_view, 3> names{"heavier_or_none", "heavier",
                                                         "same_different"};
};

/// Response to a procedure that a choice in a judgment stands for: positive or negative, or the
/// heavier cube; none: neither cube.
enum class Meaning { positive, negative, left, right, none };
template <>
struct EnumNames<Meaning> {
  static constexpr std::array<std::string_view, 5> names{"positive", "negative", "left", "right",
                                                         "none"};
};

/// Meanings of choices, by their values.
using Meanings = std::vector<std::pair<std::string, Meaning>>;

/// @param choice null: no answer  @return none: it has no meaning
std::optional<Meaning> meaning_of(const Meanings& responses, const AnswerChoice* choice);

/// The question of a judgment, and the responses that its choices stand for.
struct JudgmentOffer {
  FormQuestion question;
  Meanings responses = {};  ///< empty: there is no procedure
};

}  // namespace heft
