#include "cli/SessionCommand.h"

#include <fmt/format.h>

#include "base/Error.h"
#include "cli/Progress.h"
#include "cli/StopOnSignal.h"
#include "cli/Talk.h"
#include "cli/TerminalDesk.h"
#include "protocol/ExpectedLength.h"

namespace heft::cli {

namespace {
void add_progress(RunnerOptions& options, ProgressBar& bar, double expected) {
  // Nothing that would unblind whoever watches: no mass, level, condition or correctness.
  options.progress = [&bar, expected](const Engine& engine) {
    bar.update(expected > 0 ? engine.n_completed() / expected : 0,  // a demonstration has no trials
               fmt::format("{} of about {:.0f} trials, {:.0f} min", engine.n_completed(), expected,
                           engine.last_s() / 60));
  };
}
}  // namespace

SessionResult run_session(const CommandedSession& session,
                          const std::function<SessionResult(const RunnerOptions&)>& run) {
  const StopOnSignal stop_on_signal;
  ProgressBar bar("session");
  std::optional<TerminalDesk> desk;
  const double expected = expected_length(session.protocol).trials;
  RunnerOptions options;
  options.stop = &stop_on_signal.requested();
  options.tell = [](const std::string& text) { say("heft: {}\n", text); };
  if (runs_on_wall_clock(session.setup))
    options.desk = &desk.emplace(expected, session.unblind);
  else
    add_progress(options, bar, expected);
  const SessionResult result = run(options);
  desk.reset();
  const std::string resume =
      fmt::format("heft resume --db {} --session {}", shell_quoted(session.db), result.session_id);
  if (result.end == RunEnd::stopped)
    throw Error("stopped; everything up to the last answer is saved. Go on with: " + resume,
                ExitCode::interrupted);
  if (result.end == RunEnd::paused)
    throw Error(
        fmt::format("the session paused itself: one trial was void {} times. Look at the "
                    "camera and the board, then go on with: {}",
                    max_voids, resume));
  return result;
}

}  // namespace heft::cli
