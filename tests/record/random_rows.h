// Random rows of valid values, and comparison of written and read rows.
#pragma once

#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "record/rows.h"
#include "record/schema/RowSql.h"
#include "tasks/Task.h"

namespace heft::test {

inline rc::Gen<double> any_number() {
  const auto from_bits = rc::gen::map(rc::gen::arbitrary<std::uint64_t>(), [](std::uint64_t bits) {
    return std::bit_cast<double>(bits);
  });
  using Limits = std::numeric_limits<double>;
  return rc::gen::suchThat(
      rc::gen::oneOf(from_bits,
                     rc::gen::element(0.0, -0.0, 1.0, 3.0, 0.1, Limits::max(), Limits::lowest(),
                                      Limits::min(), Limits::denorm_min(), Limits::infinity(),
                                      9007199254740993.0, 1e15, -1e300)),
      [](double value) { return !std::isnan(value); });
}

// -0.0 becomes 0.0, as in SQLite's REAL columns.
inline double number() {
  return *any_number() + 0.0;
}
/// A number of a setup, which is JSON and has no infinity.
inline double finite_number() {
  return *rc::gen::suchThat(any_number(), [](double value) { return std::isfinite(value); }) + 0.0;
}
inline double time_s() {
  return std::abs(number());
}

inline double mass_g() {
  return *rc::gen::suchThat(
      rc::gen::map(any_number(), [](double value) { return std::abs(value); }),
      [](double value) { return value > 0; });
}

inline std::string words() {
  return *rc::gen::oneOf(rc::gen::string<std::string>(),
                         rc::gen::element<std::string>("", "naïve – 質量 🧊", "a'b\"c;--\n",
                                                       "NULL", std::string("a\0b", 3)));
}

/// Texts that JSON preserves.
inline std::string plain() {
  return *rc::gen::element<std::string>("", "naïve – 質量 🧊", "a'b\"c;--\n", "\\ {}");
}

template <typename Value>
std::optional<Value> maybe(Value (*make)()) {
  return *rc::gen::arbitrary<bool>() ? std::optional(make()) : std::nullopt;
}

inline int slot() {
  return *rc::gen::inRange(1, 4);
}
inline int count() {
  return *rc::gen::oneOf(rc::gen::inRange(0, 100), rc::gen::just(2147483647));
}
inline bool flag() {
  return *rc::gen::arbitrary<bool>();
}

template <typename Listed>
Listed any_of() {
  if constexpr (is_word<Listed>) {  // of one task: a log has words of tasks with trials only
    const auto words = words_for(closed_list<Listed>, task_named("sorting"));
    return words.at(*rc::gen::inRange<std::size_t>(0, words.size()));
  } else {
    const auto n = static_cast<int>(EnumNames<Listed>::names.size());
    return static_cast<Listed>(*rc::gen::inRange(0, n));
  }
}

// With both signs of zero.
inline Eigen::Vector3d exact_vector() {
  const double x = *any_number(), y = *any_number(), z = *any_number();
  return {x, y, z};
}

inline Pose exact_pose() {
  Pose made;
  made.position_m = exact_vector();
  const double w = *any_number(), x = *any_number(), y = *any_number(), z = *any_number();
  made.orientation = Eigen::Quaterniond(w, x, y, z);
  return made;
}

inline Pose pose() {
  Pose made;
  const double px = number(), py = number(), pz = number();
  made.position_m = {px, py, pz};
  const double w = number(), x = number(), y = number(), z = number();
  made.orientation = Eigen::Quaterniond(w, x, y, z);
  return made;
}

inline SessionConfig any_setup() {
  SessionConfig setup;
  setup.responder = Plug{"model", plain()};
  setup.simulator = plain();
  setup.rate_hz = maybe(finite_number);
  setup.display_w_px = maybe(count);
  setup.language = plain();
  setup.board.path = plain();
  setup.board.text = plain();
  setup.settings = {{"key", "a'b\"c;--=1"}};
  setup.hand = maybe(any_of<Side>);
  setup.keys = maybe(any_of<TakesKeys>);
  setup.participant_parameters["p"] = finite_number();
  setup.display_latency_ms["light_ms"] = finite_number();
  return setup;
}

inline EventPayload any_payload() {
  switch (*rc::gen::inRange(0, 13)) {
    case 0:
      return Action{any_of<ActionKind>(), maybe(slot), maybe(any_of<Label>), maybe(number)};
    case 1:
      return TrialVoided{words()};
    case 2:
      return CubesReset{maybe(slot)};
    case 3:
      return SessionResumed{words(), time_s()};
    case 4:
      return SessionEnded{any_of<Ending>()};
    case 5:
      return CubeTouch{slot(), maybe(time_s), maybe(time_s), maybe(time_s)};
    case 6:
      return Consent{flag(), plain(), plain()};
    case 7:
      return TextShown{plain(), plain(), plain()};
    case 8:
      return BreakTaken{words(), time_s()};
    case 9:
      return CameraReport{count(), count(), count(), maybe(count)};
    case 10:
      return CheckResult{any_of<CheckVerdict>(), plain(), plain()};
    case 11:
      return any_setup();
    default:
      return Note{words()};
  }
}

inline Event any_event() {
  return {time_s(), any_payload()};
}

inline TrialRow any_trial(int attempt_index) {
  TrialRow row;
  row.attempt_index = attempt_index;
  TrialPlan& plan = row.plan;
  plan.trial_number = count() / 2 + 1;
  plan.attempt = count() / 2 + 1;
  plan.block = words();
  plan.task = any_of<Task>();
  plan.condition = words();
  plan.staircase = words();
  plan.reference_g = maybe(mass_g);
  plan.level_g = maybe(number);
  plan.is_catch = flag();
  plan.is_practice = flag();
  plan.n_reshuffles = count();
  plan.masses_g.resize(static_cast<std::size_t>(*rc::gen::inRange(0, 7)));
  for (double& mass : plan.masses_g) mass = mass_g();
  if (flag()) plan.table_friction.resize(plan.masses_g.size());
  for (double& friction : plan.table_friction) friction = time_s();
  plan.reference_slot = maybe(slot);
  row.status = any_of<TrialStatus>();
  row.void_reason = maybe(words);
  row.outcome = maybe(any_of<Outcome>);
  row.chosen_slot = maybe(slot);
  row.choice_correct = maybe(flag);
  row.value = maybe(number);
  row.started_s = time_s();
  row.shown_s = maybe(time_s);
  row.first_contact_s = maybe(time_s);
  row.first_choice_s = maybe(time_s);
  row.validated_s = maybe(time_s);
  row.ended_s = maybe(time_s);
  row.paused_s = time_s();
  row.lost_s = time_s();
  return row;
}

inline CubeRow any_cube(const TrialRow& trial, int slot) {
  const auto index = static_cast<std::size_t>(slot - 1);
  const std::vector<double>& friction = trial.plan.table_friction;
  return {trial.attempt_index,
          slot,
          trial.plan.masses_g.at(index),
          count(),
          time_s(),
          maybe(time_s),
          maybe(time_s),
          count(),
          maybe(time_s),
          maybe(time_s),
          friction.empty() ? std::nullopt : std::optional(friction.at(index))};
}

inline FrameRow any_frame(int attempt_index) {
  FrameRow row;
  row.attempt_index = attempt_index;
  row.after_event = count();
  row.t_s = time_s();
  row.trial_t_s = number();
  row.capture_s = number();
  row.present_s = number();
  row.tracked = flag();
  row.jump = flag();
  row.contact_slot = maybe(slot);
  row.quality = maybe(number);
  row.state_hash = words();
  row.effector = exact_pose();
  row.effector_velocity = {exact_vector(), exact_vector()};
  row.clone = maybe(pose);
  row.cubes.resize(static_cast<std::size_t>(*rc::gen::inRange(0, 7)));
  for (Pose& cube : row.cubes) cube = pose();
  row.detected_s = maybe(number);
  row.simulated_s = maybe(number);
  row.n_dropped = maybe(count);
  return row;
}

inline SessionHeader any_header() {
  SessionHeader header = header_of(words());
  header.protocol_text = words();
  header.run_options = words();
  header.seed = *rc::gen::arbitrary<std::uint64_t>() >> 1;
  header.participant_info[words()] = words();
  header.participant_info["age"] = words();
  return header;
}

// Compares written and read rows.
struct Written {
  std::vector<LoggedEvent> events;
  std::vector<TrialRow> trials;
  std::vector<CubeRow> cubes;
  std::vector<AnswerRow> answers;
  std::vector<ReversalRow> reversals;
  std::vector<EstimateRow> estimates;
};

inline Changes any_changes(const TrialRow& trial, int number, Written& written) {
  Changes changes = starting(trial);
  for (int slot = 1; slot <= trial.plan.n_slots(); ++slot)
    changes.cubes.push_back(any_cube(trial, slot));
  changes.answers.push_back({trial.attempt_index, time_s(), any_of<ActionKind>(), maybe(slot),
                             maybe(any_of<Label>), maybe(heft::test::number)});
  changes.reversals.push_back({trial.attempt_index, words(), number, heft::test::number(),
                               heft::test::number(), heft::test::number()});
  changes.estimates.push_back({words() + std::to_string(number), words(), maybe(heft::test::number),
                               maybe(heft::test::number), maybe(heft::test::number), count(),
                               count(), count(), count(), any_of<StopReason>(),
                               maybe(any_of<Censored>)});
  written.trials.push_back(trial);
  const auto add = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  add(written.cubes, changes.cubes);
  add(written.answers, changes.answers);
  add(written.reversals, changes.reversals);
  add(written.estimates, changes.estimates);
  return changes;
}

}  // namespace heft::test
