#include "session/Runner.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/Error.h"

namespace heft {

Runner::Runner(const SessionParts& parts, const RunnerOptions& options, double start_s)
    : parts_(parts), options_(options), now_s_(log_time(start_s)) {}

RunEnd Runner::run() {
  for (;;) {
    const Next next = parts_.engine.next();
    if (stopping()) {
      stop_for("stopped by the operator");
      return RunEnd::stopped;
    }
    if (next.rest) {
      now_s_ += next.rest->least_duration_s;
      emit_now(EventKind::rest, next.rest->name, next.rest->least_duration_s);
    }
    switch (next.kind) {
      case Next::Kind::demonstration:
        now_s_ += next.demonstration->duration_s;
        emit_now(EventKind::demonstration_shown, next.demonstration->name);
        break;
      case Next::Kind::trial:
        run_attempt(*next.plan);
        break;
      case Next::Kind::finish:
        emit_now(EventKind::ended, "finished");
        return RunEnd::finished;
      case Next::Kind::act:  // unreachable: run_attempt leaves no trial open
      case Next::Kind::paused:
        parts_.sink.flush();
        return RunEnd::paused;
      case Next::Kind::over:
        return RunEnd::finished;
    }
  }
}

void Runner::run_attempt(const TrialPlan& plan) {
  if (const auto survivor = parts_.engine.survivor(); survivor && survivor != told_survivor_) {
    told_survivor_ = survivor;
    emit_now(EventKind::note, fmt::format("staircase \"{}\" is the last one and runs alone from "
                                          "trial {}",
                                          *survivor, plan.trial_number));
  }
  attempt_start_s_ = now_s_;
  trouble_since_s_.reset();
  emit_now(EventKind::trial_started);
  parts_.responder.begin_trial({plan.trial_number, plan.attempt, plan.task,
                                stage_of(parts_.engine.protocol(), plan.n_slots())});
  parts_.pictures.begin_attempt();
  world_.emplace(parts_.engine.protocol(), plan);
  while (run_picture(plan)) {
  }
}

// One picture. @return whether the attempt goes on.
bool Runner::run_picture(const TrialPlan& plan) {
  if (stopping()) return false;
  const Picture picture = parts_.pictures.next();
  now_s_ = std::max(now_s_, attempt_start_s_ + log_time(picture.sample.t_capture_s));
  if (!picture.trouble.empty() || trouble_since_s_) {
    if (!wait_for_camera(picture)) return false;
    if (!picture.trouble.empty()) return true;
  }
  const int after_event = parts_.engine.n_events();
  ShownPicture shown = world_->advance(picture.sample);
  present(shown, picture, after_event);
  take_actions(shown);
  if (parts_.engine.next().kind != Next::Kind::act) return false;
  if (!parts_.responder.has_more(picture.sample.t_capture_s)) {
    stop_for("the responder has nothing more to do");
    throw Error(
        fmt::format("the responder has nothing more to do in trial {}, but the trial is "
                    "still open; everything so far is saved",
                    plan.trial_number));
  }
  return true;
}

// A dead camera or lost board pauses the trial at once and voids it after void_after_s; the session
// goes on when pictures return. @return whether the attempt goes on.
bool Runner::wait_for_camera(const Picture& picture) {
  const bool open = parts_.engine.trial_is_open();
  if (!trouble_since_s_) {
    trouble_since_s_ = now_s_;
    emit_now(EventKind::paused, picture.trouble);
    parts_.sink.flush();
  } else if (picture.trouble.empty()) {
    trouble_since_s_.reset();
    emit_now(EventKind::continued);
    return open;
  }
  if (open && now_s_ - *trouble_since_s_ > parts_.engine.protocol().void_after_s)
    emit_now(EventKind::voided, picture.trouble);
  DisplayedFrame nothing;
  nothing.t_s = picture.sample.t_capture_s;
  nothing.tracked = false;
  parts_.view.present({nothing, nullptr, {}}, parts_.engine.screen());
  return !parts_.engine.needs_somebody();
}

void Runner::present(const ShownPicture& shown, const Picture& picture, int after_event) {
  const TargetSample& sample = picture.sample;
  for (const Event& event : shown.events) {
    if (event.kind == EventKind::cubes_shown) continue;
    Event in_session = event;
    in_session.t_s += attempt_start_s_;
    emit(in_session, Durability::buffered);
  }
  parts_.view.present({shown.frame, nullptr, {}}, parts_.engine.screen());
  const double present_s = now_s_;
  if (std::ranges::any_of(shown.events,
                          [](const Event& e) { return e.kind == EventKind::cubes_shown; })) {
    now_s_ = std::max(now_s_, log_time(present_s));
    emit_now(EventKind::cubes_shown);
  }
  if (!options_.keep_frames) return;
  FrameRow row;
  row.attempt_index = parts_.engine.n_attempts();
  row.after_event = after_event;
  row.t_s = attempt_start_s_ + log_time(sample.t_capture_s);
  row.trial_t_s = sample.t_capture_s;
  row.capture_s = row.t_s;
  row.present_s = present_s;
  row.tracked = sample.tracked;
  row.jump = sample.jump;
  row.contact_slot = shown.contact_slot;
  row.quality = picture.quality;
  row.state_hash = shown.state_hash;
  row.effector = sample.pose;
  row.effector_velocity = sample.velocity;
  row.clone = shown.frame.clone;
  row.cubes = shown.frame.cubes;
  parts_.sink.add_frame(row);
}

void Runner::take_actions(const ShownPicture& shown) {
  for (const Action& action : parts_.responder.see(shown.frame, parts_.engine.screen())) {
    take_action(action);
    if (parts_.engine.next().kind != Next::Kind::act) return;
  }
}

void Runner::take_action(const Action& action) {
  Event event;
  // A touch keeps its own time, which may lie before the newest picture's, but not before an event.
  event.t_s = std::max(attempt_start_s_ + log_time(action.t_s), parts_.engine.last_s());
  event.kind = EventKind::action;
  event.detail = name_of(action.kind);
  event.slot = action.slot;
  event.label = action.label;
  const TrialPlan before = *parts_.engine.next().plan;
  if (const auto why = parts_.engine.refusal(event)) {
    stop_for("the responder's action was refused");
    throw Error(fmt::format(
        "trial {}: the responder's \"{}\"{} at {:.3f} s can't be taken: {}", before.trial_number,
        event.detail, event.slot ? fmt::format(" of cube {}", *event.slot) : "", action.t_s, *why));
  }
  // What is still being touched is let go of before an answer can close the trial.
  if (parts_.engine.ends_trial(event))
    for (Event ended : world_->end_contacts(event.t_s - attempt_start_s_)) {
      ended.t_s += attempt_start_s_;
      emit(ended, Durability::buffered);
    }
  emit(event, Durability::acknowledged);
  const Next& after = parts_.engine.next();
  if (after.kind == Next::Kind::act && after.plan->n_reshuffles > before.n_reshuffles)
    world_->rearrange(*after.plan);
}

// Leaves the session so that it can be resumed: an open attempt is void and will run again with the
// same draws.
void Runner::stop_for(const std::string& why) {
  if (parts_.engine.trial_is_open()) emit_now(EventKind::voided, std::string(void_interrupted));
  if (parts_.engine.state() != SessionState::paused) emit_now(EventKind::paused, why);
}

void Runner::emit_now(EventKind kind, std::string detail, std::optional<double> value) {
  Event event;
  event.t_s = now_s_;
  event.kind = kind;
  event.detail = std::move(detail);
  event.value = value;
  emit(event, Durability::acknowledged);
}

void Runner::emit(Event event, Durability durability) {
  now_s_ = std::max(now_s_, event.t_s);
  event.t_s = std::max(event.t_s, parts_.engine.last_s());
  const Changes changes = parts_.engine.apply(event);
  parts_.sink.append(event, changes, durability);
  options_.progress(parts_.engine);
}

}  // namespace heft
