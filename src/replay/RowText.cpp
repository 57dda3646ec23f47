#include "replay/RowText.h"

#include <fmt/format.h>

namespace heft {

namespace {

std::string text(bool value) {
  return value ? "1" : "0";
}
std::string text(int value) {
  return fmt::format("{}", value);
}
// Adding 0 turns -0, which the log does not keep, into 0.
std::string text(double value) {
  return fmt::format("{}", value + 0.0);
}
std::string text(const std::string& value) {
  return '"' + value + '"';
}

template <typename Enum>
requires std::is_enum_v<Enum> std::string text(Enum value) {
  return std::string(name_of(value));
}

template <typename T>
std::string text(const std::optional<T>& value) {
  return value ? text(*value) : "NULL";
}

}  // namespace

RowText text_of(const TrialRow& row) {
  const TrialPlan& plan = row.plan;
  return {"trial",
          fmt::format("trial {} attempt {}", plan.trial_number, plan.attempt),
          row.attempt_index,
          -1,
          {{"trial_number", text(plan.trial_number)},
           {"attempt", text(plan.attempt)},
           {"block", text(plan.block)},
           {"task", text(plan.task)},
           {"condition", text(plan.condition)},
           {"staircase", text(plan.staircase)},
           {"reference_g", text(plan.reference_g)},
           {"level_g", text(plan.level_g)},
           {"is_catch", text(plan.is_catch)},
           {"reference_slot", text(plan.reference_slot)},
           {"n_reshuffles", text(plan.n_reshuffles)},
           {"status", text(row.status)},
           {"void_reason", text(row.void_reason)},
           {"outcome", text(row.outcome)},
           {"chosen_slot", text(row.chosen_slot)},
           {"choice_correct", text(row.choice_correct)},
           {"started_s", text(row.started_s)},
           {"shown_s", text(row.shown_s)},
           {"first_contact_s", text(row.first_contact_s)},
           {"first_choice_s", text(row.first_choice_s)},
           {"validated_s", text(row.validated_s)},
           {"paused_s", text(row.paused_s)},
           {"lost_s", text(row.lost_s)},
           {"ended_s", text(row.ended_s)}}};
}

RowText text_of(const CubeRow& row) {
  return {"cube",
          fmt::format("cube {} of attempt {}", row.slot, row.attempt_index),
          row.attempt_index,
          -1,
          {{"mass_g", text(row.mass_g)},
           {"n_pushes", text(row.n_pushes)},
           {"contact_s", text(row.contact_s)},
           {"first_contact_s", text(row.first_contact_s)},
           {"last_contact_s", text(row.last_contact_s)}}};
}

RowText text_of(const AnswerRow& row, int number) {
  return {"answer",
          fmt::format("answer {}", number),
          row.attempt_index,
          row.t_s,
          {{"attempt", text(row.attempt_index)},
           {"t_s", text(row.t_s)},
           {"action", text(row.action)},
           {"slot", text(row.slot)},
           {"label", text(row.label)}}};
}

RowText text_of(const ReversalRow& row) {
  return {"reversal",
          fmt::format("reversal {} of staircase \"{}\"", row.number, row.staircase),
          row.attempt_index,
          -1,
          {{"attempt", text(row.attempt_index)},
           {"level_g", text(row.level_g)},
           {"step_before_g", text(row.step_before_g)},
           {"step_after_g", text(row.step_after_g)}}};
}

RowText text_of(const EstimateRow& row) {
  return {"estimate",
          fmt::format("estimate of staircase \"{}\"", row.staircase),
          0,
          -1,
          {{"method", text(row.method)},
           {"jnd_g", text(row.jnd_g)},
           {"low_g", text(row.low_g)},
           {"high_g", text(row.high_g)},
           {"n_trials", text(row.n_trials)},
           {"n_reversals", text(row.n_reversals)},
           {"n_floor", text(row.n_floor)},
           {"n_ceiling", text(row.n_ceiling)},
           {"reason", text(row.reason)}}};
}

std::string text_of(const Event& event) {
  return fmt::format("{} {} slot {} label {} at {} s, value {}", name_of(event.kind),
                     text(event.detail), text(event.slot), text(event.label), event.t_s,
                     text(event.value));
}

}  // namespace heft
