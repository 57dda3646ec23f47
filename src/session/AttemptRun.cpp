#include "session/AttemptRun.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/Error.h"
#include "responders/decision/KnownPlan.h"
#include "session/DisplayCheck.h"

namespace heft {

namespace {
constexpr double longest_wait_s = 0.02;
constexpr double longest_unseen_s = 120;  // with no experimenter to act on it

// Copies a picture's effector sample to a frame's row.
FrameRow row_of(const Picture& picture, double start_s) {
  const TargetSample& sample = picture.sample;
  FrameRow row;
  row.t_s = row.capture_s = start_s + log_time(sample.t_capture_s);
  row.trial_t_s = sample.t_capture_s;
  row.tracked = sample.tracked;
  row.jump = sample.jump;
  row.quality = picture.quality;
  row.effector = sample.pose;
  row.effector_velocity = sample.velocity;
  return row;
}

}  // namespace

TrialView trial_view(const SessionParts& parts, const TrialPlan& plan) {
  TrialView view{plan.trial_number,
                 plan.attempt,
                 plan.task,
                 stage_of(parts.protocol, plan.n_slots()),
                 parts.engine.screen().offer,
                 parts.engine.last_differed()};
  if (parts.responder.knows_plan()) view.truth = truth_of(parts.protocol, plan);
  view.lifted_g = plan.real_reference_g();
  view.n_reshuffles = plan.n_reshuffles;
  return view;
}

AttemptRun::AttemptRun(const SessionParts& parts, const RunnerOptions& options, Journal& journal,
                       SessionControl& control, ParticipantScreen& screen)
    : parts_(parts), options_(options), journal_(journal), control_(control), screen_(screen) {}

void AttemptRun::run(const TrialPlan& plan) {
  const Protocol& protocol = parts_.protocol;
  journal_.emit_now(TrialStarted{});
  seen_s_ = start_s_ = engine().last_s();
  parts_.responder.begin_trial(trial_view(parts_, plan));
  parts_.pictures.begin_attempt({start_s_, plan.trial_number, plan.attempt});
  n_continued_ = journal_.n_continued();
  world_.emplace(protocol, plan);
  while (run_picture()) {
  }
  report_pictures();
}

bool AttemptRun::trial_continues() const {
  return engine().next().kind == Next::Kind::act;
}

// While the camera is lost, the session is paused and no attempt can start. A trial that is voided
// then ends when pictures return.
bool AttemptRun::has_ended() const {
  return !engine().trial_is_open() && !trouble_since_s_;
}

// Runs one picture. @return whether the attempt continues.
bool AttemptRun::run_picture() {
  const auto picture = next_picture();
  if (!picture) return false;
  FrameRow row = row_of(*picture, start_s_);
  if (parts_.clock.is_wall()) row.detected_s = journal_.now_s();
  parts_.clock.advance_to(row.t_s);
  require_sight(row);
  if (!picture->trouble.empty() || trouble_since_s_) {
    if (!wait_for_camera(*picture)) return false;
    if (!picture->trouble.empty()) return true;
  }
  row.after_event = engine().n_events();
  const ShownFrame shown = world_->advance(picture->sample);
  if (parts_.clock.is_wall()) row.simulated_s = journal_.now_s();
  show(shown, *picture, row);
  take_actions(shown);
  if (!trial_continues()) return false;
  if (!parts_.texts && !parts_.responder.has_more(picture->sample.t_capture_s)) {
    control_.leave("the responder has no more actions");
    throw Error(
        fmt::format("the responder has no more actions in trial {}, but the trial is "
                    "still open; everything so far is saved",
                    engine().next().plan->trial_number));
  }
  return true;
}

// The next picture, at its time. None: the attempt has ended, or the session is being left.
std::optional<Picture> AttemptRun::next_picture() {
  for (;;) {
    control_.wait_while_held();
    if (control_.leaving() || has_ended()) return std::nullopt;
    listen();
    if (auto picture = parts_.pictures.next()) {
      if (!wait_until(start_s_ + picture->sample.t_capture_s)) return std::nullopt;
      if (journal_.n_continued() == n_continued_) return picture;
      continue;  // taken before a pause
    }
    if (parts_.pictures.ended()) {
      control_.leave("the pictures have ended");
      throw Error("the pictures have ended but the session has not; everything so far is saved");
    }
    take_touches(control_.wait(look_up_s));
    if (has_ended()) return std::nullopt;
  }
}

// Pictures of a pause are neither caught up with nor counted.
void AttemptRun::listen() {
  if (parts_.clock.is_wall()) parts_.pictures.skip_to(parts_.clock.now_s() - start_s_);
  if (journal_.n_continued() == n_continued_) return;
  n_continued_ = journal_.n_continued();
  parts_.pictures.restart_count();
}

// Waits on a wall clock. @return whether the attempt continues
bool AttemptRun::wait_until(double t_s) {
  if (!parts_.clock.is_wall()) return true;
  do {
    take_touches(control_.wait(std::clamp(t_s - parts_.clock.now_s(), 0.0, longest_wait_s)));
    if (has_ended() || control_.leaving()) return false;
  } while (parts_.clock.now_s() < t_s);
  return true;
}

// A model would wait forever for an effector that its camera never shows.
void AttemptRun::require_sight(const FrameRow& row) {
  if (row.tracked || parts_.clock.is_wall()) seen_s_ = row.t_s;
  if (row.t_s - seen_s_ <= longest_unseen_s) return;
  control_.leave("the effector was not seen");
  throw Error(
      fmt::format("the effector was in no picture for {:g} s, and there is no experimenter to ask; "
                  "everything so far is saved. Check the camera's file, its pictures and the "
                  "effector's file: heft doctor, heft track",
                  longest_unseen_s));
}

// A lost camera or board pauses the trial immediately and voids it after void_after_s; the session
// continues when pictures return. @return whether the attempt continues.
bool AttemptRun::wait_for_camera(const Picture& picture) {
  const bool open = engine().trial_is_open();
  control_.status.trouble = picture.trouble;
  if (!trouble_since_s_) {
    trouble_since_s_ = journal_.now_s();
    journal_.emit_now(SessionPaused{picture.trouble});
    journal_.flush();
  } else if (picture.trouble.empty()) {
    trouble_since_s_.reset();
    journal_.emit_now(SessionContinued{});
    return open;
  }
  if (open && journal_.now_s() - *trouble_since_s_ > parts_.protocol.void_after_s)
    journal_.emit_now(TrialVoided{picture.trouble});
  ViewFrame nothing;
  nothing.frame.t_s = picture.sample.t_capture_s;
  nothing.frame.tracked = false;
  screen_.present(nothing, engine().screen());
  return !engine().needs_experimenter();
}

void AttemptRun::show(const ShownFrame& shown, const Picture& picture, FrameRow& row) {
  const auto is_cubes_shown = [](const Event& e) { return e.as<CubesShown>() != nullptr; };
  std::vector<Event> events = shown.events;
  const bool cubes_appear = std::erase_if(events, is_cubes_shown) > 0;
  log_events(events);
  shown_ = {shown.frame, picture.camera, picture.camera_from_board};
  const auto presented =
      screen_.present(shown_, cubes_appear ? engine().screen_with_cubes() : engine().screen());
  row.present_s = presented && parts_.clock.is_wall() ? log_time(parts_.clock.session_s(*presented))
                                                      : journal_.now_s();
  row.clone_offset_px = screen_.clone_offset_px();
  if (cubes_appear) journal_.emit({row.present_s, CubesShown{}}, Durability::acknowledged);
  row.attempt_index = engine().n_attempts();
  row.contact_slot = shown.contact_slot;
  row.state_hash = shown.state_hash;
  row.clone = shown.frame.clone;
  row.cubes = shown.frame.cubes;
  if (parts_.clock.is_wall()) row.n_dropped = picture.n_dropped;
  count_frame(picture, row);
  if (options_.keep_frames) journal_.add_frame(row);
}

// Logs the world's events, in session time.
void AttemptRun::log_events(const std::vector<Event>& events) {
  for (Event event : events) {
    event.t_s += start_s_;
    journal_.emit(event, Durability::buffered);
  }
}

void AttemptRun::count_frame(const Picture& picture, const FrameRow& row) {
  const double late_s = late_periods / parts_.protocol.display_rate_hz;
  const int late = row.present_s - row.capture_s > late_s ? 1 : 0;
  ++n_shown_;
  n_dropped_ += picture.n_dropped;
  n_late_ += late;
  n_doubled_ += picture.doubled ? 1 : 0;
  ConsoleStatus& status = control_.status;
  status.trouble.clear();
  status.n_dropped += picture.n_dropped;
  status.n_late += late;
  double rate = status.tracking ? status.tracking->frames_per_s : 0;
  if (presented_s_ && row.present_s > *presented_s_) {
    const double newest = 1 / (row.present_s - *presented_s_);
    rate = rate > 0 ? 0.9 * rate + 0.1 * newest : newest;
  }
  status.tracking = {row.tracked, row.quality, rate};
  presented_s_ = row.present_s;
}

// On a virtual clock no picture is dropped or late.
void AttemptRun::report_pictures() {
  if (!parts_.clock.is_wall() && n_doubled_ == 0) return;
  journal_.emit_now(CameraReport{n_shown_, n_dropped_, n_late_, n_doubled_});
}

void AttemptRun::take_touches(const std::vector<Touch>& touches) {
  if (!parts_.texts) return;  // a model answers; touches of spectators are ignored
  if (!presented_s_) return;  // meant for the previous screen
  bool changed = false;
  for (const Touch& touch : touches) {
    if (!trial_continues()) break;  // meant for a screen that has gone
    changed = take_touch(touch) || changed;
  }
  control_.wait_while_held();  // an answer is shown once it is on disk
  if (changed && trial_continues()) screen_.present(shown_, engine().screen());
}

// @return whether the screen may have changed
bool AttemptRun::take_touch(const Touch& touch) {
  if (touch.page != engine().screen().page()) return false;  // meant for the previous page
  if (touch.kind == TouchKind::put_cubes_back) {
    put_cubes_back();
    return false;
  }
  if (touch.kind != TouchKind::action) return false;
  const double t_s =
      std::max(log_time(parts_.clock.session_s(touch.monotonic_s)), engine().last_s());
  const std::string refusal = answer(touch.action, t_s);
  if (refusal.empty()) return true;
  journal_.emit({t_s, ActionRefused{touch.action, refusal}}, Durability::acknowledged);
  return false;
}

void AttemptRun::put_cubes_back() {
  const Admission admission = engine().admit({journal_.now_s(), CubesReset{}});
  if (!admission.admitted) return;  // the cubes have not appeared yet
  if (journal_.emit(*admission.admitted, Durability::acknowledged).empty()) world_->request_reset();
}

void AttemptRun::take_actions(const ShownFrame& shown) {
  const std::vector<TimedAction> actions = parts_.responder.see(shown.frame, engine().screen());
  if (parts_.texts) return;  // a person answers; only the model's hand is used
  for (const TimedAction& action : actions) {
    // The action's time may precede the newest picture's, but not the last event's.
    const double t_s = std::max(start_s_ + log_time(action.t_s), engine().last_s());
    const std::string refusal = answer(action, t_s);
    if (!refusal.empty()) refuse_model(action, refusal);
    if (!trial_continues()) return;
  }
}

// An invalid action of a model is a defect of the model.
void AttemptRun::refuse_model(const TimedAction& action, const std::string& why) {
  const int trial_number = engine().next().plan->trial_number;
  control_.leave("the responder's action was refused");
  throw Error(fmt::format("trial {}: the responder's \"{}\"{} at {:.3f} s is refused: {}",
                          trial_number, name_of(action.kind),
                          action.slot ? fmt::format(" of cube {}", *action.slot) : "", action.t_s,
                          why));
}

// @return the reason for refusing it; empty: accepted
std::string AttemptRun::answer(const Action& action, double t_s) {
  const Admission admission = engine().admit({t_s, action});
  if (!admission.admitted) return admission.refusal;
  const int n_reshuffles = engine().next().plan->n_reshuffles;
  // Contacts end before the answer that closes the trial.
  if (engine().ends_trial(action)) log_events(world_->end_contacts(t_s - start_s_));
  if (std::string why = journal_.emit(*admission.admitted, Durability::acknowledged); !why.empty())
    return why;
  const Next& after = engine().next();
  if (after.kind == Next::Kind::act && after.plan->n_reshuffles > n_reshuffles) {
    world_->rearrange(*after.plan);
    parts_.responder.see_rearranged(trial_view(parts_, *after.plan));
  }
  return {};
}

}  // namespace heft
