#include "record/RowsFromCells.h"

#include "record/Schema.h"

namespace heft {

SessionRow session_from(Cells& cells) {
  SessionRow row;
  row.session_id = cells.id();
  SessionHeader& header = row.header;
  header.participant = cells.text();
  header.protocol_name = cells.text();
  header.protocol_text = cells.text();
  header.protocol_sha256 = cells.text();
  header.seed = static_cast<std::uint64_t>(cells.long_integer());
  header.heft_version = cells.text();
  header.build = cells.text();
  header.run_options = cells.text();
  header.started_utc = cells.text();
  header.purpose = cells.text();
  header.responder = cells.text();
  row.state = cells.name<SessionState>();
  return row;
}

std::pair<std::string, std::string> info_from(Cells& cells) {
  std::string key = cells.text();
  return {std::move(key), cells.text()};
}

LoggedEvent event_from(Cells& cells) {
  LoggedEvent row;
  row.attempt_index = cells.integer();
  row.event.t_s = cells.real();
  row.event.kind = cells.name<EventKind>();
  row.event.slot = cells.integer_or_none();
  row.event.label = cells.name_or_none<Label>();
  row.event.detail = cells.text();
  row.event.value = cells.real_or_none();
  return row;
}

TrialRow trial_from(Cells& cells) {
  TrialRow row;
  row.attempt_index = cells.integer();
  row.plan.trial_number = cells.integer();
  row.plan.attempt = cells.integer();
  row.plan.block = cells.text();
  row.plan.task = cells.name<Task>();
  row.plan.condition = cells.name<Condition>();
  row.plan.staircase = cells.text_or_none().value_or("");
  row.plan.reference_g = cells.real_or_none();
  row.plan.level_g = cells.real_or_none();
  row.plan.is_catch = cells.flag();
  row.plan.n_reshuffles = cells.integer();
  row.status = cells.name<TrialStatus>();
  row.void_reason = cells.text_or_none();
  row.outcome = cells.name_or_none<Outcome>();
  row.chosen_slot = cells.integer_or_none();
  row.plan.reference_slot = cells.integer_or_none();
  row.choice_correct = cells.flag_or_none();
  row.started_s = cells.real();
  row.shown_s = cells.real_or_none();
  row.first_contact_s = cells.real_or_none();
  row.first_choice_s = cells.real_or_none();
  row.validated_s = cells.real_or_none();
  row.paused_s = cells.real();
  row.lost_s = cells.real();
  row.ended_s = cells.real_or_none();
  return row;
}

CubeRow cube_from(Cells& cells) {
  CubeRow row;
  row.attempt_index = cells.integer();
  row.slot = cells.integer();
  row.mass_g = cells.real();
  row.n_pushes = cells.integer();
  row.contact_s = cells.real();
  row.first_contact_s = cells.real_or_none();
  row.last_contact_s = cells.real_or_none();
  return row;
}

AnswerRow answer_from(Cells& cells) {
  AnswerRow row;
  row.attempt_index = cells.integer();
  row.t_s = cells.real();
  row.action = cells.name<ActionKind>();
  row.slot = cells.integer_or_none();
  row.label = cells.name_or_none<Label>();
  return row;
}

ReversalRow reversal_from(Cells& cells) {
  ReversalRow row;
  row.attempt_index = cells.integer();
  row.staircase = cells.text();
  row.number = cells.integer();
  row.level_g = cells.real();
  row.step_before_g = cells.real();
  row.step_after_g = cells.real();
  return row;
}

EstimateRow estimate_from(Cells& cells) {
  EstimateRow row;
  row.staircase = cells.text();
  row.method = cells.text();
  row.jnd_g = cells.real_or_none();
  row.low_g = cells.real_or_none();
  row.high_g = cells.real_or_none();
  row.n_trials = cells.integer();
  row.n_reversals = cells.integer();
  row.n_floor = cells.integer();
  row.n_ceiling = cells.integer();
  row.reason = cells.text();
  return row;
}

FrameRow frame_from(Cells& cells) {
  FrameRow row;
  row.attempt_index = cells.integer();
  row.after_event = cells.integer();
  row.t_s = cells.real();
  row.trial_t_s = cells.real();
  row.capture_s = cells.real();
  row.present_s = cells.real();
  row.tracked = cells.flag();
  row.jump = cells.flag();
  row.contact_slot = cells.integer_or_none();
  row.quality = cells.real_or_none();
  row.state_hash = cells.text();
  row.effector = cells.pose();
  row.effector_velocity.linear_m_s = cells.vector();
  row.effector_velocity.angular_rad_s = cells.vector();
  row.clone = cells.pose_or_none();
  for (int i = 0; i < schema::most_cubes; ++i)
    if (auto cube = cells.pose_or_none()) row.cubes.push_back(*cube);
  row.detected_s = cells.real_or_none();
  row.simulated_s = cells.real_or_none();
  row.n_dropped = cells.integer_or_none();
  return row;
}

}  // namespace heft
