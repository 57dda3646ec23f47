// The words of trials, as protocols and logs write them: tasks and what they bring (labels,
// actions, outcomes), which src/tasks declares; and what becomes of an attempt.
#pragma once

#include <string>
#include <string_view>

#include "base/Names.h"

namespace heft {

/// A word of one of the tasks' lists. Words of different lists are different types.
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
/// What a trial asks to be said of a cube.
using Label = Word<struct LabelList>;
/// What a participant does.
using ActionKind = Word<struct ActionList>;
/// What a trial's answer was.
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

}  // namespace heft
