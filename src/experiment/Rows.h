// The rows that the engine projects from events, and the displayed frames, column for column as the
// log keeps them: see Column.h. `attempt index` counts a session's trial_started events from 1,
// `setup index` its setups; the log gives each its id.
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

/// Whether `Row` is this type, const or not: each visit_columns takes both.
template <typename Row, typename Type>
concept RowOf = std::same_as<std::remove_const_t<Row>, Type>;

/// What the answers to a trial have come to. Tasks fill it; the engine copies all of it.
struct TrialResult {
  std::optional<Outcome> outcome;  ///< once an action ended the trial
  std::optional<int> chosen_slot;
  std::optional<bool> choice_correct;
  std::optional<double> value;  ///< what was estimated or adjusted
};

struct TrialRow : TrialResult {
  int attempt_index = 0;
  int setup_index = 0;  ///< that it started under; 0: nothing told
  TrialPlan plan;
  TrialStatus status = TrialStatus::open;
  std::optional<std::string> void_reason;
  double started_s = 0;
  std::optional<double> shown_s, first_contact_s, first_choice_s, validated_s, ended_s;
  double paused_s = 0;  ///< time the trial stood still between shown and validated
  double lost_s = 0;    ///< time the effector was out of view between shown and validated
};
template <typename Row, typename Visit>
requires RowOf<Row, TrialRow>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"attempt_index", "", "attempts of the session, counted from 1", ">= 1"},
        row.attempt_index);
  visit(LogColumn{"trial_number", "", "planned trial, from 1; attempts share it", ">= 1"},
        row.plan.trial_number);
  visit(
      LogColumn{"attempt", "", "+1 after a veto or a lost camera, unchanged after a crash", ">= 1"},
      row.plan.attempt);
  visit(LogColumn{"block", "", "block of the protocol"}, row.plan.block);
  visit(LogColumn{"task", "", "what was asked"}, row.plan.task);
  visit(LogColumn{"condition", "", "technique that the clone was rendered with"},
        row.plan.condition);
  visit(LogColumn{"staircase", "", "procedure that chose the level; none in catch trials"},
        NullIfEmpty{row.plan.staircase});
  visit(LogColumn{"reference_g", "g", "mass of the reference", "> 0"}, row.plan.reference_g);
  visit(LogColumn{"level_g", "g", "comparison - reference, as presented"}, row.plan.level_g);
  visit(LogColumn{"is_catch", "", "the difference is 0 on purpose; drives no staircase"},
        row.plan.is_catch);
  visit(LogColumn{"is_practice", "", "practice: counts in no figure"}, row.plan.is_practice);
  visit(LogColumn{"n_reshuffles", "", "times the cubes were newly shuffled in it", ">= 0"},
        row.plan.n_reshuffles);
  visit(LogColumn{"status", "", "what became of the attempt"}, row.status);
  visit(LogColumn{"void_reason", "", "why it is void"}, row.void_reason);
  visit(LogColumn{"outcome", "", "what the answer was"}, row.outcome);
  visit(LogColumn{"chosen_slot", "", "cube that was chosen, 1 leftmost", "BETWEEN 1 AND 6"},
        row.chosen_slot);
  visit(LogColumn{"reference_slot", "", "where the reference stood", "BETWEEN 1 AND 6"},
        row.plan.reference_slot);
  visit(LogColumn{"choice_correct", "", "the chosen cube was the heaviest"}, row.choice_correct);
  visit(LogColumn{"value", "",
                  "what was estimated or adjusted, in the task's unit (adjustment: g); none: the "
                  "task asks for neither"},
        row.value);
  visit(LogColumn{"started_s", "s", "session time of its start", ">= 0"}, row.started_s);
  visit(LogColumn{"shown_s", "s", "first frame with all cubes", ">= 0"}, row.shown_s);
  visit(LogColumn{"first_contact_s", "s", "first touch of a cube", ">= 0"}, row.first_contact_s);
  visit(LogColumn{"first_choice_s", "s", "first action", ">= 0"}, row.first_choice_s);
  visit(LogColumn{"validated_s", "s", "the action that ended it", ">= 0"}, row.validated_s);
  visit(LogColumn{"paused_s", "s", "time it stood still between shown and validated", ">= 0"},
        row.paused_s);
  visit(LogColumn{"lost_s", "s", "time without effector between shown and validated", ">= 0"},
        row.lost_s);
  visit(LogColumn{"ended_s", "s", "session time of its end", ">= 0"}, row.ended_s);
}

/// What a push came to, of one touch or the most of all touches of a cube; see CubeTouch.
template <typename Row, typename Visit>
void visit_push_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"max_push_displacement_m", "m",
                  "farthest that the effector went from where it was when the touch began", ">= 0"},
        row.max_push_displacement_m);
  visit(LogColumn{"peak_lag_m", "m",
                  "largest distance of the clone from the effector during the touch, as displayed",
                  ">= 0"},
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
  std::optional<double> max_push_displacement_m{}, peak_lag_m{};
};
template <typename Row, typename Visit>
requires RowOf<Row, CubeRow>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"slot", "", "place of the cube, 1 leftmost", "BETWEEN 1 AND 6"}, row.slot);
  visit(LogColumn{"mass_g", "g", "its mass", "> 0"}, row.mass_g);
  visit(LogColumn{"n_pushes", "", "times the clone came to touch it", ">= 0"}, row.n_pushes);
  visit(LogColumn{"contact_s", "s", "time that it was touched for", ">= 0"}, row.contact_s);
  visit(LogColumn{"first_contact_s", "s", "session time of its first touch", ">= 0"},
        row.first_contact_s);
  visit(LogColumn{"last_contact_s", "s", "session time of the end of its last touch", ">= 0"},
        row.last_contact_s);
  visit(LogColumn{"n_resets", "", "times it was put back to its start", ">= 0"}, row.n_resets);
  visit_push_columns(row, visit);
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
  visit(LogColumn{"action", "", "what the participant did"}, row.action);
  visit(LogColumn{"slot", "", "with which cube, 1 leftmost", "BETWEEN 1 AND 6"}, row.slot);
  visit(LogColumn{"label", "", "label that was given"}, row.label);
  visit(LogColumn{"value", "", "number that was given, in the task's unit"}, row.value);
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
  visit(LogColumn{"staircase", "", "its procedure"}, row.staircase);
  visit(LogColumn{"number", "", "counted from 1", ">= 1"}, row.number);
  visit(LogColumn{"level_g", "g", "level presented on its trial"}, row.level_g);
  visit(LogColumn{"step_before_g", "g", "step in force before it"}, row.step_before_g);
  visit(LogColumn{"step_after_g", "g", "step in force after it"}, row.step_after_g);
}

struct EstimateRow {
  std::string staircase;
  std::string method;
  std::optional<double> jnd_g, low_g, high_g;
  int n_trials = 0, n_reversals = 0, n_floor = 0, n_ceiling = 0;
  StopReason reason = StopReason::reversals;
  std::optional<Censored> censored;
};
/// What a procedure that ended so says, as its row.
inline EstimateRow row_of(const std::string& staircase, const Estimate& estimate,
                          StopReason finish) {
  return {
      staircase,         estimate.method,      estimate.value,   estimate.low,       estimate.high,
      estimate.n_trials, estimate.n_reversals, estimate.n_floor, estimate.n_ceiling, finish,
      estimate.censored};
}
template <typename Row, typename Visit>
requires RowOf<Row, EstimateRow>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"staircase", "", "its procedure"}, row.staircase);
  visit(LogColumn{"method", "", "how it was estimated: mean_of_reversals..."}, row.method);
  visit(LogColumn{"jnd_g", "g", "the estimate; none: the data give none"}, row.jnd_g);
  visit(LogColumn{"low_g", "g", "lower end of its interval"}, row.low_g);
  visit(LogColumn{"high_g", "g", "upper end of its interval"}, row.high_g);
  visit(LogColumn{"n_trials", "", "trials that the procedure took", ">= 0"}, row.n_trials);
  visit(LogColumn{"n_reversals", "", "reversals among them", ">= 0"}, row.n_reversals);
  visit(LogColumn{"n_floor", "", "moves that the floor cut short", ">= 0"}, row.n_floor);
  visit(LogColumn{"n_ceiling", "", "moves that the ceiling cut short", ">= 0"}, row.n_ceiling);
  visit(
      LogColumn{
          "reason", "",
          "why the procedure ended: by its reversals, because it had all the trials that it may "
          "have, as constant stimuli always do, or because its estimate is as precise as asked"},
      row.reason);
  visit(
      LogColumn{
          "censored", "",
          "whether a bound cut a move that it depends on (before version 6: whether a reversal "
          "that counts was at a bound), or the limit of trials cut it short"},
      row.censored);
}

/// A number that a simulated participant was drawn as. A session has it once, unless somebody else
/// went on with it.
struct ParticipantParameterRow {
  int setup_index = 0;  ///< that told it
  std::string name;
  double value = 0;
};
template <typename Row, typename Visit>
requires RowOf<Row, ParticipantParameterRow>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"name", "", "parameter of the model, as its parameter file names it"}, row.name);
  visit(LogColumn{"value", "", "what this participant was drawn as, in the parameter's unit"},
        row.value);
}

enum class SessionState { running, paused, finished, aborted };
template <>
struct EnumNames<SessionState> {
  static constexpr std::array<std::string_view, 4> names{"running", "paused", "finished",
                                                         "aborted"};
};

/// Everything one event changes in the log; written in the transaction that writes the event.
struct Changes {
  int attempt_index = 0;  ///< of the attempt the event belongs to; 0: none
  std::optional<SessionConfig> setup;
  std::optional<TrialRow> trial;
  std::vector<CubeRow> cubes;
  std::vector<AnswerRow> answers;
  std::vector<ReversalRow> reversals;
  std::vector<EstimateRow> estimates;
  /// Rows that go again, with the answer that gave them.
  std::vector<ReversalRow> withdrawn_reversals;
  std::vector<EstimateRow> withdrawn_estimates;
  std::vector<ParticipantParameterRow> parameters;
  std::optional<SessionState> state;
};

/// One displayed frame. The effector columns are exactly what Drive was given.
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
  visit(LogColumn{"after_event", "", "events of the session that came before it", ">= 0"},
        row.after_event);
  visit(LogColumn{"t_s", "s", "session time that its world is of", ">= 0"}, row.t_s);
  visit(LogColumn{"trial_t_s", "s", "the same since the attempt's start: what Drive was given"},
        row.trial_t_s);
  visit(LogColumn{"capture_s", "s", "session time of its picture's exposure"}, row.capture_s);
  visit(LogColumn{"present_s", "s", "session time at which it was on the screen"}, row.present_s);
  visit(LogColumn{"tracked", "", "the effector was seen"}, row.tracked);
  visit(LogColumn{"jump", "", "the effector came back or leapt: the clone was teleported"},
        row.jump);
  visit(LogColumn{"contact_slot", "", "cube pressed hardest", "BETWEEN 1 AND 6"}, row.contact_slot);
  visit(LogColumn{"quality", "", "of the effector's pose, 0 to 1"}, row.quality);
  visit(LogColumn{"state_hash", "", "hash of the world's state"}, row.state_hash);
  visit(PoseColumns{"effector", "the tracked effector"}, Exactly{row.effector});
  visit(VelocityColumns{"effector", "its velocity"}, Exactly{row.effector_velocity});
  visit(PoseColumns{"clone", "the effector's clone as drawn"}, row.clone);
  visit(PoseColumns{"cube1", "cube of slot 1"}, PoseAt{row.cubes, 0});
  visit(PoseColumns{"cube2", "cube of slot 2"}, PoseAt{row.cubes, 1});
  visit(PoseColumns{"cube3", "cube of slot 3"}, PoseAt{row.cubes, 2});
  visit(LogColumn{"detected_s", "s", "session time at which its poses were known; wall clock"},
        row.detected_s);
  visit(LogColumn{"simulated_s", "s", "session time at which its world was known; wall clock"},
        row.simulated_s);
  visit(
      LogColumn{"n_dropped", "", "camera pictures lost since the frame before; wall clock", ">= 0"},
      row.n_dropped);
  visit(PoseColumns{"cube4", "cube of slot 4"}, PoseAt{row.cubes, 3});
  visit(PoseColumns{"cube5", "cube of slot 5"}, PoseAt{row.cubes, 4});
  visit(PoseColumns{"cube6", "cube of slot 6"}, PoseAt{row.cubes, 5});
  visit(LogColumn{"clone_offset_px", "px",
                  "on the display, from the middle of the effector to its clone's; none: no window "
                  "showed both",
                  ">= 0"},
        row.clone_offset_px);
}

}  // namespace heft
