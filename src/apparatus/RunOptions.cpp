#include "apparatus/RunOptions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apparatus/AutoSimulator.h"
#include "apparatus/PictureSource.h"
#include "base/PlugTable.h"
#include "base/Random.h"
#include "base/TextFile.h"
#include "physics/DecouplingSimulator.h"
#include "protocol/MarkerFile.h"
#include "protocol/ParameterFile.h"
#include "protocol/SyntheticCameraFile.h"
#include "protocol/TextsFile.h"
#include "tracking/Camera.h"
#include "view/ArView.h"

namespace heft {

NameAndFile split_name(const std::string& option) {
  const auto colon = option.find(':');
  if (colon == std::string::npos) return {option, ""};
  return {option.substr(0, colon), option.substr(colon + 1)};
}

namespace {

// Every option and where it is kept, by its name in session.run_options.
struct Field {
  const char* name;
  std::string RunOptions::*value;
};
constexpr std::array fields{Field{"responder", &RunOptions::responder},
                            Field{"responder_text", &RunOptions::responder_text},
                            Field{"tracker", &RunOptions::tracker},
                            Field{"tracker_text", &RunOptions::tracker_text},
                            Field{"view", &RunOptions::view},
                            Field{"simulator", &RunOptions::simulator},
                            Field{"auto_simulator", &RunOptions::auto_simulator},
                            Field{"auto_rate_hz", &RunOptions::auto_rate_hz},
                            Field{"auto_why", &RunOptions::auto_why},
                            Field{"camera_file", &RunOptions::camera_file},
                            Field{"camera_text", &RunOptions::camera_text},
                            Field{"board_file", &RunOptions::board_file},
                            Field{"board_text", &RunOptions::board_text},
                            Field{"effector_file", &RunOptions::effector_file},
                            Field{"effector_text", &RunOptions::effector_text},
                            Field{"texts_file", &RunOptions::texts_file},
                            Field{"texts_text", &RunOptions::texts_text},
                            Field{"handed", &RunOptions::handed},
                            Field{"record_camera", &RunOptions::record_camera}};

constexpr std::string_view person = "human", automatic = "auto";

const std::string& simulator_asked_for(const RunOptions& options, const Protocol& protocol) {
  return options.simulator.empty() ? protocol.simulator.name : options.simulator;
}

double rate_hz_in(const std::string& text) {
  const auto rate_hz = number_in(text);
  if (rate_hz && *rate_hz > 0) return *rate_hz;
  throw Error(
      fmt::format("session.run_options can't be read: auto_rate_hz is \"{}\", expected "
                  "steps a second",
                  text));
}

// A session may be resumed from another folder than it was started in.
std::string absolute_path(const std::string& file) {
  std::error_code error;
  const auto path = std::filesystem::absolute(file, error);
  if (error) throw Error(fmt::format("can't find {}: {}", file, error.message()));
  return path.lexically_normal().string();
}

// The part after the colon as an absolute path.
std::string with_absolute_path(const std::string& name_and_file) {
  const auto [name, file] = split_name(name_and_file);
  return file.empty() ? name : name + ":" + absolute_path(file);
}

void read_file(std::string& file, std::string& text) {
  file = absolute_path(file);
  text = read_text_file(file);
}

const ResponderEntry& checked_responder(const std::string& responder) {
  const auto [name, file] = split_name(responder);
  const ResponderEntry& entry = responder_named(name);
  if (entry.file == ResponderFile::none && !file.empty())
    throw Error(fmt::format("responder \"{}\" takes no file", name), ExitCode::usage);
  if (entry.file == ResponderFile::folder && file.empty())
    throw Error(fmt::format("responder \"{0}\" needs a folder: {0}:FOLDER", name), ExitCode::usage);
  return entry;
}

void complete_responder(RunOptions& options) {
  options.responder_text.clear();
  if (has_person(options)) return;
  const ResponderEntry& entry = checked_responder(options.responder);
  if (auto [name, file] = split_name(options.responder); !file.empty()) {
    file = absolute_path(file);
    options.responder = name + ":" + file;
    if (entry.file == ResponderFile::parameters) options.responder_text = read_text_file(file);
  }
}

void complete_tracker(RunOptions& options) {
  const TrackerEntry& tracker = tracker_named(options.tracker);
  options.tracker_text.clear();
  if (!tracker.is_live) options.tracker = with_absolute_path(options.tracker);
  if (const std::string file = split_name(options.tracker).file;
      tracker.what == TrackerWhat::settings && !file.empty())
    options.tracker_text = read_text_file(file);
}

void find_camera_file(RunOptions& options, const TrackerEntry& tracker) {
  std::error_code unknown;  // what can't be looked at is not taken
  if (std::filesystem::exists(default_camera_file, unknown)) {
    options.camera_file = default_camera_file;
    return;
  }
  if (tracker.is_live) open_camera(options.tracker);  // one that is not there is told first
  throw Error(fmt::format("tracker \"{}\" needs the camera's calibration: --camera-file "
                          "CAMERA.yaml; make one with heft calibrate camera. A {} in this folder "
                          "would be taken",
                          tracker.name, default_camera_file),
              ExitCode::usage);
}

// Nothing is filmed; but people are shown in the demonstration how the effector is held.
void complete_unfilmed_apparatus(RunOptions& options) {
  options.camera_file = options.camera_text = options.board_text = options.effector_text = "";
  if (!has_person(options)) options.board_file = options.effector_file = "";
  if (options.board_file.empty() || options.effector_file.empty()) return;
  read_file(options.board_file, options.board_text);
  read_file(options.effector_file, options.effector_text);
}

void complete_apparatus(RunOptions& options) {
  const TrackerEntry& tracker = tracker_named(options.tracker);
  if (!tracker.has_camera && !options.record_camera.empty())
    throw Error(
        fmt::format("tracker \"{}\" has no camera whose pictures --record-camera could keep",
                    tracker.name),
        ExitCode::usage);
  if (!tracker.has_camera) return complete_unfilmed_apparatus(options);
  if (options.camera_file.empty()) find_camera_file(options, tracker);
  options.camera_file = absolute_path(options.camera_file);
  options.camera_text = read_camera_file(options.camera_file);
  read_file(options.board_file, options.board_text);
  read_file(options.effector_file, options.effector_text);
}

// A file that was named must be sound, whoever takes part; a model reads none of it.
void complete_texts(RunOptions& options) {
  if (!options.texts_file.empty()) {
    read_file(options.texts_file, options.texts_text);
    parse_texts(options.texts_text, options.texts_file);
  }
  if (!has_person(options)) options.texts_file = options.texts_text = "";
}

void check_view(const RunOptions& options) {
  const auto [name, file] = split_name(options.view);
  const ViewEntry& view = view_named(name);
  if (view.has_file && file.empty())
    throw Error(fmt::format("view \"{0}\" needs a file: {0}:FILE", name), ExitCode::usage);
  if (!view.has_file && !file.empty())
    throw Error(fmt::format("view \"{}\" takes nothing after it", name), ExitCode::usage);
  if (has_person(options) && !view.has_screen)
    throw Error(fmt::format("a person can't see or touch the view \"{}\"; expected --view window, "
                            "or a model as --responder",
                            name),
                ExitCode::usage);
}

void check_tracker(const RunOptions& options) {
  if (tracker_named(options.tracker).what == TrackerWhat::settings)
    parse_synthetic_camera(options.tracker_text, split_name(options.tracker).file);
}

}  // namespace

bool has_person(const RunOptions& options) {
  return options.responder == person;
}

bool runs_on_wall_clock(const RunOptions& options) {
  return has_person(options) || tracker_named(options.tracker).is_live ||
         view_named(split_name(options.view).name).has_screen;
}

Apparatus apparatus_of(const RunOptions& options) {
  if (!tracker_named(options.tracker).has_camera) return {};
  Apparatus apparatus{parse_intrinsics(options.camera_text, options.camera_file),
                      parse_board(options.board_text, options.board_file),
                      parse_effector(options.effector_text, options.effector_file)};
  require_different_tags(apparatus.board, apparatus.effector);
  return apparatus;
}

std::string to_json(const RunOptions& options) {
  nlohmann::ordered_json json;
  for (const Field& field : fields) json[field.name] = options.*field.value;
  return json.dump();
}

RunOptions run_options_from_json(const std::string& text) {
  try {
    const auto json = nlohmann::json::parse(text);
    RunOptions options;
    // An option that a log does not have came after it was written: it was not in force.
    for (const Field& field : fields)
      if (json.contains(field.name)) options.*field.value = json.at(field.name);
    return options;
  } catch (const nlohmann::json::exception& error) {
    throw Error(fmt::format("session.run_options can't be read: {}", error.what()));
  }
}

void complete(RunOptions& options) {
  complete_responder(options);
  complete_tracker(options);
  complete_apparatus(options);
  options.view = with_absolute_path(options.view);
  if (!options.record_camera.empty()) options.record_camera = absolute_path(options.record_camera);
  complete_texts(options);
  check(options);
}

void check(const RunOptions& options) {
  if (!has_person(options)) checked_responder(options.responder);
  check_view(options);
  check_tracker(options);
  apparatus_of(options);
  if (has_person(options)) parse_texts(options.texts_text, options.texts_file);
  if (!options.simulator.empty()) simulator_named(options.simulator);
  make_responder(options, 0);  // says what is wrong with its parameters before anything is logged
}

bool is_same_simulator(const std::string& a, const std::string& b) {
  return simulator_named(a).make == simulator_named(b).make;
}

std::string to_json(const OptionChange& change) {
  return nlohmann::ordered_json{{"option", change.option}, {"from", change.from}, {"to", change.to}}
      .dump();
}

std::vector<OptionChange> changes_between(const RunOptions& from, const RunOptions& to) {
  std::vector<OptionChange> changes;
  for (const Field& field : fields)
    if (from.*field.value != to.*field.value)
      changes.push_back({field.name, from.*field.value, to.*field.value});
  return changes;
}

void apply_deviation(RunOptions& options, const std::string& detail) {
  const auto json = nlohmann::json::parse(detail, nullptr, false);
  if (!json.is_object() || !json.contains("option") || !json.contains("to")) return;
  for (const Field& field : fields)
    if (json["option"] == field.name && json["to"].is_string()) options.*field.value = json["to"];
}

std::unique_ptr<Responder> make_responder(const RunOptions& options, std::uint64_t seed) {
  // Of a person only the hand is a model's, where no camera films theirs.
  const auto [name, file] = split_name(has_person(options) ? "simulated" : options.responder);
  const ResponderEntry& entry = responder_named(name);
  ResponderOptions made_with;
  // A seed of its own: nobody could draw the session's trials from it.
  made_with.seed = RandomStream(seed, "responder").bits();
  if (entry.file == ResponderFile::folder) made_with.folder = file;
  if (entry.file == ResponderFile::parameters && !options.responder_text.empty())
    made_with.parameters = parse_parameters(options.responder_text, file);
  return entry.make(made_with);
}

RunOptions with_auto_resolved(RunOptions options, const Protocol& protocol) {
  if (simulator_asked_for(options, protocol) != automatic) {
    options.auto_simulator = options.auto_rate_hz = options.auto_why = "";
  } else if (options.auto_simulator.empty()) {
    const SimulatorPick pick = resolve_auto(protocol);
    options.auto_simulator = pick.simulator;
    options.auto_rate_hz = fmt::format("{}", pick.rate_hz);
    options.auto_why = pick.why;
  }
  return options;
}

std::shared_ptr<const Protocol> protocol_for(Protocol protocol, const RunOptions& options) {
  protocol.simulator.name = simulator_asked_for(options, protocol);
  if (protocol.simulator.name == automatic && !options.auto_simulator.empty()) {
    protocol.simulator.name = options.auto_simulator;
    protocol.simulator.rate_hz = rate_hz_in(options.auto_rate_hz);
  }
  return std::make_shared<const Protocol>(std::move(protocol));
}

}  // namespace heft
