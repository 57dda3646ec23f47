// heft replay: verifies a log, or recomputes it under other conditions.
#include "replay/Replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "apparatus/configuration/ResolvedConfig.h"
#include "base/Clock.h"
#include "base/Error.h"
#include "base/Names.h"
#include "cli/Commands.h"
#include "cli/SessionOptions.h"
#include "cli/console/Terminal.h"
#include "cli/reports/Reports.h"
#include "experiment/ScreenTexts.h"
#include "physics/DecouplingSimulator.h"
#include "physics/auto/Choice.h"
#include "protocol/readers/Files.h"
#include "record/reader/LogReader.h"
#include "session/Session.h"

namespace heft::cli {

namespace {

struct ReplayOptions {
  std::string db;
  std::optional<std::int64_t> session;
  std::vector<ResponderChoice> responders;
  int repeats = JudgeRequest{}.repeats;
  std::optional<std::uint64_t> seed;
  std::string chart;
  std::optional<std::string> simulator;
  std::optional<Plug> view;
  std::vector<ProtocolSetting> set;
  std::string witness;
  bool rerun = false, json = false, tables = false;
  bool changes_config() const { return simulator || !set.empty(); }
  bool judges() const { return !responders.empty() && !rerun; }
  bool verifies() const { return responders.empty() && !changes_config() && !view; }
  bool compares_paths() const { return changes_config() && !rerun && !view && !judges(); }
};

// Tables of a protocol that affect the world of a logged hand.
constexpr std::array world{"physics", "coupling", "technique", "layout", "effector"};

// Refuses keys without effect on the replay, which would otherwise seem to make no difference.
void check_world(const std::vector<ProtocolSetting>& settings) {
  for (const ProtocolSetting& setting : settings) {
    const std::string section = setting.key.substr(0, setting.key.find('.'));
    if (std::ranges::find(world, section) != world.end()) continue;
    throw Error(fmt::format("--set {}: a replay simulates the logged hand in the logged trials; "
                            "expected a key of {}. --rerun with a --responder runs new trials "
                            "with any key",
                            to_text(setting), fmt::join(world, ", ")),
                ExitCode::usage);
  }
}

void check(const ReplayOptions& options) {
  const auto refuse = [](const char* why) { throw Error(why, ExitCode::usage); };
  if (options.rerun && options.responders.size() != 1)
    refuse("--rerun runs the trials again with one --responder");
  if ((!options.chart.empty() || options.seed || options.repeats != JudgeRequest{}.repeats) &&
      !options.judges())
    refuse("--repeats, --seed and --chart require a --responder without --rerun");
  if (!options.chart.empty() && !options.chart.ends_with(".svg"))
    refuse("--chart: expected a file that ends in .svg");
  if (!options.rerun) check_world(options.set);
  if (options.tables && (options.json || !(options.judges() || options.compares_paths())))
    refuse(
        "--tables requires --set, --simulator or a --responder, without --rerun, --view and "
        "--json");
  if (!options.witness.empty() && (options.session || !options.verifies()))
    refuse("--witness verifies the whole log, without other options");
  if (options.json && !options.judges()) refuse("--json requires a --responder without --rerun");
  if (options.view && !options.responders.empty())
    refuse(
        "--view shows the logged frames, with --set or --simulator another clone beside them; "
        "it takes no --responder");
}

// Withdrawn sessions are only verified.
std::vector<std::int64_t> chosen_sessions(const LogReader& reader, const ReplayOptions& options) {
  if (options.session) {
    const SessionRow row = reader.session(*options.session);
    if (row.state == SessionState::withdrawn && !options.verifies())
      throw Error(fmt::format("the data of session {} were withdrawn", row.session_id));
    return {row.session_id};
  }
  std::vector<std::int64_t> ids;
  for (const SessionRow& row : reader.sessions())
    if (row.state != SessionState::withdrawn || options.verifies()) ids.push_back(row.session_id);
  if (ids.empty())
    throw Error(
        fmt::format("{} holds no session{}", options.db,
                    options.witness.empty() ? " yet" : ", but the witness is the head of one"),
        options.witness.empty() ? ExitCode::failed : ExitCode::diverged);
  return ids;
}

// Fails before the first line of output if another build is needed. An unreadable row is reported
// where it is verified.
void require_simulators(const LogReader& reader, const std::string& db,
                        const std::vector<std::int64_t>& ids) {
  for (const std::int64_t id : ids) try {
      for (const LoggedSetup& logged : load_session(reader, db, id).setups)
        simulator_named(logged.setup.simulator);
    } catch (const OnlyForStudies&) {
      if (reader.frame_counts(id).n_frames > 0) throw;
    } catch (const Error&) {
    }
}

// Sessions are numbered from 1 and never removed. Missing last ones cannot be detected.
bool none_is_missing(const std::vector<std::int64_t>& ids) {
  std::int64_t before = 0;
  bool none = true;
  for (const std::int64_t id : ids) {
    if (id != before + 1) {
      none = false;
      print("sessions between {} and {} are missing: rows were removed from the log\n", before, id);
    }
    before = id;
  }
  return none;
}

void print_witness(const LogReader& reader, const std::string& head) {
  if (head.empty()) return print("head of the log: {}\n", short_head(reader.head()));
  const Witness witness = find_witness(reader, head);
  print(
      "witness {}: confirmed, session {} and all before it are as they were then; sealed since: "
      "{}\n",
      short_head(witness.seal.head), witness.seal.session_id, witness.n_since);
}

void verify_all(const LogReader& reader, const ReplayOptions& options) {
  bool same = true;
  for (const std::string& fault : faults_of_file(reader, options.db)) {
    print("{}\n", fault);
    same = false;
  }
  try {
    const auto ids = chosen_sessions(reader, options);
    require_simulators(reader, options.db, ids);
    print_verification(reader, ids, same);
    if (!options.session) same = none_is_missing(ids) && same;
  } catch (const OnlyForStudies&) {
    throw;
  } catch (const Error& error) {
    if (same) throw;  // the requested session is missing
    print("first divergence: no trial: {}\n", error.what());
  }
  if (!same) throw Error(fmt::format("{} contradicts its events", options.db), ExitCode::diverged);
  print_witness(reader, options.witness);
}

// The logged protocol and configuration with the changes.
struct ChangedConfig {
  Protocol protocol;
  SessionConfig config;
};

ChangedConfig changed_config(const LoggedSession& session, const ReplayOptions& options) {
  SessionConfig config = session.setup;
  config.settings = session.setups.front().setup.settings;
  config.settings.insert(config.settings.end(), options.set.begin(), options.set.end());
  Protocol protocol = parse_protocol(session.row.header.protocol_text,
                                     session.row.header.protocol_name, config.settings);
  std::string simulator = options.simulator.value_or(config.simulator);
  for (const ProtocolSetting& set : options.set)
    if (set.key == "physics.simulator" && !options.simulator) simulator = protocol.simulator.name;
  if (options.changes_config()) {  // the rate may be among the changes
    const SimulatorPick pick = simulator_for(simulator, protocol);
    config.simulator = pick.simulator;
    config.rate_hz = pick.rate_hz;
    config.simulator_reason = pick.why;
  }
  config.input = protocol.simulator.input.mode;
  config.predict_s = protocol.simulator.input.predict_s;
  return {*protocol_for(std::move(protocol), config), std::move(config)};
}

// Runs trials again with the responder's own hand, without camera or view.
OtherResponder run_again(const LogReader& reader, const LoggedSession& session,
                         const ResponderChoice& responder, const ChangedConfig& changed_config) {
  SessionOptions given;
  given.responder = responder;
  given.tracker = Plug{"hand"};
  given.view = Plug{"headless"};
  const SessionRequest request{
      resolve(given, changed_config.config, changed_config.protocol, session.row.header.seed),
      session.row.header.participant};
  const std::int64_t session_id = session.row.session_id;
  ProgressBar bar(fmt::format("session {}", session_id));
  RunnerOptions runner;
  runner.keep_frames = false;
  runner.progress = [&](const Engine& engine) {
    bar.update(0, counted(engine.n_completed(), "trial"));
  };
  return compare_sessions(reader, session_id, compute_session(request, runner));
}

void ask_what_if(const LogReader& reader, const ReplayOptions& options) {
  for (const std::int64_t session_id : chosen_sessions(reader, options)) {
    const LoggedSession session = load_session(reader, options.db, session_id);
    const ChangedConfig changed = changed_config(session, options);
    print("session {}, participant {}:\n", session_id, session.row.header.participant);
    if (options.rerun) {
      print_rerun(run_again(reader, session, options.responders.front(), changed));
      continue;
    }
    print_paths(compare_paths(reader, session, changed.protocol), options.tables);
  }
}

// Under --set and --simulator the models see what the logged hand would have shown.
void judge(const LogReader& reader, const ReplayOptions& options) {
  const auto ids = chosen_sessions(reader, options);
  JudgeRequest request{options.responders, options.repeats};
  request.seed = options.seed.value_or(request.seed);
  JudgedLog log{{}, request.repeats, request.seed, static_cast<int>(ids.size()), {}, 0};
  for (const ResponderChoice& responder : options.responders)
    log.names.push_back(to_text(responder));
  const double start_s = monotonic_s();
  {
    ProgressBar bar("judging");
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const LoggedSession session = load_session(reader, options.db, ids[i]);
      std::optional<ChangedConfig> changed;
      if (options.changes_config()) changed = changed_config(session, options);
      const auto progress = [&](double done) {
        const double all = (static_cast<double>(i) + done) / static_cast<double>(ids.size());
        bar.update(all, fmt::format("session {}, {:.0f} %", ids[i], 100 * all));
      };
      log.judgments.add(judge_session(reader, session, request,
                                      changed ? &changed->protocol : nullptr, progress));
    }
  }
  log.took_s = monotonic_s() - start_s;
  if (!options.chart.empty()) draw_judged(log, options.chart);
  if (options.json) return fmt::print("{}", as_json(log));
  print_judged(log, options.tables);
  if (!options.chart.empty()) print("chart: {}\n", options.chart);
}

// The log's texts, if it has any.
ScreenTexts texts_of(const SessionConfig& setup) {
  if (!setup.texts.text.empty()) return parse_texts(setup.texts.text, setup.texts.path);
  return load_texts(texts_file("en"));
}

void show(const LogReader& reader, const ReplayOptions& options) {
  const auto ids = chosen_sessions(reader, options);
  if (ids.size() > 1)
    throw Error(fmt::format("{} holds {} sessions; select one with --session for --view",
                            options.db, ids.size()),
                ExitCode::usage);
  const auto& [name, file, text] = *options.view;
  const ViewEntry& entry = view_named(name);
  if (entry.has_file == file.empty() || !(entry.has_file || entry.has_screen))
    throw Error(fmt::format("can't show a replay with --view {}; expected window or video:FILE",
                            to_text(*options.view)),
                ExitCode::usage);
  const LoggedSession session = load_session(reader, options.db, ids.front());
  const Protocol what_if = changed_config(session, options).protocol;
  ViewSetup setup;
  setup.stage = stage_of(*session.protocol, 3);
  if (entry.has_screen) setup.texts = texts_of(session.setup);
  setup.left_handed = session.setup.controls == Side::left;
  setup.text_size = session.protocol->screens.text_size;
  setup.file = file;
  setup.n_captions = replay_captions;
  setup.rate_hz = session.protocol->display_rate_hz;
  const StopOnSignal stop;
  const auto view = entry.make(setup);
  const int n = show_session(
      reader, session, *view,
      {options.changes_config() ? &what_if : nullptr, entry.has_screen, &stop.requested()});
  print("session {}: {} shown\n", session.row.session_id, counted(n, "frame"));
  if (stop.requested()) throw Error("stopped before the last frame", ExitCode::interrupted);
}

}  // namespace

void add_replay(Command& app) {
  const auto options = std::make_shared<ReplayOptions>();
  Command command = app.add_command(
      "replay", "verify a log (exit 5: it differs), or recompute it otherwise",
      {"heft replay --db lab.db", "heft replay --db lab.db --session 3",
       "heft replay --db lab.db --witness 1a2b3c4d5e6f",
       "heft replay --db lab.db --session 3 --simulator bullet-ea",
       "heft replay --db lab.db --set physics.friction=0.64",
       "heft replay --db lab.db --set physics.predict_s=0.05",
       "heft replay --db lab.db --responder simulated --responder criterion_only",
       "heft replay --db lab.db --responder simulated:mine.toml --repeats 400 --chart models.svg",
       "heft replay --db lab.db --responder simulated --set coupling.stiffness_n_per_m=100",
       "heft replay --db lab.db --responder coin --rerun",
       "heft replay --db lab.db --session 3 --view video:three.mp4 --set physics.friction=0.64"});
  command.add_log(options->db);
  command.add_session(options->session, "all");
  add_responders(command, options->responders,
                 "NAME[:FILE] ...: score these models by how well their answers to the displayed "
                 "frames predict the logged ones; the logged model without a file is the same "
                 "simulated person");
  command.add_option("--repeats", &options->repeats, "draws of each answer")
      .shows_default()
      .whole_number(2, 100000);
  command.add_seed(options->seed, "1");
  command.add_option("--chart", &options->chart, "FILE.svg: the scores by task");
  command.add_flag("--rerun", options->rerun, "run the trials again with the responder instead");
  command.add_flag("--json", options->json, "scores and each trial's probabilities as JSON");
  command.add_flag("--tables", options->tables, "all tables instead of a summary");
  command.add_option("--witness", &options->witness,
                     "a head that was noted when a session ended: also verify that it and the "
                     "sessions before it are complete and unchanged since");
  command.add_option("--simulator", &options->simulator,
                     "simulate the logged hand with this simulator, and compare lags and paths");
  add_settings(command, options->set,
               fmt::format("change a key of the protocol, such as "
                           "coupling.stiffness_n_per_m=100: of its {}; with --rerun any",
                           fmt::join(world, ", ")));
  add_plug(command, "--view", options->view,
           "window or video:FILE: show the logged frames; with --set or --simulator also "
           "the changed clone");
  command.does([options] {
    check(*options);
    refuse_special_file(options->db);
    const LogReader reader(options->db);
    if (options->verifies())
      verify_all(reader, *options);
    else if (options->view)
      show(reader, *options);
    else if (options->judges())
      judge(reader, *options);
    else
      ask_what_if(reader, *options);
  });
}

}  // namespace heft::cli
