// The session engine: a pure fold over events, state = fold(plan, seed, events). It says what
// comes next, refuses what can't be, and projects the rows that the log keeps. No I/O, no clock, no
// physics, no unseeded draw; resume, replay and simulation all fold with this one class.
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
#include "tasks/SessionPlan.h"

namespace heft {

/// So many voids of one trial (crashes not counted) in a row, without a resume, pause the session.
inline constexpr int max_voids = 3;

/// What the session waits for.
struct Next {
  enum class Kind {
    demonstration,  ///< show it, then event demonstration_shown
    trial,          ///< start `plan`, event trial_started
    act,            ///< the trial `plan` is open: actions
    paused,         ///< event continued
    finish,         ///< everything is done: event ended "finished"
    over            ///< the session has ended
  };
  Kind kind = Kind::over;
  std::optional<TrialPlan> plan;                    ///< trial, act
  std::optional<DemonstrationBlock> demonstration;  ///< demonstration
  std::optional<BreakBlock> rest;                   ///< a break to take first
};

/// An event that the engine has admitted after so many events.
class AdmittedEvent {
 public:
  const Event& event() const { return event_; }

 private:
  friend class Engine;
  AdmittedEvent(Event event, int n_events) : event_(std::move(event)), n_events_(n_events) {}
  Event event_;
  int n_events_;
};

/// Either the event, or why it can't come now.
struct Admission {
  std::optional<AdmittedEvent> admitted;
  std::string refusal;
};

/// Either every row that an event changes, or why it can't come any more.
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

  /// Folds an event. Where others were folded since it was admitted it is admitted once more; a
  /// refusal leaves the state as it was.
  Applied apply(const AdmittedEvent& admitted);
  /// @return every row that it changes
  /// @throws Error with the refusal, leaving the state as it was
  Changes apply(const Event& event);

  /// Whether an action that was admitted would end the trial.
  bool ends_trial(const Action& action) const { return open_ && open_->ends_trial(action); }

  ScreenState screen() const;
  /// The screen of the open trial as it is once its cubes are shown: what is displayed with their
  /// first frame, before anybody can be told that they were.
  ScreenState screen_with_cubes() const;

  /// When the next trial may start, in session time: once the gap after the last one is over.
  double trial_due_s() const { return trial_due_s_; }

  /// The trial whose answer can be vetoed; null: there is none, or what came after stands.
  const TrialRow* vetoable() const {
    return answered_ && !answered_->vetoed ? &answered_->trials.back() : nullptr;
  }

  /// Whether a trial of that block was ever started.
  bool has_begun(const std::string& block) const { return begun_.contains(block); }

  bool trial_is_open() const { return open_.has_value(); }
  /// Paused because one trial was voided max_voids times in a row: somebody has to look.
  bool needs_somebody() const { return paused_ && n_voids_ >= max_voids; }
  SessionState state() const { return state_; }
  int n_events() const { return n_events_; }
  int n_attempts() const { return n_attempts_; }
  int n_completed() const { return n_completed_; }
  double last_s() const { return last_s_; }

  /// The staircase that runs alone where several were to be interleaved; none before that.
  std::optional<std::string> survivor() const;

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
  Onset onset_{0, 0};                         // in force; before anything is told there is none
  std::map<std::string, double> parameters_;  // of the participant, as told last
  int n_events_ = 0, n_attempts_ = 0, n_completed_ = 0;
  double last_s_ = 0, trial_due_s_ = 0;
  bool paused_ = false, over_ = false;

  std::size_t block_ = 0;         // of the next or open trial
  std::unique_ptr<TaskRun> run_;  // of that block; null: it has no trials, or all are done
  std::set<std::string> begun_;
  std::optional<BreakBlock> rest_;
  std::size_t rested_ = 0;  // breaks before this block are over, whatever is taken back later

  /// Of the block of trials that was answered last, what is needed to take its last answer back.
  struct Answered {
    std::size_t block = 0;
    std::vector<TrialRow> trials;  // those that count
    Changes last;                  // reversals and estimates alone
    bool vetoed = false;           // one is enough: the last but one stands
  };
  std::optional<Answered> answered_;

  int attempt_ = 1;  // of the next or open trial
  int n_voids_ = 0;  // of that trial, in a row without a resume

  std::optional<RunningAttempt> open_;
  Next next_;
};

}  // namespace heft
