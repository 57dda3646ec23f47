#include "session/Runner.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/Error.h"
#include "session/AttemptRun.h"
#include "session/DisplayCheck.h"
#include "session/SurrogateAttempt.h"

namespace heft {

Runner::Runner(const SessionParts& parts, const RunnerOptions& options)
    : parts_(parts),
      options_(options),
      journal_(parts.engine, parts.sink, parts.clock, options.progress),
      screen_(journal_, parts.view, parts.texts, parts.asked),
      control_(journal_, screen_, options, parts.has_screen, parts.texts != nullptr,
               parts.protocol.void_after_s),
      pages_(parts.protocol, journal_, control_, screen_, parts.texts, parts.before,
             {&parts.responder, parts.asked}) {
  control_.on_check([this] { check_apparatus(); });
  // The engine knows the protocol's breaks, but not a requested one.
  if (parts.before.in_break && !parts.engine.next().rest) control_.want_rest();
}

RunEnd Runner::run() {
  const RunEnd end = begin() ? run_blocks() : RunEnd::declined;
  if (end == RunEnd::stopped) journal_.leave("stopped by the operator");
  control_.save();
  if (end == RunEnd::finished && pages_.has_reader()) pages_.thanks();
  return end;
}

// Repeats the checks until none fails, or the experimenter decides.
void Runner::check_apparatus() {
  for (;;) {
    const std::string failed = failed_checks();
    if (failed.empty()) return;
    const SessionControl::Answer answer = ask_whether_failures_matter();
    if (answer == SessionControl::Answer::check) continue;
    const bool asked = answer != SessionControl::Answer::no_one_there;
    if (!asked && !options_.ignore_failed_checks) refuse_unchecked(failed);
    const std::string who = asked ? "the experimenter" : "without an experimenter the session";
    const bool continues = answer != SessionControl::Answer::leave;
    return journal_.emit_now(Note{
        fmt::format("failed check: {}; {} {}", failed, who, continues ? "continues" : "leaves")});
  }
}

// @return names of the failed checks, as printed and logged
std::string Runner::failed_checks() {
  std::string failed;
  const bool measures_display = parts_.view.display().has_value();
  const ScreenState setting_up{.screen = Screen::setting_up};
  if (measures_display || (parts_.has_screen && parts_.pictures.has_checks())) {
    screen_.present({}, setting_up);
    if (options_.console) options_.console->say("checking camera and display: a few seconds");
  }
  const std::vector<CheckResult> results = check_equipment(
      {parts_.protocol, parts_.pictures, parts_.responder, parts_.view, parts_.clock});
  if (measures_display) screen_.present({}, setting_up);
  for (const CheckResult& result : results) {
    journal_.emit_now(result);
    const bool has_failed = result.verdict == CheckVerdict::failed;
    if (options_.console)
      options_.console->say(fmt::format("{:<8} {}: {}",
                                        has_failed ? "FAILED" : name_of(result.verdict),
                                        result.name, result.finding));
    if (has_failed) failed += (failed.empty() ? "" : ", ") + result.name;
  }
  return failed;
}

SessionControl::Answer Runner::ask_whether_failures_matter() {
  const std::string shown = screen_.shown() ? "" : "; the participant has seen nothing yet";
  return control_.ask_to_continue("continue? y continues, n leaves, r checks again" + shown);
}

void Runner::refuse_unchecked(const std::string& failed) {
  journal_.emit_now(Note{fmt::format("failed check: {}; no experimenter to ask", failed)});
  control_.leave("failed check: " + failed);
  throw Error(fmt::format(
      "the check of the apparatus failed ({}), and without a terminal there is no one to "
      "ask. The participant saw no trial. Fix it and continue with heft resume, or add "
      "--ignore-failed-checks to "
      "continue anyway",
      failed));
}

// After a crash the first pages are not repeated.
bool Runner::begin() {
  if (!pages_.has_reader()) return true;
  check_apparatus();
  if (parts_.engine.n_attempts() > 0) return true;
  if (pages_.welcome()) return true;
  journal_.emit_now(SessionEnded{Ending::aborted});
  return false;
}

RunEnd Runner::run_blocks() {
  for (;;) {
    control_.wait_while_held();
    pages_.questionnaires_before(block_to_come());
    if (control_.leaving()) return RunEnd::stopped;
    if (const auto rest = parts_.engine.next().rest) {
      take_break(rest->name, rest->least_duration_s);
      continue;  // its answers may be asked about, too
    }
    if (control_.take_rest_wish()) take_break("asked for", 0);
    control_.check_if_wanted();
    if (control_.leaving()) return RunEnd::stopped;
    const Next next = parts_.engine.next();
    switch (next.kind) {
      case Next::Kind::demonstration:
        show_demonstration(*next.demonstration);
        break;
      case Next::Kind::trial:
        run_trial(*next.plan);
        break;
      case Next::Kind::finish:
        if (const auto end = finish()) return *end;
        break;
      case Next::Kind::act:  // unreachable: no trial is open after an attempt
      case Next::Kind::paused:
        return RunEnd::paused;
      case Next::Kind::over:
        return RunEnd::finished;
    }
  }
}

// The block of a due break, or the next one. None: no block follows.
std::string Runner::block_to_come() const {
  const Next& next = parts_.engine.next();
  if (next.rest) return next.rest->name;
  if (next.demonstration) return next.demonstration->name;
  return next.plan ? next.plan->block : "";
}

// None: the last answer was vetoed meanwhile, and trials remain.
std::optional<RunEnd> Runner::finish() {
  const auto at_end = [this] { return parts_.engine.next().kind == Next::Kind::finish; };
  pages_.questionnaires_at_the_end();
  if (pages_.has_reader() && at_end()) pages_.how_decided();
  if (control_.leaving()) return RunEnd::stopped;
  if (!at_end()) return std::nullopt;
  journal_.emit_now(SessionEnded{});
  return RunEnd::finished;
}

void Runner::take_break(const std::string& name, double least_s) {
  const double since_s = journal_.now_s();
  if (is_looked_at())
    pages_.rest(least_s);
  else
    parts_.clock.advance_to(since_s + least_s);
  if (control_.leaving()) return;  // repeated when the session is resumed
  journal_.emit_now(BreakTaken{name, journal_.now_s() - since_s});
}

void Runner::show_demonstration(const DemonstrationBlock& block) {
  if (is_looked_at())
    pages_.demonstration(block, parts_.apparatus, parts_.left_hand);
  else
    parts_.clock.advance_to(journal_.now_s() + block.duration_s);
  const bool due = parts_.engine.next().kind == Next::Kind::demonstration;
  if (!control_.leaving() && due) journal_.emit_now(DemonstrationShown{block.name});
}

void Runner::run_trial(const TrialPlan& plan) {
  if (const auto unfinished_staircase = parts_.engine.unfinished_staircase();
      unfinished_staircase && unfinished_staircase != noted_last_staircase_) {
    noted_last_staircase_ = unfinished_staircase;
    journal_.emit_now(
        Note{fmt::format("staircase \"{}\" is the last one and runs alone from trial {}",
                         *unfinished_staircase, plan.trial_number)});
  }
  if (pages_.has_reader()) pages_.instructions(plan.block, plan.task);
  fade_out();  // with the feedback of practice
  if (pages_.has_reader() && parts_.engine.practice_has_ended()) pages_.after_practice(plan.block);
  const Next& next = parts_.engine.next();
  const bool still_due = next.kind == Next::Kind::trial &&
                         next.plan->trial_number == plan.trial_number &&
                         next.plan->attempt == plan.attempt;
  if (control_.leaving() || !still_due) return;
  if (!parts_.has_pictures) return SurrogateAttempt(parts_, journal_).run(plan);
  AttemptRun attempt(parts_, options_, journal_, control_, screen_);
  attempt.run(plan);
  last_shown_ = attempt.shown();
}

// A visible gap between two trials; touches in it are ignored.
void Runner::fade_out() {
  const double due_s = parts_.engine.trial_due_s(), since_s = parts_.clock.now_s();
  if (!parts_.clock.is_wall()) return parts_.clock.advance_to(due_s);
  const double step_s = 1 / parts_.protocol.display_rate_hz;
  for (double now_s = since_s; now_s < due_s && !control_.leaving(); now_s = parts_.clock.now_s()) {
    ScreenState screen = parts_.engine.screen();
    screen.faded = (now_s - since_s) / (due_s - since_s);
    screen_.present(last_shown_, screen);
    control_.wait(std::min(step_s, due_s - now_s));
  }
}

}  // namespace heft
