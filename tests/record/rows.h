// Rows as texts with all bits of numbers, and a small session.
#pragma once

#include <fmt/format.h>

#include <string>
#include <type_traits>
#include <vector>

#include "record/reader/LogReader.h"
#include "record/schema/EventRow.h"
#include "record/stream/EventSink.h"

namespace heft::test {

std::string text(const Eigen::Vector3d& v);
std::string text(const Pose& pose);
std::string text(const LoggedEvent& e);
std::string text(const TrialRow& t);
std::string text(const CubeRow& c);
std::string text(const AnswerRow& a);
std::string text(const ReversalRow& r);
std::string text(const EstimateRow& e);
std::string text(const FrameRow& f);
std::string text(const Event& e);

inline std::string text(double value) {
  return fmt::format("{:a}", value);
}
inline std::string text(bool value) {
  return value ? "true" : "false";
}
inline std::string text(int value) {
  return std::to_string(value);
}
inline std::string text(const std::string& value) {
  return fmt::format("\"{}\"", value);
}
template <typename Enum>
requires std::is_enum_v<Enum> std::string text(Enum value) {
  return std::string(name_of(value));
}
template <typename Value>
std::string text(const std::optional<Value>& value) {
  return value ? text(*value) : "none";
}
inline std::string text(const Eigen::Vector3d& v) {
  return fmt::format("{:a} {:a} {:a}", v.x(), v.y(), v.z());
}
inline std::string text(const Pose& pose) {
  const auto& q = pose.orientation;
  return fmt::format("[{} {:a} {:a} {:a} {:a}]", text(pose.position_m), q.w(), q.x(), q.y(), q.z());
}
template <typename Value>
std::string text(const std::vector<Value>& values) {
  std::string all;
  for (const Value& value : values) all += text(value) + "; ";
  return all;
}

template <typename... Values>
std::string joined(const Values&... values) {
  std::string all;
  ((all += text(values) + ", "), ...);
  return all;
}

inline std::string text(const Event& e) {
  const EventRow row = row_of(e);
  return joined(row.t_s, row.kind, row.slot, row.label, row.detail, row.value,
                row.max_push_displacement_m, row.peak_lag_m);
}
inline std::string text(const LoggedEvent& e) {
  return joined(e.attempt_index, e.event);
}
inline std::string text(const TrialRow& t) {
  const TrialPlan& p = t.plan;
  return joined(t.attempt_index, t.setup_index, p.trial_number, p.attempt, p.block, p.task,
                p.condition, p.staircase, p.reference_g, p.level_g, p.is_catch, p.is_practice,
                p.masses_g, p.table_friction, p.reference_slot, p.n_reshuffles, t.status,
                t.void_reason, t.outcome, t.chosen_slot, t.choice_correct, t.value, t.started_s,
                t.shown_s, t.first_contact_s, t.first_choice_s, t.validated_s, t.ended_s,
                t.paused_s, t.lost_s);
}
inline std::string text(const CubeRow& c) {
  return joined(c.attempt_index, c.slot, c.mass_g, c.n_pushes, c.contact_s, c.first_contact_s,
                c.last_contact_s, c.n_resets, c.max_push_displacement_m, c.peak_lag_m,
                c.table_friction);
}
inline std::string text(const AnswerRow& a) {
  return joined(a.attempt_index, a.t_s, a.action, a.slot, a.label, a.value);
}
inline std::string text(const ReversalRow& r) {
  return joined(r.staircase, r.number, r.attempt_index, r.level_g, r.step_before_g, r.step_after_g);
}
inline std::string text(const EstimateRow& e) {
  return joined(e.staircase, e.method, e.jnd_g, e.low_g, e.high_g, e.n_trials, e.n_reversals,
                e.n_floor, e.n_ceiling, e.reason, e.censored);
}
inline std::string text(const FrameRow& f) {
  return joined(f.attempt_index, f.after_event, f.t_s, f.trial_t_s, f.capture_s, f.present_s,
                f.tracked, f.jump, f.contact_slot, f.quality, f.state_hash, f.effector,
                f.effector_velocity.linear_m_s, f.effector_velocity.angular_rad_s, f.clone, f.cubes,
                f.detected_s, f.simulated_s, f.n_dropped);
}
inline std::string text(const SessionHeader& h) {
  std::string all = joined(h.participant, h.protocol_name, h.protocol_text, h.protocol_sha256,
                           std::to_string(h.seed), h.heft_version, h.build, h.run_options,
                           h.purpose, h.responder, h.started_utc);
  for (const auto& [key, value] : h.participant_info) all += joined(key, value);
  return all;
}

/// All rows of a session.
inline std::string whole_session(const LogReader& reader, std::int64_t session_id) {
  const SessionRow session = reader.session(session_id);
  std::string all = text(session.header) + text(session.state) + '\n';
  all += text(reader.events(session_id)) + '\n' + text(reader.trials(session_id)) + '\n' +
         text(reader.cubes(session_id)) + '\n' + text(reader.answers(session_id)) + '\n' +
         text(reader.reversals(session_id)) + '\n' + text(reader.estimates(session_id)) + '\n' +
         text(reader.frames(session_id, 0)) + '\n';
  for (const TrialRow& trial : reader.trials(session_id))
    all += text(reader.frames(session_id, trial.attempt_index)) + '\n';
  return all;
}

inline SessionHeader header_of(const std::string& participant) {
  SessionHeader header;
  header.participant = participant;
  header.protocol_name = "paper";
  header.protocol_text = "title = \"Wahrgenommene Masse\"\n";
  header.protocol_sha256 = "0123";
  header.seed = 0x7fffffffffffffffULL;
  header.heft_version = "0.1.0";
  header.build = "a build";
  header.run_options = R"({"view":"headless"})";
  header.purpose = Purpose::test;
  header.responder = "coin";
  header.started_utc = "2026-01-02T03:04:05.678Z";
  return header;
}

inline Event event(double t_s, EventKind kind, std::string detail = "") {
  EventRow row;
  row.t_s = t_s;
  row.kind = kind;
  row.detail = std::move(detail);
  return event_of(row);
}

inline Event action(double t_s, ActionKind kind, std::optional<int> slot = std::nullopt,
                    std::optional<Label> label = std::nullopt) {
  return {t_s, Action{std::move(kind), slot, std::move(label)}};
}

inline AnswerRow answer_of(int attempt_index, const Event& event) {
  const Action& action = *event.as<Action>();
  return {attempt_index, event.t_s, action.kind, action.slot, action.label, action.value};
}

/// An open sorting trial of 15, 200 and 800 g.
inline TrialRow sorting_trial(int attempt_index, double started_s) {
  TrialRow trial;
  trial.attempt_index = attempt_index;
  trial.plan.trial_number = attempt_index;
  trial.plan.block = "sorting";
  trial.plan.task = "sorting";
  trial.plan.masses_g = {800, 15, 200};
  trial.started_s = started_s;
  return trial;
}

inline Changes starting(const TrialRow& trial) {
  Changes changes;
  changes.attempt_index = trial.attempt_index;
  changes.trial = trial;
  return changes;
}

inline Changes of_attempt(int attempt_index) {
  Changes changes;
  changes.attempt_index = attempt_index;
  return changes;
}

inline FrameRow frame(int attempt_index, double t_s) {
  FrameRow made;
  made.attempt_index = attempt_index;
  made.t_s = made.trial_t_s = made.capture_s = made.present_s = t_s;
  made.state_hash = "0123456789abcdef";
  made.effector.position_m = {0.1 + t_s, 0.2 + t_s, 0.3 + t_s};
  made.effector.orientation = {0.7, 0.1, 0.2, 0.3};
  made.clone = made.effector;
  made.cubes.assign(3, made.effector);
  return made;
}

}  // namespace heft::test
