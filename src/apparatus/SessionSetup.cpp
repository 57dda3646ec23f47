#include "apparatus/SessionSetup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "apparatus/PictureSource.h"
#include "base/Build.h"
#include "base/PlugTable.h"
#include "base/Random.h"
#include "base/Sha256.h"
#include "base/TextFile.h"
#include "experiment/Parameter.h"
#include "experiment/ScreenTexts.h"
#include "physics/DecouplingSimulator.h"
#include "physics/auto/Choice.h"
#include "protocol/Files.h"
#include "responders/ResponderParameters.h"
#include "tracking/Camera.h"
#include "tracking/SyntheticCamera.h"
#include "view/ArView.h"

namespace heft {

NameAndFile split_name(const std::string& option) {
  const auto colon = option.find(':');
  if (colon == std::string::npos) return {option, ""};
  return {option.substr(0, colon), option.substr(colon + 1)};
}

namespace {

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

void complete_responder(SessionConfig& options) {
  options.responder_text.clear();
  if (has_person(options)) return;
  const ResponderEntry& entry = checked_responder(options.responder);
  if (auto [name, file] = split_name(options.responder); !file.empty()) {
    file = absolute_path(file);
    options.responder = name + ":" + file;
    if (entry.file == ResponderFile::parameters) options.responder_text = read_text_file(file);
  }
}

void complete_tracker(SessionConfig& options) {
  const TrackerEntry& tracker = tracker_named(options.tracker);
  options.tracker_text.clear();
  if (!tracker.is_live) options.tracker = with_absolute_path(options.tracker);
  if (const std::string file = split_name(options.tracker).file;
      tracker.what == TrackerWhat::settings && !file.empty())
    options.tracker_text = read_text_file(file);
}

void find_camera_file(SessionConfig& options, const TrackerEntry& tracker) {
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
void complete_unfilmed_apparatus(SessionConfig& options) {
  options.camera_file = options.camera_text = options.board_text = options.effector_text = "";
  if (!has_person(options)) options.board_file = options.effector_file = "";
  if (options.board_file.empty() || options.effector_file.empty()) return;
  read_file(options.board_file, options.board_text);
  read_file(options.effector_file, options.effector_text);
}

void complete_apparatus(SessionConfig& options) {
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

// What the display's window tells is told anew by each window.
void forget_display(SessionConfig& options) {
  options.window = options.display = options.display_file = "";
  options.display_w_px = options.display_h_px = {};
  options.display_w_mm = options.display_h_mm = options.refresh_hz = {};
  options.eye_distance_mm = options.display_scale = {};
}

void complete_display(SessionConfig& options) {
  if (!view_named(split_name(options.view).name).has_screen) return forget_display(options);
  display_number(options);
  std::error_code unknown;
  if (options.display_file.empty() && std::filesystem::exists(default_display_file, unknown))
    options.display_file = default_display_file;
  if (options.display_file.empty()) return;
  std::string text;
  read_file(options.display_file, text);
  const DisplayMeasures measured = parse_display(text, options.display_file);
  options.display_w_px = measured.w_px;
  options.display_h_px = measured.h_px;
  options.display_w_mm = measured.w_mm;
  options.display_h_mm = measured.h_mm;
  options.eye_distance_mm = measured.eye_distance_mm;
}

void check_view(const SessionConfig& options) {
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

void check_dragged(const SessionConfig& options) {
  if (!has_person(options))
    throw Error(fmt::format("tracker \"mouse\": a person drags the effector, but the responder is "
                            "\"{}\", which has a hand of its own; expected --tracker hand or "
                            "synthetic, or --responder human",
                            split_name(options.responder).name),
                ExitCode::usage);
  if (!view_named(split_name(options.view).name).has_screen)
    throw Error(
        fmt::format("tracker \"mouse\": the effector is dragged in the window, and the view "
                    "\"{}\" has none; expected --view window",
                    options.view),
        ExitCode::usage);
}

void check_tracker(const SessionConfig& options) {
  if (tracker_named(options.tracker).is_dragged) check_dragged(options);
  if (tracker_named(options.tracker).what == TrackerWhat::settings)
    parse_synthetic_camera(options.tracker_text, split_name(options.tracker).file);
}

}  // namespace

bool runs_on_wall_clock(const SessionConfig& options) {
  return has_person(options) || tracker_named(options.tracker).is_live ||
         view_named(split_name(options.view).name).has_screen;
}

Apparatus apparatus_of(const SessionConfig& options) {
  if (!tracker_named(options.tracker).has_camera) return {};
  Apparatus apparatus{parse_intrinsics(options.camera_text, options.camera_file),
                      parse_board(options.board_text, options.board_file),
                      parse_effector(options.effector_text, options.effector_file)};
  require_different_tags(apparatus.board, apparatus.effector);
  return apparatus;
}

// A file that was named must be sound, whoever takes part; where no screen is, nobody reads it.
void complete_texts(SessionConfig& options) {
  if (!options.texts_file.empty()) {
    if (options.texts_text.empty()) read_file(options.texts_file, options.texts_text);
    parse_texts(options.texts_text, options.texts_file);
  }
  const bool has_screen = view_named(split_name(options.view).name).has_screen;
  if (!has_person(options) && !has_screen) options.texts_file = options.texts_text = "";
}

void complete(SessionConfig& options) {
  complete_responder(options);
  complete_tracker(options);
  complete_apparatus(options);
  options.view = with_absolute_path(options.view);
  if (!options.record_camera.empty()) options.record_camera = absolute_path(options.record_camera);
  complete_texts(options);
  complete_display(options);
  check(options);
}

void check(const SessionConfig& options) {
  if (!has_person(options)) checked_responder(options.responder);
  check_tracker(options);
  check_view(options);
  apparatus_of(options);
  const bool has_screen = view_named(split_name(options.view).name).has_screen;
  if (has_person(options) || has_screen || !options.texts_text.empty())
    parse_texts(options.texts_text, options.texts_file);
  if (!options.simulator.empty()) simulator_named(options.simulator);
  make_responder(options, 0);  // says what is wrong with its parameters before anything is logged
}

bool is_same_simulator(const std::string& a, const std::string& b) {
  return simulator_named(a).make == simulator_named(b).make;
}

namespace {
// What a responder is made with.
struct Making {
  const ResponderEntry& entry;
  ResponderOptions options;
};

Making making(const std::string& responder, const SessionConfig& setup, std::uint64_t seed) {
  const auto [name, file] = split_name(responder);
  Making made{responder_named(name), {}};
  // A seed of its own: nobody could draw the session's trials from it.
  made.options.seed = RandomStream(seed, "responder").bits();
  if (made.entry.file == ResponderFile::folder) made.options.folder = file;
  if (made.entry.file == ResponderFile::parameters && !setup.responder_text.empty())
    made.options.parameters = parse_parameters(setup.responder_text, file);
  return made;
}
}  // namespace

std::unique_ptr<Responder> make_responder(const SessionConfig& setup, std::uint64_t seed) {
  // Of a person only the hand is a model's, where no camera films theirs.
  const Making made = making(has_person(setup) ? "simulated" : setup.responder, setup, seed);
  return made.entry.make(made.options);
}

SessionConfig with_participant(SessionConfig setup, std::uint64_t seed) {
  setup.participant_parameters.clear();
  if (has_person(setup)) return setup;
  const Making made = making(setup.responder, setup, seed);
  setup.participant_parameters = drawn_values(made.options, made.entry.parts);
  return setup;
}

namespace {
void resolve_simulator(SessionConfig& setup, const Protocol& protocol) {
  if (setup.simulator.empty()) setup.simulator = protocol.simulator.name;
  if (setup.simulator != automatic) {
    setup.rate_hz = protocol.simulator.rate_hz;
    return;
  }
  const SimulatorPick pick = resolve_auto(protocol);
  setup.simulator = pick.simulator;
  setup.rate_hz = pick.rate_hz;
  setup.simulator_why = pick.why;
}

std::string hash_of(const std::string& text) {
  return text.empty() ? "" : sha256(text);
}

// A column's value, for people.
struct Shown {
  std::map<std::string, std::string>& values;

  void operator()(const LogColumn& column, const std::string& text) const {
    values[std::string(column.name)] = text;
  }
  void operator()(const LogColumn& column, const NullIfEmpty<const std::string>& text) const {
    (*this)(column, text.value);
  }
  template <typename Value>
  void operator()(const LogColumn& column, const std::optional<Value>& value) const {
    values[std::string(column.name)] = value ? fmt::format("{}", *value) : "";
  }
};

std::map<std::string, std::string> shown(const SessionConfig& setup) {
  std::map<std::string, std::string> values;
  visit_columns(setup, Shown{values});
  return values;
}
}  // namespace

SessionConfig in_force(SessionConfig setup, const Protocol& protocol) {
  if (setup.simulator.empty() || !setup.rate_hz) resolve_simulator(setup, protocol);
  setup.simulator_edition = simulator_named(setup.simulator).edition;
  setup.display_rate_hz = protocol.display_rate_hz;
  setup.input = name_of(protocol.simulator.input.mode);
  setup.predict_s = protocol.simulator.input.predict_s;
  setup.gap_s = protocol.onset.gap_s;
  setup.min_answer_s = protocol.onset.min_answer_s;
  setup.language =
      setup.texts_text.empty() ? "" : parse_texts(setup.texts_text, setup.texts_file).language;
  setup.camera_sha256 = hash_of(setup.camera_text);
  setup.board_sha256 = hash_of(setup.board_text);
  setup.effector_sha256 = hash_of(setup.effector_text);
  setup.texts_sha256 = hash_of(setup.texts_text);
  setup.heft_version = HEFT_VERSION;
  setup.build = build_name();
  return setup;
}

int display_number(const SessionConfig& setup) {
  const std::string number = setup.display.substr(0, setup.display.find(' '));
  if (number.empty()) return 0;
  if (number.size() < 3 && std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; }))
    return std::stoi(number);
  throw Error(fmt::format("--display {}: expected the number of a display, from 0 (heft doctor "
                          "lists them)",
                          setup.display),
              ExitCode::usage);
}

bool is_windowed(const SessionConfig& setup) {
  return setup.window == "window";
}

SessionConfig with_display(SessionConfig setup, const std::optional<DisplayFacts>& display) {
  if (!display) return setup;
  const auto& [number, name, w_px, h_px, refresh_hz, scale] = *display;
  if (setup.display_w_mm && (setup.display_w_px != w_px || setup.display_h_px != h_px))
    throw Error(fmt::format("{} is of a display of {} x {} pixels, but this one has {} x {}: "
                            "measure it (heft calibrate display), or name its file with "
                            "--display-file",
                            setup.display_file, setup.display_w_px.value_or(0),
                            setup.display_h_px.value_or(0), w_px, h_px),
                ExitCode::invalid_file);
  setup.display = fmt::format("{} {}", number, name);
  setup.display_w_px = w_px;
  setup.display_h_px = h_px;
  setup.refresh_hz = refresh_hz;
  setup.display_scale = scale;
  if (setup.window.empty()) setup.window = "full screen";
  return setup;
}

SessionConfig with_source_rate(SessionConfig setup, std::optional<double> rate_hz) {
  constexpr double same_rate = 0.01;  // 29.97 is 30
  setup.source_rate_hz = rate_hz;
  if (rate_hz && setup.display_rate_hz &&
      std::abs(*rate_hz / *setup.display_rate_hz - 1) < same_rate)
    setup.source_rate_hz.reset();
  return setup;
}

std::shared_ptr<const Protocol> protocol_for(Protocol protocol, const SessionConfig& setup) {
  if (!setup.simulator.empty()) protocol.simulator.name = setup.simulator;
  if (setup.rate_hz) protocol.simulator.rate_hz = *setup.rate_hz;
  if (const auto mode = named<InputMode>(setup.input)) protocol.simulator.input.mode = *mode;
  if (setup.predict_s) protocol.simulator.input.predict_s = *setup.predict_s;
  take_questions(protocol, setup.texts_text, setup.texts_file);
  return std::make_shared<const Protocol>(std::move(protocol));
}

std::vector<SetupChange> changes_between(const SessionConfig& from, const SessionConfig& to) {
  std::vector<SetupChange> changes;
  const auto before = shown(from), after = shown(to);
  for (const auto& [column, value] : after)
    if (before.at(column) != value) changes.push_back({column, before.at(column), value});
  return changes;
}

}  // namespace heft
