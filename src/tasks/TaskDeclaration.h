// What a task declares about itself as data. Reader, engine, responders, recordings, log and
// exports take its words and the columns of its answers from here.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

namespace heft {

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
  double trial_s = 10;   ///< that a trial takes, for plans; the paper sets no limit, gives no times
  bool detects = false;  ///< an answer is "none" or says that the cubes differ

  /// @return null: the task has no such action
  constexpr const ActionSpec* action(std::string_view kind) const {
    const auto found = std::ranges::find(actions, kind, &ActionSpec::kind);
    return found == actions.end() ? nullptr : &*found;
  }
};

}  // namespace heft
