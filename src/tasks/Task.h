// What a task declares about itself as data. Reader, engine, responders, recordings, log and
// exports take its words and the columns of its answers from here.
// What a participant has made up their mind to say of a trial, and what a simulated mind has to
// make it up from. Each task turns the one into the other.
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
  std::string_view texts = {};  ///< keys of the words on its page, parted by spaces
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

// Lookups over the list of all tasks (Tasks.h), for code that needs no task's own types.

/// @return null: there is no task of that name
const TaskDeclaration* find_task(std::string_view name);

/// @throws Error (usage) naming the nearest task where there is none of that name
const TaskDeclaration& task_named(std::string_view name);

/// The place of a task on the list; its length where the task is not on it.
std::size_t task_index(std::string_view name);

/// The words of all tasks, each once, in the list's order.
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

/// An action by its kind, which fills the same columns in every task. @return null: no task has it
const ActionSpec* action_named(std::string_view kind);

/// A simulated participant's answer to a trial of a task. @param offer the task's Offer
Answer simulated_answer(std::string_view task, const std::any& offer, const Percepts& percepts,
                        RandomStream& stream);

/// The same without looking at the trial.
Answer blind_answer(std::string_view task, const std::any& offer, const WithoutPercepts& unseen,
                    RandomStream& stream);

/// A task's screens with as much on them as they can hold, to check that texts fit.
std::vector<ScreenState> fullest_screens(std::string_view task);

/// Orders keys that begin with a task as the list does.
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
