// The session engine: a pure fold over events, state = fold(protocol, seed, events). It says what
// comes next, refuses what can't be, and projects the rows that the log keeps. No I/O, no clock, no
// physics, no unseeded draw; resume, replay and simulation all fold with this one class.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/Protocol.h"
#include "psychophysics/Procedure.h"
#include "session/RunningAttempt.h"

namespace heft {

/// So many voids of one trial (crashes not counted) pause the session.
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

class Engine {
 public:
  Engine(std::shared_ptr<const Protocol> protocol, std::uint64_t seed);

  const Protocol& protocol() const { return *protocol_; }
  std::uint64_t seed() const { return seed_; }

  const Next& next() const { return next_; }

  /// Why the event can't come now; none if it can.
  std::optional<std::string> refusal(const Event& event) const;

  /// Folds one event. @return every row that it changes
  /// @throws Error with the refusal, leaving the state as it was
  Changes apply(const Event& event);

  /// Whether an action that is not refused would end the trial.
  bool ends_trial(const Event& action) const { return open_ && open_->ends_trial(action); }

  ScreenState screen() const;

  bool trial_is_open() const { return open_.has_value(); }
  /// Paused because one trial was voided max_voids times: somebody has to look.
  bool needs_somebody() const { return paused_ && n_voids_ > 0 && n_voids_ % max_voids == 0; }
  SessionState state() const { return state_; }
  int n_events() const { return n_events_; }
  int n_attempts() const { return n_attempts_; }
  int n_completed() const { return n_completed_; }
  double last_s() const { return last_s_; }

  /// The staircase that runs alone where several were to be interleaved; none before that.
  std::optional<std::string> survivor() const;

 private:
  std::optional<std::string> course_refusal(const Event& event) const;
  void fold(const Event& event, Changes& changes);
  void start_trial(const Event& event, Changes& changes);
  void act(const Event& event, Changes& changes);
  void complete(const Event& event, Outcome outcome, Changes& changes);
  void respond_to_staircase(Changes& changes);
  void void_trial(const Event& event, Changes& changes);
  void close(const Event& event, TrialStatus status, Changes& changes);
  void set_state(SessionState state, Changes& changes);

  bool block_done(const Block& block) const;
  void enter_block(std::size_t index);
  Next what_next();

  std::shared_ptr<const Protocol> protocol_;
  std::uint64_t seed_;
  SessionState state_ = SessionState::running;
  int n_events_ = 0, n_attempts_ = 0, n_completed_ = 0;
  double last_s_ = 0;
  bool paused_ = false, over_ = false;

  std::size_t block_ = 0;  // of the next or open trial
  int n_in_block_ = 0;     // trials completed in it
  std::optional<BreakBlock> rest_;
  int attempt_ = 1, n_voids_ = 0;  // of the next or open trial
  std::vector<Procedure> staircases_;
  std::optional<std::size_t> previous_staircase_,
      staircase_;  // of the last completed, the next trial

  std::optional<RunningAttempt> open_;
  Next next_;
};

}  // namespace heft
