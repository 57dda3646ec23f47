// heft simulate: many sessions of a protocol with a simulated participant; heft merge: their shards
// as one log.
#include <fmt/format.h>

#include <charconv>
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
  std::string protocol, db, level = "hand";
  SessionOptions given;
  std::optional<std::uint64_t> seed;
  std::optional<Shard> shard;
  int participants = 13;
  int jobs = 1;
  bool frames = false;
};

// "2/10"
Shard shard_from(const std::string& text) {
  const char* const end = text.data() + text.size();
  Shard shard;
  const auto [slash, no_number] = std::from_chars(text.data(), end, shard.number);
  const bool has_slash = no_number == std::errc() && slash != end && *slash == '/';
  const auto [last, no_count] = std::from_chars(slash + (has_slash ? 1 : 0), end, shard.of);
  if (!has_slash || no_count != std::errc() || last != end || shard.number < 1 ||
      shard.number > shard.of)
    throw Error(fmt::format("--shard {}: expected I/N with I from 1 to N, such as 1/10", text),
                ExitCode::usage);
  return shard;
}

void print_start(const SimulationRequest& request, const ParticipantNumbers& numbers, int n_there) {
  if (request.shard)
    say("shard {}/{}: {}, {} of them in {} already\n", request.shard->number, request.shard->of,
        counted(numbers.count + n_there, "participant"), n_there, request.db);
  else if (n_there > 0)
    say("{} already holds participants up to {} of this protocol; continuing with {}\n", request.db,
        simulated_participant(n_there), simulated_participant(numbers.first));
}

SimulationRequest request_for(const SimulateOptions& options) {
  if (options.shard && !options.seed)
    throw Error("--shard needs --seed N, the same for all shards", ExitCode::usage);
  if (options.level == "surrogate" && options.frames)
    throw Error("--frames: the surrogate displays none; use --level hand", ExitCode::usage);
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
  request.shard = options.shard;
  return request;
}

void simulate_participants(const SimulateOptions& options) {
  SimulationRequest request = request_for(options);
  say("{}, protocol {}, responder {}, seed {}\n", counted(request.participants, "participant"),
      request.config->protocol->name, to_text(request.config->config.responder),
      request.config->seed);
  if (options.level == "surrogate")
    say("surrogate: straight strokes, no pictures (protocols/README.md has its errors)\n");
  else
    print_simulator(request.config);

  const StopOnSignal stop;
  const auto started = std::chrono::steady_clock::now();
  int stored = 0, n_wanted = 0;
  {
    ProgressBar bar("simulating");
    request.begins = [&](const ParticipantNumbers& numbers, int n_there) {
      print_start(request, numbers, n_there);
      n_wanted = numbers.count;
      bar.update(0, "");
    };
    stored = simulate(
        request,
        [&](int n) {
          bar.update(static_cast<double>(n) / n_wanted,
                     fmt::format("{} of {} participants", n, n_wanted));
        },
        stop.requested());
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - started;
  say("{} in {:.1f} s: {:.1f} participants/min with {}\n", counted(stored, "participant"),
      elapsed.count(), 60 * stored / elapsed.count(), counted(request.jobs, "thread"));
  if (stored < n_wanted)
    throw Error(fmt::format("stopped; {} in {}{}", counted(stored, "stored participant"),
                            request.db, options.shard ? "; the same command continues" : ""),
                ExitCode::interrupted);
  if (options.shard)
    say("when all shards are complete: heft merge all.db SHARD.db...\n");
  else
    say("results: heft analyse --db {}\n", shell_quoted(request.db));
}

void merge(const MergeRequest& request) {
  const StopOnSignal stop;
  MergeResult result;
  {
    ProgressBar bar("merging");
    result = merge_shards(
        request, [&](const char* what, double done) { bar.update(done, what); }, stop.requested());
  }
  const std::string stored = counted(result.n_participants, "participant");
  if (result.n_participants < result.n_expected)
    throw Error(fmt::format("stopped; {} in {}; the same command continues", stored, request.db),
                ExitCode::interrupted);
  say("{} in {}, {} of them new; head of the log: {}\n", stored, request.db, result.n_new,
      short_head(result.head));
  say("results: heft analyse --db {}\n", shell_quoted(request.db));
}

}  // namespace

void add_simulate(Command& app) {
  const auto options = std::make_shared<SimulateOptions>();
  Command command = app.add_command(
      "simulate", "run many sessions with a simulated responder",
      {"heft simulate protocols/paper.toml --responder simulated --participants 13 --db sim.db",
       "heft simulate protocols/jnd.toml --responder coin --participants 100 --jobs 2 --seed 1",
       "heft simulate protocols/jnd.toml --participants 1000 --seed 1 --shard 3/10 --db 3.db"});
  command.add_option("PROTOCOL", &options->protocol, "a protocol file").required();
  add_responder(command, options->given.responder,
                "NAME or NAME:FILE (heft doctor --list; default: simulated)");
  command.add_option("--participants", &options->participants, "how many, in all shards together")
      .whole_number(1, 1'000'000)
      .shows_default();
  command.add_jobs(options->jobs, "the data do");
  command.add_log(options->db, "the log; an existing one gets more sessions");
  command.add_seed(options->seed);
  command
      .add_option(
          "--level", &options->level,
          "surrogate: straight strokes alone, fast; hand: the whole scene; camera: also its "
          "pictures, slow")
      .one_of({"surrogate", "hand", "camera"})
      .shows_default();
  command.add_option(
      "--shard",
      ReadsText{[options](const std::string& text) { options->shard = shard_from(text); }},
      "I/N: only participants I, I + N, I + 2 N...; a log that has the first of them gets the rest "
      "(then: heft merge)");
  command.add_option("--simulator", &options->given.simulator, "instead of the protocol's");
  command.add_flag("--frames", options->frames,
                   "store every displayed frame, too (about 10 MB per session)");
  add_settings(command, options->given.settings,
               "change a key of the protocol, such as coupling.stiffness_n_per_m=100; kept with "
               "the sessions");
  command.does([options] { simulate_participants(*options); });
}

void add_merge(Command& app) {
  const auto request = std::make_shared<MergeRequest>();
  Command command = app.add_command("merge", "join the shards of a simulation to one log",
                                    {"heft merge all.db shard-*.db"});
  command
      .add_option("DB", &request->db,
                  "the log that one run would have written; new, or left by the same command")
      .required();
  command.add_option("SHARDS", &request->shards, "logs of heft simulate --shard I/N, all N")
      .required();
  command.does([request] { merge(*request); });
}

}  // namespace heft::cli
