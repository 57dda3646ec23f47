#include "session/Runner.h"

#include <fmt/format.h>

#include "session/AttemptRun.h"

namespace heft {

namespace {
constexpr double longest_wait_alone_s = 30, longest_wait_leaving_s = 10;
}  // namespace

Runner::Runner(const SessionParts& parts, const RunnerOptions& options)
    : parts_(parts),
      options_(options),
      journal_(parts.engine, parts.sink, parts.clock, options.progress),
      screen_(journal_, parts.view, parts.texts),
      control_(journal_, screen_, options.console, options.stop, parts.has_screen),
      pages_(parts.protocol, journal_, control_, screen_, parts.texts) {
  journal_.while_locked([this](double waited_s) { return wait_for_log(waited_s); });
}

RunEnd Runner::run() {
  if (!begin()) return RunEnd::declined;
  const RunEnd end = run_blocks();
  if (end == RunEnd::stopped) journal_.leave("stopped by the operator");
  journal_.flush();
  if (end == RunEnd::finished && pages_.has_reader()) pages_.thanks();
  return end;
}

// A person's session waits as long as the experimenter likes; nobody would come to help a model's.
bool Runner::wait_for_log(double waited_s) {
  const std::string why = "the log is kept locked by another program; waiting";
  const std::string told = why + " until it lets go. Nothing is lost; close that program";
  if (waited_s == 0) options_.console ? options_.console->say(told) : options_.tell(told);
  control_.stand_still(why);
  if (control_.leaving()) return waited_s < longest_wait_leaving_s;
  return pages_.has_reader() || waited_s < longest_wait_alone_s;
}

void Runner::check_apparatus() {
  std::string failed;
  if (parts_.has_screen && parts_.pictures.has_checks())
    screen_.present({}, ScreenState{.screen = Screen::setting_up});
  for (const CheckResult& result : parts_.pictures.check(parts_.protocol.display_rate_hz)) {
    journal_.emit_now(result);
    const bool has_failed = result.verdict == CheckVerdict::failed;
    if (options_.console)
      options_.console->say(fmt::format("{:<8} {}: {}",
                                        has_failed ? "FAILED" : name_of(result.verdict),
                                        result.name, result.finding));
    if (has_failed) failed += (failed.empty() ? "" : ", ") + result.name;
  }
  if (!failed.empty()) ask_whether_failures_matter(failed);
}

// Where nobody can be asked, what was said and logged of the failure is all.
void Runner::ask_whether_failures_matter(const std::string& failed) {
  const auto goes_on = control_.ask_to_go_on(
      "go on? y goes on, n leaves; nothing has been shown to the participant yet");
  if (!goes_on) return;
  journal_.emit_now(Note{fmt::format("failed check: {}; the experimenter {}", failed,
                                     *goes_on ? "goes on" : "leaves")});
}

// Who comes back after a crash has read the first pages already.
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
    const Next next = parts_.engine.next();
    if (control_.leaving()) return RunEnd::stopped;
    if (next.rest) take_break(next.rest->name, next.rest->least_duration_s);
    if (control_.take_rest_wish()) take_break("asked for", 0);
    if (control_.leaving()) return RunEnd::stopped;
    switch (next.kind) {
      case Next::Kind::demonstration:
        show_demonstration(*next.demonstration);
        break;
      case Next::Kind::trial:
        run_trial(*next.plan);
        break;
      case Next::Kind::finish:
        return finish();
      case Next::Kind::act:  // unreachable: an attempt leaves no trial open
      case Next::Kind::paused:
        return RunEnd::paused;
      case Next::Kind::over:
        return RunEnd::finished;
    }
  }
}

RunEnd Runner::finish() {
  if (pages_.has_reader()) pages_.how_decided();
  if (control_.leaving()) return RunEnd::stopped;
  journal_.emit_now(SessionEnded{});
  return RunEnd::finished;
}

void Runner::take_break(const std::string& name, double least_s) {
  const double since_s = journal_.now_s();
  if (is_looked_at())
    pages_.rest(least_s);
  else
    parts_.clock.advance_to(since_s + least_s);
  if (control_.leaving()) return;  // who comes back takes it again
  journal_.emit_now(BreakTaken{name, journal_.now_s() - since_s});
}

void Runner::show_demonstration(const DemonstrationBlock& block) {
  if (is_looked_at())
    pages_.demonstration(block, parts_.apparatus, parts_.left_hand);
  else
    parts_.clock.advance_to(journal_.now_s() + block.duration_s);
  if (!control_.leaving()) journal_.emit_now(DemonstrationShown{block.name});
}

void Runner::run_trial(const TrialPlan& plan) {
  if (const auto survivor = parts_.engine.survivor();
      survivor && survivor != noted_last_staircase_) {
    noted_last_staircase_ = survivor;
    journal_.emit_now(
        Note{fmt::format("staircase \"{}\" is the last one and runs alone from trial {}", *survivor,
                         plan.trial_number)});
  }
  if (pages_.has_reader() && instructed_block_ != plan.block) {
    pages_.instructions(plan.task);
    if (control_.leaving()) return;
    instructed_block_ = plan.block;
  }
  AttemptRun(parts_, options_, journal_, control_, screen_).run(plan);
}

}  // namespace heft
