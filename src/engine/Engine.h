// The session engine: a pure fold over events, state = fold(plan, seed, events). It determines the
// next step, refuses invalid events and projects the rows of the log. No I/O, clock, physics or
// unseeded draws. Sessions, resume, replay and simulation all use this class.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "engine/RunningAttempt.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft {

/// Number of consecutive voids of a trial, not counting crashes, that pauses the session.
inline constexpr int max_voids = 3;

/// What the session waits for, and the event that it needs.
struct Next {
  enum class Kind {
    demonstration,  ///< show it, then demonstration_shown
    trial,          ///< start the trial `plan`: trial_started
    act,            ///< the trial `plan` is open: actions
    paused,         ///< continued
    finish,         ///< all blocks are completed: ended "finished"
    over            ///< none; the session has ended
  };
  Kind kind = Kind::over;
  std::optional<TrialPlan> plan;                    ///< trial, act
  std::optional<DemonstrationBlock> demonstration;  ///< demonstration
  std::optional<BreakBlock> rest;                   ///< a break before it
};

/// An admitted event, with the number of events that preceded its admission.
class AdmittedEvent {
 public:
  const Event& event() const { return event_; }

 private:
  friend class Engine;
  AdmittedEvent(Event event, int n_events);
  Event event_;
  int n_events_;
};

/// Either the event, or why it is refused.
struct Admission {
  std::optional<AdmittedEvent> admitted;
  std::string refusal;
};

/// Either all rows that an event changes, or why it is refused.
struct Applied {
  std::optional<Changes> changes;
  std::string refusal;
};

class Engine {
 public:
  Engine(std::shared_ptr<const SessionPlan> plan, std::uint64_t seed);

  std::uint64_t seed() const { return seed_; }

  const Next& next() const { return next_; }

  Admission admit(Event event) const;

  /// Folds an event. It is checked again if other events were folded since its admission; a refused
  /// event changes nothing.
  Applied apply(const AdmittedEvent& admitted);
  /// @return all changed rows
  /// @throws Error with the refusal; the state is unchanged
  Changes apply(const Event& event);

  /// Whether an admitted action would end the trial.
  bool ends_trial(const Action& action) const { return open_ && open_->ends_trial(action); }

  ScreenState screen() const;
  /// The open trial's screen with its cubes: displayed with their first frame, before the event
  /// cubes_shown.
  ScreenState screen_with_cubes() const;

  /// Session time from which the next trial may start, after the gap.
  double trial_due_s() const { return trial_due_s_; }

  /// The trial whose answer can be vetoed; null if there is none.
  const TrialRow* vetoable() const {
    return answered_ && !answered_->vetoed ? &answered_->trials.back() : nullptr;
  }

  /// Whether the last completed trial's answer was that the cubes differ; none: there is none, it
  /// was vetoed, or its task does not ask that.
  std::optional<bool> last_differed() const { return last_differed_; }

  /// Whether a trial of the block was started.
  bool has_begun(const std::string& block) const { return begun_.contains(block); }

  /// Whether the next trial counts and the last attempt was practice.
  bool practice_has_ended() const {
    return was_practice_ && next_.kind == Next::Kind::trial && !next_.plan->is_practice;
  }

  bool trial_is_open() const { return open_.has_value(); }
  /// Whether the session is paused because a trial was voided max_voids times in a row.
  bool needs_experimenter() const { return paused_ && n_voids_ >= max_voids; }
  SessionState state() const { return state_; }
  int n_events() const { return n_events_; }
  int n_attempts() const { return n_attempts_; }
  int n_completed() const { return n_completed_; }
  double last_s() const { return last_s_; }

  /// The last unfinished one of several interleaved staircases; none while more are running.
  std::optional<std::string> unfinished_staircase() const;

 private:
  std::optional<std::string> refusal(const Event& event) const;
  std::optional<std::string> course_refusal(const Event& event) const;
  void fold(const Event& event, Changes& changes);
  void start_trial(double t_s, Changes& changes);
  void act(const Action& action, double t_s, Changes& changes);
  void complete(double t_s, Changes& changes);
  void void_trial(const std::string& reason, double t_s, Changes& changes);
  void set_up(const SessionConfig& setup, Changes& changes);
  void begin_gap(double t_s);
  void keep_answer(const TrialRow& row, const Changes& changes);
  void veto_answer(const std::string& reason, double t_s, Changes& changes);
  void set_state(SessionState state, Changes& changes);

  void enter_block(std::size_t index);
  void end_rest();
  Next what_next() const;
  /// An attempt at a trial of the current block.
  std::unique_ptr<TaskTrial> attempt_at(const TrialPlan& plan) const;

  std::shared_ptr<const SessionPlan> plan_;
  std::uint64_t seed_;
  SessionState state_ = SessionState::running;
  int n_setups_ = 0;
  Onset onset_{0, 0};                         // 0 before the first setup
  std::map<std::string, double> parameters_;  // of the participant, from the last setup
  int n_events_ = 0, n_attempts_ = 0, n_completed_ = 0;
  double last_s_ = 0, trial_due_s_ = 0;
  bool paused_ = false, ended_ = false;

  std::size_t block_ = 0;         // of the next or open trial
  std::unique_ptr<TaskRun> run_;  // of that block; null: no trials left
  std::set<std::string> begun_;
  bool was_practice_ = false;  // the last attempt
  std::optional<BreakBlock> rest_;
  std::size_t rested_ = 0;  // breaks before this block were taken; a veto does not repeat them

  /// What is needed to veto the last answer.
  struct Answered {
    std::size_t block = 0;
    std::vector<TrialRow> trials;  // completed, not vetoed
    Changes last;                  // its reversals and estimates
    bool vetoed = false;           // only the last answer can be vetoed
  };
  std::optional<Answered> answered_;

  std::optional<bool> last_differed_, feedback_;
  int attempt_ = 1;  // of the next or open trial
  int n_voids_ = 0;  // of that trial, consecutive, since the last resume

  std::optional<RunningAttempt> open_;
  Next next_;
};

}  // namespace heft
