// heft simulate: many sessions of a protocol with a simulated participant.
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <thread>

#include "base/Error.h"
#include "base/Names.h"
#include "cli/Commands.h"
#include "cli/SessionOptions.h"
#include "cli/console/Terminal.h"
#include "session/Simulation.h"

namespace heft::cli {

namespace {

struct SimulateOptions {
  std::string protocol, db = "heft.db", level = "hand";
  SessionOptions given;
  std::optional<std::uint64_t> seed;
  int participants = 13;
  int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  bool frames = false;
};

void simulate_participants(const SimulateOptions& options) {
  SessionOptions given = options.given;
  if (!given.responder) given.responder = Plug{"simulated"};
  given.tracker = Plug{options.level == "camera" ? "synthetic" : options.level};
  given.protocol_file = options.protocol;
  SimulationRequest request{resolve(given, load_protocol(options.protocol, given.settings),
                                    options.seed ? *options.seed : fresh_seed())};
  request.db = options.db;
  request.participants = options.participants;
  request.jobs = options.jobs;
  request.keep_frames = options.frames;
  say("{}, protocol {}, responder {}, seed {}\n", counted(request.participants, "participant"),
      request.config->protocol->name, to_text(request.config->config.responder),
      request.config->seed);
  if (options.level == "surrogate")
    say("surrogate: straight strokes, no pictures (results/responders has its errors)\n");
  else
    print_simulator(request.config);

  const StopOnSignal stop;
  const auto started = std::chrono::steady_clock::now();
  int stored = 0;
  {
    ProgressBar bar("simulating");
    request.numbered = [&](int first) {
      if (first > 1)
        say("{} already holds participants up to {} of this protocol; continuing with {}\n",
            request.db, simulated_participant(first - 1), simulated_participant(first));
      bar.update(0, "");
    };
    stored = simulate(
        request,
        [&](int n) {
          bar.update(static_cast<double>(n) / request.participants,
                     fmt::format("{} of {} participants", n, request.participants));
        },
        stop.requested());
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - started;
  say("{} in {:.1f} s: {:.1f} participants/min with {}\n", counted(stored, "participant"),
      elapsed.count(), 60 * stored / elapsed.count(), counted(request.jobs, "thread"));
  if (stored < request.participants)
    throw Error(fmt::format("stopped; {} in {}", counted(stored, "stored participant"), request.db),
                ExitCode::interrupted);
  say("results: heft analyse --db {}\n", shell_quoted(request.db));
}

}  // namespace

void add_simulate(Command& app) {
  const auto options = std::make_shared<SimulateOptions>();
  Command command = app.add_command(
      "simulate", "run many sessions with a simulated responder",
      {"heft simulate protocols/paper.toml --responder simulated --participants 13 --db sim.db",
       "heft simulate protocols/jnd.toml --responder coin --participants 100 --jobs 2 --seed 1",
       "heft simulate protocols/jnd.toml --responder simulated:mine.toml --participants 50"});
  command.add_option("PROTOCOL", &options->protocol, "a protocol file").required();
  add_responder(command, options->given.responder,
                "NAME or NAME:FILE (heft doctor --list; default: simulated)");
  command.add_option("--participants", &options->participants, "number of participants")
      .whole_number(1, 1'000'000)
      .shows_default();
  command
      .add_option("--jobs", &options->jobs,
                  "threads; the data do not depend on it (default: one per core)")
      .whole_number(1, 1024);
  command.add_option("--db", &options->db, "the log; an existing one gets more sessions")
      .shows_default();
  command.add_seed(options->seed);
  command
      .add_option(
          "--level", &options->level,
          "surrogate: straight strokes alone, fast; hand: the whole scene; camera: also its "
          "pictures, slow")
      .one_of({"surrogate", "hand", "camera"})
      .shows_default();
  command.add_option("--simulator", &options->given.simulator, "instead of the protocol's");
  command.add_flag("--frames", options->frames,
                   "store every displayed frame, too (about 10 MB per session)");
  add_settings(command, options->given.settings,
               "change a key of the protocol, such as coupling.stiffness_n_per_m=100; kept with "
               "the sessions");
  command.does([options] { simulate_participants(*options); });
}

}  // namespace heft::cli
