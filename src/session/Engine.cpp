#include "session/Engine.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/Error.h"
#include "session/Planning.h"

namespace heft {

Engine::Engine(std::shared_ptr<const Protocol> protocol, std::uint64_t seed)
    : protocol_(std::move(protocol)), seed_(seed) {
  enter_block(0);
  next_ = what_next();
}

std::optional<std::string> Engine::refusal(const Event& event) const {
  if (!(event.t_s >= last_s_))
    return fmt::format("time {} s comes before the last event's {} s", event.t_s, last_s_);
  switch (event.kind) {
    case EventKind::action:
    case EventKind::cubes_reset:
    case EventKind::cubes_shown:
    case EventKind::cube_contact:
    case EventKind::effector_lost:
    case EventKind::effector_found:
      if (!open_) return "no trial is running";
      if (paused_) return "the session is paused";
      return open_->refusal(event);
    case EventKind::trial_started:
    case EventKind::voided:
    case EventKind::paused:
    case EventKind::continued:
    case EventKind::demonstration_shown:
    case EventKind::resumed:
    case EventKind::ended:
      if (over_) return "the session has ended";
      return course_refusal(event);
    default:
      return std::nullopt;  // only kept
  }
}

std::optional<std::string> Engine::course_refusal(const Event& event) const {
  switch (event.kind) {
    case EventKind::trial_started:
      if (next_.kind != Next::Kind::trial) return "no trial is due";
      return std::nullopt;
    case EventKind::demonstration_shown:
      if (next_.kind != Next::Kind::demonstration) return "no demonstration is due";
      return std::nullopt;
    case EventKind::voided:
      if (!open_) return "no trial is running";
      if (event.detail.empty()) return "it gives no reason";
      return std::nullopt;
    case EventKind::paused:
      if (paused_) return "the session is paused already";
      return std::nullopt;
    case EventKind::continued:
      if (!paused_) return "the session is not paused";
      return std::nullopt;
    case EventKind::resumed:
      if (open_) return "the trial that was running must be voided first";
      return std::nullopt;
    case EventKind::ended:
      if (open_) return "a trial is still running";
      if (event.detail == "aborted") return std::nullopt;
      if (event.detail != "finished") return "expected \"finished\" or \"aborted\"";
      if (next_.kind != Next::Kind::finish) return "not everything is done";
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

Changes Engine::apply(const Event& event) {
  if (const auto why = refusal(event)) {
    throw Error(fmt::format("event \"{}\"{} at {} s can't come now: {}", name_of(event.kind),
                            event.detail.empty() ? "" : " (" + event.detail + ")", event.t_s,
                            *why));
  }
  Changes changes;
  if (open_) {
    open_->account(event.t_s, paused_);
    changes.attempt_index = open_->row().attempt_index;
  }
  last_s_ = event.t_s;
  ++n_events_;
  fold(event, changes);
  next_ = what_next();
  return changes;
}

void Engine::fold(const Event& event, Changes& changes) {
  switch (event.kind) {
    case EventKind::trial_started:
      return start_trial(event, changes);
    case EventKind::action:
      return act(event, changes);
    case EventKind::voided:
      return void_trial(event, changes);
    case EventKind::paused:
      paused_ = true;
      return set_state(SessionState::paused, changes);
    case EventKind::continued:
    case EventKind::resumed:
      paused_ = false;
      return set_state(SessionState::running, changes);
    case EventKind::demonstration_shown:
      rest_.reset();
      return enter_block(block_ + 1);
    case EventKind::ended:
      over_ = true;
      return set_state(event.detail == "finished" ? SessionState::finished : SessionState::aborted,
                       changes);
    case EventKind::cubes_shown:
      open_->show(event);
      changes.trial = open_->row();
      return;
    case EventKind::cube_contact:
      open_->touch(event);
      changes.trial = open_->row();
      changes.cubes = {open_->cube(*event.slot)};
      return;
    case EventKind::effector_lost:
      return open_->lose_effector();
    case EventKind::effector_found:
      return open_->find_effector();
    default:
      return;
  }
}

void Engine::start_trial(const Event& event, Changes& changes) {
  open_.emplace(++n_attempts_, *next_.plan, event.t_s, protocol_->require_contact);
  rest_.reset();
  changes.attempt_index = n_attempts_;
  changes.trial = open_->row();
  changes.cubes = open_->cubes();
}

void Engine::act(const Event& event, Changes& changes) {
  const int n_wrong = open_->n_wrong();
  const auto outcome = open_->act(event);
  changes.answers = {
      {open_->row().attempt_index, event.t_s, action_of(event), event.slot, event.label}};
  if (outcome) return complete(event, *outcome, changes);
  const auto* introduction = std::get_if<IntroductionBlock>(&protocol_->blocks[block_]);
  if (introduction && introduction->wrong_answer == WrongAnswer::reshuffle &&
      open_->n_wrong() > n_wrong) {
    const TrialPlan& plan = open_->plan();
    open_->rearrange(plan_introduction(*introduction, {seed_, plan.trial_number, plan.attempt},
                                       open_->n_wrong()));
    changes.cubes = open_->cubes();
  }
  changes.trial = open_->row();
}

void Engine::complete(const Event& event, Outcome outcome, Changes& changes) {
  close(event, TrialStatus::completed, changes);
  changes.trial->outcome = outcome;
  if (staircase_) respond_to_staircase(changes);
  ++n_completed_;
  ++n_in_block_;
  attempt_ = 1;
  n_voids_ = 0;
  if (block_done(protocol_->blocks[block_])) enter_block(block_ + 1);
}

void Engine::respond_to_staircase(Changes& changes) {
  const auto& block = std::get<ComparisonBlock>(protocol_->blocks[block_]);
  Procedure& staircase = staircases_[*staircase_];
  const TrialRow& row = *changes.trial;
  const Update update = staircase.respond(response_to(block, row), *row.plan.level_g);
  const std::string& name = staircase.name();
  if (update.reversal) {
    const Reversal& reversal = *update.reversal;
    changes.reversals = {{name, reversal.number, row.attempt_index, reversal.level,
                          reversal.step_before, reversal.step_after}};
  }
  if (update.finish)
    for (const Estimate& estimate : staircase.estimates())
      changes.estimates.push_back({name, estimate.method, estimate.value, estimate.low,
                                   estimate.high, estimate.n_trials, estimate.n_reversals,
                                   estimate.n_floor, estimate.n_ceiling,
                                   std::string(name_of(*update.finish))});
  previous_staircase_ = staircase_;
}

void Engine::void_trial(const Event& event, Changes& changes) {
  close(event, TrialStatus::voided, changes);
  if (event.detail == void_interrupted) return;  // a crash is nobody's doing: the same draws again
  ++attempt_;
  if (++n_voids_ % max_voids == 0) {
    paused_ = true;
    set_state(SessionState::paused, changes);
  }
}

void Engine::close(const Event& event, TrialStatus status, Changes& changes) {
  open_->close(event, status);
  changes.trial = open_->row();
  open_.reset();
}

void Engine::set_state(SessionState state, Changes& changes) {
  state_ = state;
  changes.state = state;
}

bool Engine::block_done(const Block& block) const {
  if (const auto* sorting = std::get_if<SortingBlock>(&block))
    return n_in_block_ >= sorting->trials;
  if (std::holds_alternative<ComparisonBlock>(block))
    return std::ranges::all_of(staircases_, [](const Procedure& s) { return s.finished(); });
  return true;
}

void Engine::enter_block(std::size_t index) {
  block_ = index;
  n_in_block_ = 0;
  staircases_.clear();
  previous_staircase_.reset();
  staircase_.reset();
  while (block_ < protocol_->blocks.size()) {
    const Block& block = protocol_->blocks[block_];
    if (const auto* rest = std::get_if<BreakBlock>(&block)) {
      rest_ = *rest;
      ++block_;
      continue;
    }
    if (const auto* comparison = std::get_if<ComparisonBlock>(&block))
      for (const auto& entry : comparison->staircases) staircases_.emplace_back(entry.staircase);
    return;
  }
}

Next Engine::what_next() {
  Next next;
  if (over_) return next;
  if (open_) next.plan = open_->plan();
  if (paused_) {
    next.kind = Next::Kind::paused;
    return next;
  }
  if (open_) {
    next.kind = Next::Kind::act;
    return next;
  }
  if (block_ >= protocol_->blocks.size()) {
    next.kind = Next::Kind::finish;
    return next;
  }
  next.rest = rest_;
  next.kind = Next::Kind::trial;
  const Block& block = protocol_->blocks[block_];
  const TrialKey key{seed_, n_completed_ + 1, attempt_};
  if (const auto* demonstration = std::get_if<DemonstrationBlock>(&block)) {
    next.kind = Next::Kind::demonstration;
    next.demonstration = *demonstration;
  } else if (const auto* introduction = std::get_if<IntroductionBlock>(&block)) {
    next.plan = plan_introduction(*introduction, key, 0);
  } else if (const auto* sorting = std::get_if<SortingBlock>(&block)) {
    next.plan = plan_sorting(*sorting, key, n_in_block_);
  } else {
    ComparisonPlan comparison =
        plan_comparison(std::get<ComparisonBlock>(block), key, staircases_, previous_staircase_);
    next.plan = std::move(comparison.plan);
    staircase_ = comparison.staircase;
  }
  return next;
}

ScreenState Engine::screen() const {
  ScreenState screen;
  if (open_) screen = open_->screen();
  if (next_.kind == Next::Kind::demonstration) screen.screen = Screen::demonstration;
  if (next_.rest) screen.screen = Screen::rest;
  if (paused_) screen.screen = Screen::paused;
  if (over_ || next_.kind == Next::Kind::finish) screen.screen = Screen::thanks;
  return screen;
}

std::optional<std::string> Engine::survivor() const {
  const auto unfinished = [](const Procedure& s) { return !s.finished(); };
  if (staircases_.size() < 2 || std::ranges::count_if(staircases_, unfinished) != 1)
    return std::nullopt;
  return std::ranges::find_if(staircases_, unfinished)->name();
}

}  // namespace heft
