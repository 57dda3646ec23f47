#include "engine/Engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/Error.h"

namespace heft {

namespace {
template <typename... Handlers>
struct Cases : Handlers... {
  using Handlers::operator()...;
};
template <typename... Handlers>
Cases(Handlers...) -> Cases<Handlers...>;

EventRole role_of(const EventPayload& what) {
  return std::visit([](const auto& payload) { return payload.event_type.role; }, what);
}
}  // namespace

Engine::Engine(std::shared_ptr<const SessionPlan> plan, std::uint64_t seed)
    : plan_(std::move(plan)), seed_(seed) {
  enter_block(0);
  next_ = what_next();
}

AdmittedEvent::AdmittedEvent(Event event, int n_events)
    : event_(std::move(event)), n_events_(n_events) {}

Admission Engine::admit(Event event) const {
  if (auto why = refusal(event)) return {std::nullopt, std::move(*why)};
  return {AdmittedEvent(std::move(event), n_events_), {}};
}

std::optional<std::string> Engine::refusal(const Event& event) const {
  if (!(event.t_s >= last_s_))
    return fmt::format("its time {} s is before the last event's {} s", event.t_s, last_s_);
  switch (role_of(event.what)) {
    case EventRole::attempt:
      if (!open_) return "no trial is running";
      if (paused_) return "the session is paused";
      return open_->refusal(event);
    case EventRole::course:
      if (ended_) return "the session has ended";
      return course_refusal(event);
    case EventRole::setting:
    case EventRole::recorded:
      break;
  }
  return std::nullopt;
}

std::optional<std::string> Engine::course_refusal(const Event& event) const {
  if (event.as<TrialStarted>()) {
    if (next_.kind != Next::Kind::trial) return "no trial is due";
    if (event.t_s < trial_due_s_) return "the gap after the last trial has not ended";
  }
  if (event.as<DemonstrationShown>() && next_.kind != Next::Kind::demonstration)
    return "no demonstration is due";
  if (const auto* voided = event.as<TrialVoided>()) {
    if (!open_) return "no trial is running";
    if (voided->reason.empty()) return "it has no reason";
  }
  if (const auto* vetoed = event.as<AnswerVetoed>()) {
    if (open_) return "the running trial must be voided first";
    if (!vetoable()) return "there is no answer to veto";
    if (vetoed->reason.empty()) return "it has no reason";
  }
  if (event.as<SessionPaused>() && paused_) return "the session is already paused";
  if (event.as<SessionContinued>() && !paused_) return "the session is not paused";
  if (event.as<SessionResumed>() && open_) return "the interrupted trial must be voided first";
  if (const auto* ended = event.as<SessionEnded>()) {
    if (open_) return "a trial is still running";
    if (ended->how == Ending::finished && next_.kind != Next::Kind::finish)
      return "not all blocks are completed";
  }
  return std::nullopt;
}

Changes Engine::apply(const Event& event) {
  const Admission admission = admit(event);
  if (!admission.admitted)
    throw Error(fmt::format("event \"{}\" at {} s is refused: {}", name_of(event.kind()), event.t_s,
                            admission.refusal));
  return *apply(*admission.admitted).changes;
}

Applied Engine::apply(const AdmittedEvent& admitted) {
  const Event& event = admitted.event();
  if (admitted.n_events_ != n_events_)
    if (auto why = refusal(event)) return {std::nullopt, std::move(*why)};
  Changes changes;
  if (open_) {
    open_->account(event.t_s, paused_);
    changes.attempt_index = n_attempts_;
  }
  last_s_ = event.t_s;
  ++n_events_;
  fold(event, changes);
  next_ = what_next();
  return {std::move(changes), {}};
}

// A payload without a handler does not compile, unless it is only recorded.
void Engine::fold(const Event& event, Changes& changes) {
  const double t_s = event.t_s;
  const auto set_paused = [&](bool paused) {
    paused_ = paused;
    set_state(paused ? SessionState::paused : SessionState::running, changes);
  };
  const Cases fold_payload{
      [&](const TrialStarted&) { start_trial(t_s, changes); },
      [&](const Action& action) { act(action, t_s, changes); },
      [&](const TrialVoided& voided) { void_trial(voided.reason, t_s, changes); },
      [&](const AnswerVetoed& vetoed) { veto_answer(vetoed.reason, t_s, changes); },
      [&](const SessionConfig& setup) { set_up(setup, changes); },
      [&](const SessionPaused&) { set_paused(true); },
      [&](const SessionContinued&) { set_paused(false); },
      [&](const SessionResumed&) {
        n_voids_ = 0;
        set_paused(false);
      },
      [&](const SessionEnded& ended) {
        ended_ = true;
        const bool finished = ended.how == Ending::finished;
        set_state(finished ? SessionState::finished : SessionState::aborted, changes);
      },
      [&](const DemonstrationShown&) {
        end_rest();
        answered_.reset();
        enter_block(block_ + 1);
      },
      [&](const BreakTaken& taken) {
        if (rest_ && rest_->name == taken.name) end_rest();
      },
      [&](const CubesShown&) {
        open_->show(t_s);
        changes.trial = open_->row();
      },
      [&](const CubeTouch& contact) {
        open_->touch(contact, t_s);
        changes.trial = open_->row();
        changes.cubes = {open_->cubes()[static_cast<std::size_t>(contact.slot - 1)]};
      },
      [&](const CubesReset& reset) {
        open_->reset(reset);
        changes.cubes = open_->cubes();
      },
      [&](const EffectorLost&) { open_->lose_effector(); },
      [&](const EffectorFound&) { open_->find_effector(); },
      [](const Recorded auto&) {},
  };
  std::visit(fold_payload, event.what);
}

void Engine::set_up(const SessionConfig& setup, Changes& changes) {
  ++n_setups_;
  changes.setup = setup;
  onset_ = {setup.gap_s.value_or(0), setup.min_answer_s.value_or(0)};
  if (setup.participant_parameters == parameters_) return;
  parameters_ = setup.participant_parameters;
  for (const auto& [name, value] : parameters_)
    changes.parameters.push_back({n_setups_, name, value});
}

void Engine::start_trial(double t_s, Changes& changes) {
  TrialRow row;
  row.attempt_index = ++n_attempts_;
  row.setup_index = n_setups_;
  row.started_s = t_s;
  open_.emplace(row, attempt_at(*next_.plan), plan_->require_contact, onset_.min_answer_s);
  end_rest();
  begun_.insert(open_->plan().block);
  was_practice_ = open_->plan().is_practice;
  changes.attempt_index = n_attempts_;
  changes.trial = open_->row();
  changes.cubes = open_->cubes();
}

void Engine::act(const Action& action, double t_s, Changes& changes) {
  const int n_reshuffles = open_->plan().n_reshuffles;
  open_->act(action, t_s);
  changes.answers = {{n_attempts_, t_s, action.kind, action.slot, action.label, action.value}};
  if (open_->has_ended()) return complete(t_s, changes);
  if (open_->plan().n_reshuffles != n_reshuffles) changes.cubes = open_->cubes();
  changes.trial = open_->row();
}

void Engine::complete(double t_s, Changes& changes) {
  open_->complete(t_s);
  changes.trial = open_->row();
  last_differed_ = open_->answered_different();
  open_.reset();
  begin_gap(t_s);
  ++n_completed_;
  attempt_ = 1;
  n_voids_ = 0;
  run_->complete(*changes.trial, changes);
  feedback_ = run_->feedback();
  keep_answer(*changes.trial, changes);
  if (run_->finished()) enter_block(block_ + 1);
}

void Engine::keep_answer(const TrialRow& row, const Changes& changes) {
  if (!answered_ || answered_->block != block_) answered_ = Answered{block_, {}, {}, false};
  answered_->vetoed = false;
  answered_->trials.push_back(row);
  answered_->last.reversals = changes.reversals;
  answered_->last.estimates = changes.estimates;
}

// The actions stay in `answer`; the trial loses its outcome and so counts in no result. The block's
// procedures are folded again from its other trials, so that nothing of the answer remains.
void Engine::veto_answer(const std::string& reason, double t_s, Changes& changes) {
  TrialRow row = answered_->trials.back();
  answered_->trials.pop_back();
  answered_->vetoed = true;
  last_differed_.reset();
  feedback_.reset();
  row.status = TrialStatus::voided;
  row.void_reason = std::string(answer_vetoed) + reason;
  row.outcome.reset();
  row.choice_correct.reset();
  row.value.reset();
  changes.attempt_index = row.attempt_index;
  changes.trial = row;
  changes.withdrawn_reversals = answered_->last.reversals;
  changes.withdrawn_estimates = answered_->last.estimates;
  enter_block(answered_->block);
  rest_.reset();
  for (const TrialRow& trial : answered_->trials) {
    Changes again;
    run_->complete(trial, again);
  }
  --n_completed_;
  attempt_ = row.plan.attempt + 1;
  n_voids_ = 0;
  begin_gap(t_s);
}

void Engine::void_trial(const std::string& reason, double t_s, Changes& changes) {
  open_->make_void(reason, t_s);
  changes.trial = open_->row();
  open_.reset();
  if (reason == void_interrupted) return;  // repeated with the same draws
  begin_gap(t_s);
  ++attempt_;
  if (++n_voids_ % max_voids == 0) {
    paused_ = true;
    set_state(SessionState::paused, changes);
  }
}

void Engine::begin_gap(double t_s) {
  if (onset_.gap_s > 0) trial_due_s_ = log_time(t_s + onset_.gap_s);
}

void Engine::set_state(SessionState state, Changes& changes) {
  state_ = state;
  changes.state = state;
}

void Engine::end_rest() {
  rest_.reset();
  rested_ = std::max(rested_, block_);
}

void Engine::enter_block(std::size_t index) {
  run_.reset();
  for (block_ = index; block_ < plan_->blocks.size(); ++block_) {
    const Block& block = plan_->blocks[block_];
    if (const auto* rest = std::get_if<BreakBlock>(&block)) {
      if (block_ >= rested_) rest_ = *rest;
      continue;
    }
    if (const auto* trials = std::get_if<TaskBlock>(&block)) run_ = trials->run(seed_);
    return;
  }
}

std::unique_ptr<TaskTrial> Engine::attempt_at(const TrialPlan& plan) const {
  return std::get<TaskBlock>(plan_->blocks[block_]).trial(plan, seed_);
}

Next Engine::what_next() const {
  Next next;
  if (ended_) return next;
  if (open_) next.plan = open_->plan();
  if (paused_ || open_) {
    next.kind = paused_ ? Next::Kind::paused : Next::Kind::act;
    return next;
  }
  if (block_ >= plan_->blocks.size()) {
    next.kind = Next::Kind::finish;
    return next;
  }
  next.rest = rest_;
  if (const auto* shown = std::get_if<DemonstrationBlock>(&plan_->blocks[block_])) {
    next.kind = Next::Kind::demonstration;
    next.demonstration = *shown;
    return next;
  }
  next.kind = Next::Kind::trial;
  next.plan = run_->plan({seed_, n_completed_ + 1, attempt_});
  return next;
}

ScreenState Engine::screen() const {
  ScreenState screen;
  if (open_)
    screen = open_->screen();
  else if (next_.kind == Next::Kind::trial) {
    screen = screen_of(*attempt_at(*next_.plan));
    screen.feedback = feedback_;
  }
  if (next_.kind == Next::Kind::demonstration) screen.screen = Screen::demonstration;
  if (next_.rest) screen.screen = Screen::rest;
  if (paused_) screen.screen = Screen::paused;
  if (ended_ || next_.kind == Next::Kind::finish) screen.screen = Screen::thanks;
  return screen;
}

ScreenState Engine::screen_with_cubes() const {
  return open_ && !paused_ ? open_->screen(true) : screen();
}

std::optional<std::string> Engine::unfinished_staircase() const {
  return run_ ? run_->unfinished_staircase() : std::nullopt;
}

}  // namespace heft
