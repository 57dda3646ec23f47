// A task as data (its declaration), answers, and lookups over the list of all tasks. Readers,
// engine, responders, recordings, log and exports use these and include no single task.
#pragma once

#include <algorithm>
#include <any>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "experiment/EventPayloads.h"

namespace heft {

class RandomStream;
struct ScreenState;

/// An action that a trial offers, and the columns that it fills.
struct ActionSpec {
  std::string_view kind;
  bool slot = false, label = false, value = false;
  /// A step of an answer: it never ends a trial and needs no contact with the cubes.
  bool is_step = false;
  /// Accepted only after all steps (ScreenState::can_validate).
  bool after_steps = false;
};

/// Another way to ask, by some of the task's blocks.
struct Wording {
  std::string_view name;        ///< its instructions are the key "text_NAME" of their page
  std::string_view texts = {};  ///< further keys of the task's page of texts
};

struct TaskDeclaration {
  std::string_view name;
  int edition = 1;         ///< increased when the meaning of its words changes
  std::string_view about;  ///< the question, for descriptions of exported data
  std::span<const ActionSpec> actions = {};
  std::span<const std::string_view> labels = {}, outcomes = {};
  std::string_view texts = {};  ///< keys of its page of texts, separated by spaces
  double trial_s = 10;          ///< assumed duration of a trial; the paper reports none
  bool detects = false;         ///< whether an answer states if the cubes differ
  std::span<const Wording> wordings = {};

  /// @return null if the task has no such action
  constexpr const ActionSpec* action(std::string_view kind) const {
    const auto found = std::ranges::find(actions, kind, &ActionSpec::kind);
    return found == actions.end() ? nullptr : &*found;
  }
};

/// The actions of an answer, steps in order of the cubes; empty: no answer.
struct Answer {
  std::vector<Action> actions;
  bool first_step_corrected = false;  ///< the first label is misplaced, then moved

  bool operator==(const Answer&) const = default;
};

/// The cue of a gram as a simulated participant expects it: a cube's lag with the paper's friction
/// 0.8 and spring of 50 N/m (4.2).
inline constexpr double mm_per_g = 0.8 * 9.81 / 50;

/// What a simulated participant has perceived of a trial when it answers.
struct Percepts {
  /// Remembered cue of each cube, leftmost first; then of the real object, if there is one.
  std::vector<double> remembered_mm;
  bool differ = false;                    ///< whether the cues differ by more than the criterion
  bool lapse = false;                     ///< remembered_mm are uniform random numbers in [0, 1)
  double guess_probability = 0;           ///< of labels although no difference was perceived
  double correction_probability = 0;      ///< of a first label that is misplaced, then moved
  std::span<const int> wrong_slots = {};  ///< earlier wrong choices in this trial, oldest first
};

/// What a baseline knows that does not look at the trial.
struct WithoutPercepts {
  int n_slots = 0;
  bool differ = false;
  std::span<const int> wrong_slots = {};
};

/// Slot of the largest value, ignoring the last n - 1 wrong choices; after more than that the cubes
/// must have been shuffled.
int heaviest_slot(std::span<const double> values, std::span<const int> wrong_slots);

// Lookups over the list of all tasks (Tasks.h), for code that needs no task's own types.

/// @return null if there is no such task
const TaskDeclaration* find_task(std::string_view name);

/// @throws Error (usage) naming the most similar task if there is no such task
const TaskDeclaration& task_named(std::string_view name);

/// Index of a task in the list; the length of the list if there is no such task.
std::size_t task_index(std::string_view name);

/// The words of all tasks, without duplicates, in the order of the list.
template <typename List>
std::vector<std::string_view> words_of();
template <>
std::vector<std::string_view> words_of<Task>();
template <>
std::vector<std::string_view> words_of<ActionKind>();
template <>
std::vector<std::string_view> words_of<Label>();
template <>
std::vector<std::string_view> words_of<Outcome>();

/// An action fills the same columns in every task. @return null if no task has it
const ActionSpec* action_named(std::string_view kind);

/// A simulated participant's answer. @param offer the task's Offer; empty: the default one
Answer simulated_answer(std::string_view task, const std::any& offer, const Percepts& percepts,
                        RandomStream& stream);

/// The answer of a baseline that does not look at the trial.
Answer blind_answer(std::string_view task, const std::any& offer, const WithoutPercepts& unseen,
                    RandomStream& stream);

/// The task's screens with the most content, to check that texts fit.
std::vector<ScreenState> fullest_screens(std::string_view task);

/// Orders keys that start with a task by the list of tasks.
struct InTaskOrder {
  bool operator()(const Task& a, const Task& b) const {
    return (*this)(std::tuple(a), std::tuple(b));
  }
  template <typename Key>
  requires requires { std::tuple_size<Key>::value; }
  bool operator()(const Key& a, const Key& b) const {
    const std::size_t index_a = task_index(std::get<0>(a)), index_b = task_index(std::get<0>(b));
    return index_a != index_b ? index_a < index_b : a < b;
  }
};

}  // namespace heft
