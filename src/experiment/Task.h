// The vocabulary of trials: tasks, conditions, labels, actions, outcomes, with the names they have
// in protocols and logs.
#pragma once

#include "base/Names.h"

namespace heft {

enum class Task { introduction, sorting, comparison };
template <>
struct EnumNames<Task> {
  static constexpr std::array<std::string_view, 3> names{"introduction", "sorting", "comparison"};
};

/// C1: the effector clone stays coupled to the real effector. C2: it is decoupled (paper, 4.1).
enum class Condition { C1, C2 };
template <>
struct EnumNames<Condition> {
  static constexpr std::array<std::string_view, 2> names{"C1", "C2"};
};

enum class Label { lightest, intermediate, heaviest };
template <>
struct EnumNames<Label> {
  static constexpr std::array<std::string_view, 3> names{"lightest", "intermediate", "heaviest"};
};

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
