// heft simulate: many sessions of a protocol with a model for a participant.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include "base/Error.h"
#include "cli/Commands.h"
#include "cli/Questionnaires.h"
#include "cli/SessionOptions.h"
#include "cli/Terminal.h"
#include "session/Simulation.h"

namespace heft::cli {

namespace {

struct SimulateOptions {
  std::string protocol, responder = "simulated", simulator, db = "heft.db";
  std::optional<std::uint64_t> seed;
  int participants = 13;
  int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  bool frames = false;
  std::vector<std::string> settings;
};

void simulate_participants(const SimulateOptions& options) {
  SimulationRequest request;
  request.protocol = load_protocol(options.protocol, options.settings);
  SessionConfig setup;
  setup.responder = options.responder;
  setup.simulator = options.simulator;
  setup.settings = fmt::format("{}", fmt::join(options.settings, "\n"));
  complete(setup);
  setup.protocol_file = std::filesystem::absolute(options.protocol).lexically_normal().string();
  add_questionnaires(setup, request.protocol, texts_file(request.protocol.screens.language));
  check(setup, request.protocol);
  request.setup = in_force(std::move(setup), request.protocol);
  request.db = options.db;
  request.seed = options.seed.value_or(fresh_seed());
  request.participants = options.participants;
  request.jobs = options.jobs;
  request.keep_frames = options.frames;
  say("{} participants, protocol {}, responder {}, seed {}\n", request.participants,
      request.protocol.name, request.setup.responder, request.seed);
  tell_simulator(request.protocol, request.setup);

  const StopOnSignal stop;
  const auto started = std::chrono::steady_clock::now();
  int stored = 0;
  {
    ProgressBar bar("simulating");
    request.numbered = [&](int first) {
      if (first > 1)
        say("{} holds participants up to {} of this protocol already; going on with {}\n",
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
  say("{} participants in {:.1f} s: {:.1f} participants a minute with {} job{}\n", stored,
      elapsed.count(), 60 * stored / elapsed.count(), request.jobs, request.jobs == 1 ? "" : "s");
  if (stored < request.participants)
    throw Error(fmt::format("stopped; {} participants are stored in {}", stored, request.db),
                ExitCode::interrupted);
  say("what was found: heft analyse --db {}\n", shell_quoted(request.db));
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
  command
      .add_option("--responder", &options->responder, "NAME or NAME:FILE (heft doctor lists them)")
      .shows_default();
  command.add_option("--participants", &options->participants, "how many")
      .whole_number(1, 1'000'000)
      .shows_default();
  command
      .add_option("--jobs", &options->jobs,
                  "threads; any number gives the same data (default: one a core)")
      .whole_number(1, 1024);
  command.add_option("--db", &options->db, "the log; an existing one gets more sessions")
      .shows_default();
  command.add_seed(options->seed);
  command.add_option("--simulator", &options->simulator, "instead of the protocol's");
  command.add_flag("--frames", options->frames,
                   "store every displayed frame too (about 10 MB a session)");
  add_settings(command, options->settings);
  command.does([options] { simulate_participants(*options); });
}

}  // namespace heft::cli
