// Rows that the engine projects from events, and displayed frames, with the log's columns
// (Column.h). `attempt_index` counts a session's trial_started events from 1, `setup_index` its
// configurations; the log maps them to ids.
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <vector>

#include "base/PoseTypes.h"
#include "experiment/Column.h"
#include "experiment/SessionConfig.h"
#include "experiment/TrialPlan.h"
#include "psychophysics/ProcedureTypes.h"

namespace heft {

/// Whether `Row` is this type, const or not.
template <typename Row, typename Type>
concept RowOf = std::same_as<std::remove_const_t<Row>, Type>;

/// Result of a trial's answers, filled by its task.
struct TrialResult {
  std::optional<Outcome> outcome;  ///< set when an action ends the trial
  std::optional<int> chosen_slot;
  std::optional<bool> choice_correct;
  std::optional<double> value;  ///< estimated or adjusted value
};

struct TrialRow : TrialResult {
  int attempt_index = 0;
  int setup_index = 0;  ///< of the configuration it started under; 0: none
  TrialPlan plan;
  TrialStatus status = TrialStatus::open;
  std::optional<std::string> void_reason;
  double started_s = 0;
  std::optional<double> shown_s, first_contact_s, first_choice_s, validated_s, ended_s;
  double paused_s = 0;  ///< paused time between shown and validated
  double lost_s = 0;    ///< time without effector between shown and validated
};
template <typename Row, typename Visit>
requires RowOf<Row, TrialRow>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"attempt_index", "", "attempts of the session, counted from 1", ">= 1"},
        row.attempt_index);
  visit(LogColumn{"trial_number", "", "planned trial, from 1; shared by its attempts", ">= 1"},
        row.plan.trial_number);
  visit(LogColumn{"attempt", "",
                  "from 1; +1 after a veto or a lost camera, unchanged after a crash", ">= 1"},
        row.plan.attempt);
  visit(LogColumn{"block", "", "block of the protocol"}, row.plan.block);
  visit(LogColumn{"task", "", "task of the trial"}, row.plan.task);
  visit(LogColumn{"condition", "", "rendering technique of the clone"}, row.plan.condition);
  visit(LogColumn{"staircase", "", "procedure that set the level; NULL in catch trials"},
        NullIfEmpty{row.plan.staircase});
  visit(LogColumn{"reference_g", "g", "mass of the reference", "> 0"}, row.plan.reference_g);
  visit(
      LogColumn{"level_g", "g",
                "presented comparison mass minus reference mass (of an adjustment, at its start); "
                "of a judgment of one cube, its mass"},
      row.plan.level_g);
  visit(LogColumn{"is_catch", "", "catch trial: the difference is 0 and no procedure is updated"},
        row.plan.is_catch);
  visit(LogColumn{"is_practice", "", "practice trial: excluded from all results"},
        row.plan.is_practice);
  visit(LogColumn{"n_reshuffles", "",
                  "number of times the cubes were shuffled again, or one was replaced by a step",
                  ">= 0"},
        row.plan.n_reshuffles);
  visit(LogColumn{"status", "", "status of the attempt"}, row.status);
  visit(LogColumn{"void_reason", "", "reason why the attempt is void"}, row.void_reason);
  visit(LogColumn{"outcome", "", "outcome of the trial"}, row.outcome);
  visit(LogColumn{"chosen_slot", "",
                  "slot of the chosen cube; 1 is leftmost, one after the cubes': the real object",
                  "BETWEEN 1 AND 6"},
        row.chosen_slot);
  visit(LogColumn{"reference_slot", "",
                  "slot of the reference; 1 is leftmost, one after the cubes': a real object",
                  "BETWEEN 1 AND 6"},
        row.plan.reference_slot);
  visit(LogColumn{"choice_correct", "", "whether the heaviest cube was chosen"},
        row.choice_correct);
  visit(LogColumn{"value", "", "estimated or adjusted value in the task's unit (adjustment: g)"},
        row.value);
  visit(LogColumn{"started_s", "s", "session time of the start", ">= 0"}, row.started_s);
  visit(LogColumn{"shown_s", "s", "session time of the first frame with all cubes", ">= 0"},
        row.shown_s);
  visit(LogColumn{"first_contact_s", "s", "session time of the first contact with a cube", ">= 0"},
        row.first_contact_s);
  visit(LogColumn{"first_choice_s", "s", "session time of the first action", ">= 0"},
        row.first_choice_s);
  visit(LogColumn{"validated_s", "s", "session time of the final answer", ">= 0"}, row.validated_s);
  visit(LogColumn{"paused_s", "s", "paused time between shown_s and validated_s", ">= 0"},
        row.paused_s);
  visit(LogColumn{"lost_s", "s", "time without effector between shown_s and validated_s", ">= 0"},
        row.lost_s);
  visit(LogColumn{"ended_s", "s", "session time of the end", ">= 0"}, row.ended_s);
}

/// Push measures of one contact, or their maxima over the contacts of a cube; see CubeTouch.
template <typename Row, typename Visit>
void visit_push_columns(Row& row, Visit&& visit) {
  visit(
      LogColumn{"max_push_displacement_m", "m",
                "largest displacement of the effector from its position at first contact", ">= 0"},
      row.max_push_displacement_m);
  visit(LogColumn{"peak_lag_m", "m",
                  "largest displayed distance between clone and effector during contact", ">= 0"},
        row.peak_lag_m);
}

struct CubeRow {
  int attempt_index = 0;
  int slot = 0;  ///< from 1, leftmost
  double mass_g = 0;
  int n_pushes = 0;
  double contact_s = 0;
  std::optional<double> first_contact_s, last_contact_s;
  int n_resets = 0;
  std::optional<double> max_push_displacement_m{}, peak_lag_m{}, table_friction{};
};
/// The cubes of a plan, untouched.
inline std::vector<CubeRow> fresh_cubes(int attempt_index, const TrialPlan& plan) {
  std::vector<CubeRow> cubes(plan.masses_g.size());
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    cubes[i].attempt_index = attempt_index;
    cubes[i].slot = static_cast<int>(i) + 1;
    cubes[i].mass_g = plan.masses_g[i];
    if (!plan.table_friction.empty()) cubes[i].table_friction = plan.table_friction[i];
  }
  return cubes;
}
template <typename Row, typename Visit>
requires RowOf<Row, CubeRow>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"slot", "", "slot of the cube; 1 is leftmost", "BETWEEN 1 AND 6"}, row.slot);
  visit(LogColumn{"mass_g", "g", "mass of the cube", "> 0"}, row.mass_g);
  visit(LogColumn{"n_pushes", "", "number of contacts of the clone with the cube", ">= 0"},
        row.n_pushes);
  visit(LogColumn{"contact_s", "s", "total contact time", ">= 0"}, row.contact_s);
  visit(LogColumn{"first_contact_s", "s", "session time of the first contact", ">= 0"},
        row.first_contact_s);
  visit(LogColumn{"last_contact_s", "s", "session time of the end of the last contact", ">= 0"},
        row.last_contact_s);
  visit(LogColumn{"n_resets", "", "number of resets to the start position", ">= 0"}, row.n_resets);
  visit_push_columns(row, visit);
  visit(LogColumn{"table_friction", "",
                  "friction between the cube and the table; NULL: the protocol's friction", ">= 0"},
        row.table_friction);
}

struct AnswerRow {
  int attempt_index = 0;
  double t_s = 0;
  ActionKind action;
  std::optional<int> slot;
  std::optional<Label> label;
  std::optional<double> value{};
};
template <typename Row, typename Visit>
requires RowOf<Row, AnswerRow>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"t_s", "s", "session time", ">= 0"}, row.t_s);
  visit(LogColumn{"action", "", "action of the participant"}, row.action);
  visit(LogColumn{"slot", "", "slot of the cube; 1 is leftmost", "BETWEEN 1 AND 6"}, row.slot);
  visit(LogColumn{"label", "", "assigned label"}, row.label);
  visit(LogColumn{"value", "", "given number in the task's unit"}, row.value);
}

struct ReversalRow {
  int attempt_index = 0;
  std::string staircase;
  int number = 0;
  double level_g = 0, step_before_g = 0, step_after_g = 0;
};
template <typename Row, typename Visit>
requires RowOf<Row, ReversalRow>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"staircase", "", "name of the procedure"}, row.staircase);
  visit(LogColumn{"number", "", "number of the reversal, from 1", ">= 1"}, row.number);
  visit(LogColumn{"level_g", "g", "level of the reversal's trial"}, row.level_g);
  visit(LogColumn{"step_before_g", "g", "step before the reversal"}, row.step_before_g);
  visit(LogColumn{"step_after_g", "g", "step after the reversal"}, row.step_after_g);
}

struct EstimateRow {
  std::string staircase;
  std::string method;
  std::optional<double> jnd_g, low_g, high_g;
  int n_trials = 0, n_reversals = 0, n_floor = 0, n_ceiling = 0;
  StopReason reason = StopReason::reversals;
  std::optional<Censored> censored;
};
/// Row of an estimate of a procedure that has stopped.
inline EstimateRow row_of(const std::string& staircase, const Estimate& estimate,
                          StopReason reason) {
  return {
      staircase,         estimate.method,      estimate.value,   estimate.low,       estimate.high,
      estimate.n_trials, estimate.n_reversals, estimate.n_floor, estimate.n_ceiling, reason,
      estimate.censored};
}
template <typename Row, typename Visit>
requires RowOf<Row, EstimateRow>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"staircase", "", "name of the procedure"}, row.staircase);
  visit(LogColumn{"method", "", "method of estimation: mean_of_reversals..."}, row.method);
  visit(LogColumn{"jnd_g", "g", "estimate; NULL: not estimable from the data"}, row.jnd_g);
  visit(LogColumn{"low_g", "g", "lower bound of the interval"}, row.low_g);
  visit(LogColumn{"high_g", "g", "upper bound of the interval"}, row.high_g);
  visit(LogColumn{"n_trials", "", "number of trials of the procedure", ">= 0"}, row.n_trials);
  visit(LogColumn{"n_reversals", "", "number of reversals", ">= 0"}, row.n_reversals);
  visit(LogColumn{"n_floor", "", "number of moves limited by the floor", ">= 0"}, row.n_floor);
  visit(LogColumn{"n_ceiling", "", "number of moves limited by the ceiling", ">= 0"},
        row.n_ceiling);
  visit(
      LogColumn{
          "reason", "",
          "why the procedure stopped: number of reversals, number of trials (always for constant "
          "stimuli), or precision of the estimate"},
      row.reason);
  visit(
      LogColumn{
          "censored", "",
          "whether the floor or ceiling limited a move that the estimate depends on, or the trial "
          "limit ended the procedure; of Bayesian kinds, whether the posterior reaches the upper "
          "(above) or lower end of its grid, or the answers do not identify it "
          "(indeterminate); sessions of log_version 5: whether a counted reversal was at a "
          "bound"},
      row.censored);
}

/// A parameter drawn for a simulated participant; once per session, unless another participant
/// continued it.
struct ParticipantParameterRow {
  int setup_index = 0;  ///< of the configuration that contains it
  std::string name;
  double value = 0;
};
template <typename Row, typename Visit>
requires RowOf<Row, ParticipantParameterRow>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"name", "", "parameter, as named in the model's parameter file"}, row.name);
  visit(LogColumn{"value", "", "value drawn for this participant, in the parameter's unit"},
        row.value);
}

/// withdrawn: its data were removed at the participant's wish.
enum class SessionState { running, paused, finished, aborted, withdrawn };
template <>
struct EnumNames<SessionState> {
  static constexpr std::array<std::string_view, 5> names{"running", "paused", "finished", "aborted",
                                                         "withdrawn"};
};

/// All changes of one event to the log, written in one transaction with the event.
struct Changes {
  int attempt_index = 0;  ///< of the event's attempt; 0: none
  std::optional<SessionConfig> setup;
  std::optional<TrialRow> trial;
  std::vector<CubeRow> cubes;
  std::vector<AnswerRow> answers;
  std::vector<ReversalRow> reversals;
  std::vector<EstimateRow> estimates;
  /// Rows removed together with a vetoed answer.
  std::vector<ReversalRow> withdrawn_reversals;
  std::vector<EstimateRow> withdrawn_estimates;
  std::vector<ParticipantParameterRow> parameters;
  std::optional<SessionState> state;
};

/// A displayed frame. The effector columns are the exact input of the physics.
struct FrameRow {
  static constexpr std::size_t most_cubes = 6;

  int attempt_index = 0;
  int after_event = 0;
  double t_s = 0;
  double trial_t_s = 0;
  double capture_s = 0, present_s = 0;
  bool tracked = true, jump = false;
  std::optional<int> contact_slot;
  std::optional<double> quality;
  std::string state_hash;
  Pose effector;
  Velocity effector_velocity;
  std::optional<Pose> clone;
  std::vector<Pose> cubes;  ///< by slot
  std::optional<double> detected_s, simulated_s;
  std::optional<int> n_dropped;
  std::optional<double> clone_offset_px{};
};
template <typename Row, typename Visit>
requires RowOf<Row, FrameRow>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"after_event", "", "number of earlier events of the session", ">= 0"},
        row.after_event);
  visit(LogColumn{"t_s", "s", "session time of the displayed world", ">= 0"}, row.t_s);
  visit(LogColumn{"trial_t_s", "s", "the same, since the attempt's start; input of the physics"},
        row.trial_t_s);
  visit(LogColumn{"capture_s", "s", "session time of the camera picture's exposure"},
        row.capture_s);
  visit(LogColumn{"present_s", "s", "session time of presentation on the screen"}, row.present_s);
  visit(LogColumn{"tracked", "", "whether the effector was detected"}, row.tracked);
  visit(LogColumn{"jump", "",
                  "whether the clone was teleported after a loss or jump of the effector"},
        row.jump);
  visit(LogColumn{"contact_slot", "", "slot of the cube with the largest contact force",
                  "BETWEEN 1 AND 6"},
        row.contact_slot);
  visit(LogColumn{"quality", "", "quality of the effector's pose, 0 to 1"}, row.quality);
  visit(LogColumn{"state_hash", "", "hash of the simulated world's state"}, row.state_hash);
  visit(PoseColumns{"effector", "pose of the tracked effector"}, Exactly{row.effector});
  visit(VelocityColumns{"effector", "velocity of the tracked effector"},
        Exactly{row.effector_velocity});
  visit(PoseColumns{"clone", "displayed pose of the clone"}, row.clone);
  visit(PoseColumns{"cube1", "displayed pose of the cube in slot 1"}, PoseAt{row.cubes, 0});
  visit(PoseColumns{"cube2", "displayed pose of the cube in slot 2"}, PoseAt{row.cubes, 1});
  visit(PoseColumns{"cube3", "displayed pose of the cube in slot 3"}, PoseAt{row.cubes, 2});
  visit(LogColumn{"detected_s", "s", "session time at which poses were available (wall clock)"},
        row.detected_s);
  visit(LogColumn{"simulated_s", "s", "session time at which the world was simulated (wall clock)"},
        row.simulated_s);
  visit(LogColumn{"n_dropped", "", "camera pictures lost since the previous frame (wall clock)",
                  ">= 0"},
        row.n_dropped);
  visit(PoseColumns{"cube4", "displayed pose of the cube in slot 4"}, PoseAt{row.cubes, 3});
  visit(PoseColumns{"cube5", "displayed pose of the cube in slot 5"}, PoseAt{row.cubes, 4});
  visit(PoseColumns{"cube6", "displayed pose of the cube in slot 6"}, PoseAt{row.cubes, 5});
  visit(LogColumn{"clone_offset_px", "px",
                  "displayed distance between the centers of effector and clone; NULL: no window "
                  "showed both",
                  ">= 0"},
        row.clone_offset_px);
}

}  // namespace heft
