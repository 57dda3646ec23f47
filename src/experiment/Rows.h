// The rows that the engine projects from events, column for column as the log keeps them. `attempt
// index` counts a session's trial_started events from 1; the log gives each its trial_id.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/PoseTypes.h"
#include "experiment/Task.h"
#include "experiment/TrialPlan.h"

namespace heft {

struct TrialRow {
  int attempt_index = 0;
  TrialPlan plan;
  TrialStatus status = TrialStatus::open;
  std::optional<std::string> void_reason;
  std::optional<Outcome> outcome;
  std::optional<int> chosen_slot;
  std::optional<bool> choice_correct;
  double started_s = 0;
  std::optional<double> shown_s, first_contact_s, first_choice_s, validated_s, ended_s;
  double paused_s = 0;  ///< time the trial stood still between shown and validated
  double lost_s = 0;    ///< time the effector was out of view between shown and validated
};

struct CubeRow {
  int attempt_index = 0;
  int slot = 0;  ///< from 1, leftmost
  double mass_g = 0;
  int n_pushes = 0;
  double contact_s = 0;
  std::optional<double> first_contact_s, last_contact_s;
};

struct AnswerRow {
  int attempt_index = 0;
  double t_s = 0;
  ActionKind action = ActionKind::validate;
  std::optional<int> slot;
  std::optional<Label> label;
};

struct ReversalRow {
  std::string staircase;
  int number = 0;  ///< from 1
  int attempt_index = 0;
  double level_g = 0, step_before_g = 0, step_after_g = 0;
};

struct EstimateRow {
  std::string staircase;
  std::string method;  ///< "mean_of_reversals"
  std::optional<double> jnd_g, low_g, high_g;
  int n_trials = 0, n_reversals = 0, n_floor = 0, n_ceiling = 0;
  std::string reason;  ///< "reversals" or "trials"
};

enum class SessionState { running, paused, finished, aborted };
template <>
struct EnumNames<SessionState> {
  static constexpr std::array<std::string_view, 4> names{"running", "paused", "finished",
                                                         "aborted"};
};

/// Everything one event changes in the log; written in the transaction that writes the event.
struct Changes {
  int attempt_index = 0;  ///< of the attempt the event belongs to; 0: none
  std::optional<TrialRow> trial;
  std::vector<CubeRow> cubes;
  std::vector<AnswerRow> answers;
  std::vector<ReversalRow> reversals;
  std::vector<EstimateRow> estimates;
  std::optional<SessionState> state;
};

/// One displayed picture. The effector columns are exactly what Drive was given.
struct FrameRow {
  int attempt_index = 0;
  int after_event = 0;   ///< how many events of the session came before it
  double t_s = 0;        ///< session time at which its world was computed
  double trial_t_s = 0;  ///< seconds since the attempt's start: the time Drive was given
  double capture_s = 0, present_s = 0;
  /// Session times at which its poses and its world were there, and how many pictures of the camera
  /// since the last shown one were not; none on a virtual clock.
  std::optional<double> detected_s, simulated_s;
  std::optional<int> n_dropped;
  bool tracked = true, jump = false;
  std::optional<int> contact_slot;
  std::optional<double> quality;
  std::string state_hash;
  Pose effector;
  Velocity effector_velocity;
  std::optional<Pose> clone;
  std::vector<Pose> cubes;  ///< by slot
};

}  // namespace heft
