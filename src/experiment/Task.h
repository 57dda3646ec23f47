// The vocabulary of trials: tasks, labels, actions, outcomes, with the names they have
// in protocols and logs.
#pragma once

#include <array>
#include <span>

#include "base/Names.h"

namespace heft {

enum class Task { introduction, sorting, comparison };
template <>
struct EnumNames<Task> {
  static constexpr std::array<std::string_view, 3> names{"introduction", "sorting", "comparison"};
};

/// What a sorting trial asks to be told of each cube: with three cubes the words, otherwise ranks,
/// 1 the lightest.
enum class Label {
  lightest,
  intermediate,
  heaviest,
  rank_1,
  rank_2,
  rank_3,
  rank_4,
  rank_5,
  rank_6
};
template <>
struct EnumNames<Label> {
  static constexpr std::array<std::string_view, 9> names{
      "lightest", "intermediate", "heaviest", "1", "2", "3", "4", "5", "6"};
};

/// The labels of a sorting trial with so many cubes, from the lightest on.
inline std::span<const Label> labels_for(int n_cubes) {
  static constexpr std::array words{Label::lightest, Label::intermediate, Label::heaviest};
  static constexpr std::array ranks{Label::rank_1, Label::rank_2, Label::rank_3,
                                    Label::rank_4, Label::rank_5, Label::rank_6};
  if (n_cubes == static_cast<int>(words.size())) return words;
  return std::span(ranks).first(static_cast<std::size_t>(n_cubes));
}

enum class ActionKind { select, label, unlabel, validate, dont_know, no_difference };
template <>
struct EnumNames<ActionKind> {
  static constexpr std::array<std::string_view, 6> names{"select",   "label",     "unlabel",
                                                         "validate", "dont_know", "no_difference"};
};

enum class TrialStatus { open, completed, voided };
template <>
struct EnumNames<TrialStatus> {
  static constexpr std::array<std::string_view, 3> names{"open", "completed", "void"};
};

enum class Outcome { correct, incorrect, dont_know, difference, no_difference };
template <>
struct EnumNames<Outcome> {
  static constexpr std::array<std::string_view, 5> names{"correct", "incorrect", "dont_know",
                                                         "difference", "no_difference"};
};

}  // namespace heft
