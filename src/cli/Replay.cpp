// heft replay: verify a log, or ask what a session would have been.
#include "replay/Replay.h"

#include <fmt/format.h>

#include <memory>

#include "base/Error.h"
#include "cli/Commands.h"
#include "cli/Output.h"
#include "cli/Progress.h"
#include "physics/DecouplingSimulator.h"
#include "record/Integrity.h"
#include "replay/WhatIf.h"
#include "session/Session.h"

namespace heft::cli {

namespace {

struct Options {
  std::string db = "heft.db";
  std::optional<std::int64_t> session;
  std::string responder, simulator;
  std::vector<std::string> set;
  bool asks_what_if() const { return !responder.empty() || !simulator.empty() || !set.empty(); }
};

std::vector<std::int64_t> chosen_sessions(const LogReader& reader, const Options& options) {
  if (options.session) return {reader.session(*options.session).session_id};
  std::vector<std::int64_t> ids;
  for (const SessionRow& row : reader.sessions()) ids.push_back(row.session_id);
  if (ids.empty()) throw Error(fmt::format("{} holds no session yet", options.db));
  return ids;
}

void print_divergence(const Divergence& divergence) {
  const std::string trial =
      divergence.trial_number > 0 ? fmt::format("trial {}", divergence.trial_number) : "no trial";
  print("  first divergence: {}, at {:.6f} s: {}\n    logged:   {}\n    came out: {}\n", trial,
        divergence.t_s, divergence.what, divergence.logged, divergence.came_out);
}

std::string how_frames_were_checked(const Verification& found) {
  if (found.n_frames == 0) return "no frames logged, so the simulator was not checked";
  std::string how = fmt::format("{} frames simulated again, ", found.n_frames);
  if (found.n_other_edition > 0)
    how += fmt::format("{} of them logged with an edition of the simulator that this heft does not "
                       "have: only measured, they differ by up to {:.3g} m; of the others ",
                       found.n_other_edition, found.largest_difference_m);
  if (found.same_build) return how + "equal bits demanded";
  return how + fmt::format("logged by another build: poses within 1e-6 m demanded, largest "
                           "difference {:.3g} m",
                           found.largest_difference_m);
}

// @return whether the log says what its events give
bool verify(const LogReader& reader, std::int64_t session_id) {
  ProgressBar bar(fmt::format("session {}", session_id));
  const Verification found = verify_session(reader, session_id, [&](double share) {
    bar.update(share, fmt::format("{:.0f} %", 100 * share));
  });
  const std::string verified =
      found.ended ? "verified"
                  : fmt::format("verified up to event {}, unfinished", found.n_events);
  print("session {}: {}: {} events folded, {} rows in {} attempts compared; {}\n", session_id,
             found.first ? "DIVERGED" : verified, found.n_events, found.n_rows, found.n_attempts,
             how_frames_were_checked(found));
  if (found.first) print_divergence(*found.first);
  return !found.first;
}

void verify_all(const LogReader& reader, const Options& options) {
  bool same = true;
  for (const std::string& fault : check_integrity(options.db)) {
    print("the file is damaged: {}\n", fault);
    same = false;
  }
  try {
    for (const std::int64_t session_id : chosen_sessions(reader, options))
      same = verify(reader, session_id) && same;
  } catch (const Error& error) {
    if (same) throw;  // what was asked for is not there
    print("first divergence: no trial: {}\n", error.what());
  }
  if (!same)
    throw Error(fmt::format("{} does not hold what its events give", options.db),
                ExitCode::diverged);
}

void print_paths(const std::vector<PathDifference>& differences) {
  print(
      "  where things would have been, against the log (mm):\n"
      "  {:<13} {:<4} {:>9} {:>11} {:>10} {:>11} {:>10}\n",
      "task", "", "pictures", "clone RMS", "clone max", "cubes RMS", "cubes max");
  for (const PathDifference& d : differences)
    print("  {:<13} {:<4} {:>9} {:>11.4f} {:>10.4f} {:>11.4f} {:>10.4f}\n", name_of(d.task),
               d.condition, d.n_pictures, 1e3 * d.clone_rms_m, 1e3 * d.clone_max_m,
               1e3 * d.cubes_rms_m, 1e3 * d.cubes_max_m);
}

std::string grams(const std::optional<double>& value_g) {
  return value_g ? fmt::format("{:.1f} g", *value_g) : "none";
}

void print_responder(const OtherResponder& other) {
  print("  {:<13} {:<4} {:>20} {:>20}\n", "task", "", "logged, right of n", "would be, right of n");
  for (const OutcomeDifference& o : other.outcomes)
    print("  {:<13} {:<4} {:>20} {:>20}\n", name_of(o.task), o.condition,
               fmt::format("{} of {}", o.n_logged_correct, o.n_logged),
               fmt::format("{} of {}", o.n_would_be_correct, o.n_would_be));
  for (const EstimateDifference& e : other.estimates)
    print("  JND of staircase {:<12} logged {:>9}, would be {:>9}\n", '"' + e.staircase + '"',
          grams(e.logged_g), grams(e.would_be_g));
}

// The protocol and setup that the question supposes.
std::pair<Protocol, Setup> supposed(const LoggedSession& session, const Options& options) {
  std::vector<std::string> settings = settings_of(session.setups.front().setup);
  settings.insert(settings.end(), options.set.begin(), options.set.end());
  Protocol protocol =
      parse_protocol(session.row.header.protocol_text, session.row.header.protocol_name, settings);
  Setup setup = session.setup;
  setup.settings = fmt::format("{}", fmt::join(settings, "\n"));
  for (const std::string& set : options.set)
    if (set.starts_with("physics.simulator")) setup.simulator.clear();
  if (!options.set.empty()) setup.rate_hz.reset();  // it may be among what was set
  if (!options.simulator.empty()) {
    simulator_named(options.simulator);  // says so if there is none of that name
    setup.simulator = options.simulator;
    setup.simulator_why.clear();
    setup.rate_hz.reset();
  }
  if (!options.responder.empty()) {
    setup.responder = options.responder;
    setup.tracker = "hand";
    setup.view = "headless";
    setup.record_camera.clear();
    complete(setup);
  }
  setup = in_force(std::move(setup), protocol);
  protocol = *protocol_for(std::move(protocol), setup);
  return {std::move(protocol), std::move(setup)};
}

OtherResponder run_anew(const LogReader& reader, const LoggedSession& session,
                        const Protocol& protocol, const Setup& setup) {
  const std::int64_t session_id = session.row.session_id;
  ProgressBar bar(fmt::format("session {}", session_id));
  RunnerOptions runner;
  runner.keep_frames = false;
  runner.progress = [&](const Engine& engine) {
    bar.update(0, fmt::format("{} trials", engine.n_completed()));
  };
  SessionRequest request;
  request.protocol = protocol;
  request.setup = setup;
  request.participant = session.row.header.participant;
  request.seed = session.row.header.seed;
  return compare_sessions(reader, session_id, compute_session(request, runner));
}

void ask_what_if(const LogReader& reader, const Options& options) {
  for (const std::int64_t session_id : chosen_sessions(reader, options)) {
    const LoggedSession session = load_session(reader, options.db, session_id);
    const auto [protocol, setup] = supposed(session, options);
    print("session {}, participant {}:\n", session_id, session.row.header.participant);
    if (options.responder.empty())
      print_paths(compare_paths(reader, session, protocol));
    else
      print_responder(run_anew(reader, session, protocol, setup));
  }
}

}  // namespace

void add_replay(Command& app) {
  const auto options = std::make_shared<Options>();
  Command command = app.add_command(
      "replay", "verify a log (exit 5 at a divergence), or ask what a session would have been",
      {"heft replay --db lab.db", "heft replay --db lab.db --session 3",
       "heft replay --db lab.db --session 3 --simulator bullet-ea",
       "heft replay --db lab.db --set physics.friction=0.64",
       "heft replay --db lab.db --set physics.predict_s=0.05",
       "heft replay --db lab.db --responder coin"});
  command.add_option("--db", &options->db, "the log").shows_default();
  command.add_session(options->session, "all");
  command.add_option("--responder", &options->responder,
                     "run the trials anew with this responder, and compare answers");
  command.add_option("--simulator", &options->simulator,
                     "run the logged hand through this simulator, and compare paths");
  command.add_option("--set", &options->set,
                     "change a key of the protocol, such as coupling.stiffness_n_per_m=100");
  command.does([options] {
    refuse_special_file(options->db);
    const LogReader reader(options->db);
    if (options->asks_what_if())
      ask_what_if(reader, *options);
    else
      verify_all(reader, *options);
  });
}

}  // namespace heft::cli
