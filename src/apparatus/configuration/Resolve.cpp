#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "apparatus/configuration/ResolvedConfig.h"
#include "apparatus/sources/PictureSource.h"
#include "base/Program.h"
#include "base/files/TextFile.h"
#include "physics/DecouplingSimulator.h"
#include "physics/auto/Choice.h"
#include "protocol/readers/Files.h"
#include "tracking/camera/Camera.h"
#include "tracking/synthetic/SyntheticCamera.h"
#include "view/ArView.h"

namespace heft {

namespace fs = std::filesystem;

namespace {

// A session may be resumed from another working directory.
std::string absolute_path(const std::string& file) {
  std::error_code error;
  const auto path = fs::absolute(file, error);
  if (error) throw Error(fmt::format("cannot find {}: {}", file, error.message()));
  return path.lexically_normal().string();
}

bool exists(const char* file) {
  std::error_code unknown;  // unreadable files are skipped
  return fs::exists(file, unknown);
}

ConfigFile read_config_file(const std::string& file,
                            std::string (*read)(const std::string&) = read_text_file) {
  const std::string path = absolute_path(file), text = read(path);
  return {path, text, text.empty() ? "" : sha256(text)};
}

Plug read_tracker(Plug tracker) {
  const TrackerEntry& entry = tracker_named(tracker.name);
  if (entry.what == TrackerWhat::source && tracker.what.empty())
    throw Error(fmt::format("tracker \"{}\" needs a source: {}", entry.name, entry.summary),
                ExitCode::usage);
  if (entry.what == TrackerWhat::nothing && !tracker.what.empty())
    throw Error(fmt::format("tracker \"{}\" takes no argument", entry.name), ExitCode::usage);
  if (!entry.is_live && !tracker.what.empty()) tracker.what = absolute_path(tracker.what);
  if (entry.what == TrackerWhat::settings && !tracker.what.empty())
    tracker.text = read_text_file(tracker.what);
  return tracker;
}

Plug checked_view(Plug view) {
  const ViewEntry& entry = view_named(view.name);
  if (entry.has_file && view.what.empty())
    throw Error(fmt::format("view \"{0}\" needs a file: {0}:FILE", entry.name), ExitCode::usage);
  if (!entry.has_file && !view.what.empty())
    throw Error(fmt::format("view \"{}\" takes no argument", entry.name), ExitCode::usage);
  if (!view.what.empty()) view.what = absolute_path(view.what);
  return view;
}

}  // namespace

/// Applies options to a logged configuration or to none. Each value is the given option, else the
/// logged value, else the default.
class Resolver {
 public:
  Resolver(const SessionOptions& given, const SessionConfig* logged, const Protocol& protocol,
           std::uint64_t seed)
      : given_(given), logged_(logged), protocol_(protocol) {
    parts_.seed = seed;
    if (logged) config_ = *logged;
  }

  ResolvedConfig resolved() {
    take_plugs();
    require_compatible_plugs(parts_);
    take_apparatus();
    take_texts();
    take_display();
    take_simulator();
    take_the_rest();
    require_answerable(parts_, protocol_);
    take_places();
    take_protocol();
    return ResolvedConfig(std::move(parts_));
  }

 private:
  void take_plugs() {
    if (given_.responder || !logged_) config_.responder = given_.responder.value_or(Person{});
    if (auto* model = std::get_if<Plug>(&config_.responder)) {
      parts_.model = given_.responder ? resolve_model(*model) : logged_model(*model);
      *model = parts_.model.named;
    } else {
      parts_.model = logged_model({"simulated"});
    }
    const bool person = has_person(config_);
    if (given_.tracker || !logged_)
      config_.tracker =
          read_tracker(given_.tracker.value_or(person ? Plug{"camera", "0"} : Plug{"hand"}));
    if (given_.view || !logged_)
      config_.view = checked_view(given_.view.value_or(Plug{person ? "window" : "headless"}));
    parts_.tracker = &tracker_named(config_.tracker.name);
    parts_.view = &view_named(config_.view.name);
    if (parts_.tracker->what == TrackerWhat::settings)
      parse_synthetic_camera(config_.tracker.text, config_.tracker.what);
    parts_.model.responder(0);  // reports mistakes before anything is logged
    parts_.on_wall_clock = runs_on_wall_clock(person, *parts_.tracker, *parts_.view);
  }

  // Reads a given file; keeps a logged one.
  void take_file(ConfigFile& file, const std::optional<std::string>& given, const char* shipped) {
    if (given || file.text.empty())
      file = read_config_file(given ? *given : installed_file(shipped));
  }

  void take_apparatus() {
    const bool is_filmed = parts_.tracker->has_camera;
    if (!given_.record_camera.empty()) config_.record_camera = absolute_path(given_.record_camera);
    if (!is_filmed) {
      config_.camera = {};
      if (!given_.record_camera.empty())
        throw Error(fmt::format("tracker \"{}\" has no camera pictures for --record-camera",
                                parts_.tracker->name),
                    ExitCode::usage);
      config_.record_camera.clear();
    }
    // Without a camera, too, participants see how to hold the effector.
    if (is_filmed || has_person(config_)) {
      take_file(config_.board, given_.board_file, "protocols/apparatus/board.toml");
      take_file(config_.effector, given_.effector_file, "protocols/apparatus/effector.toml");
    } else {
      config_.board = config_.effector = {};
    }
    if (!is_filmed) return;
    if (given_.camera_file || config_.camera.text.empty())
      config_.camera = read_config_file(camera_file(), read_camera_file);
    parts_.apparatus = {parse_intrinsics(config_.camera.text, config_.camera.path),
                        parse_board(config_.board.text, config_.board.path),
                        parse_effector(config_.effector.text, config_.effector.path)};
    require_different_tags(parts_.apparatus.board, parts_.apparatus.effector);
  }

  std::string camera_file() const {
    if (given_.camera_file) return *given_.camera_file;
    if (parts_.tracker->what != TrackerWhat::source)
      return installed_file("protocols/apparatus/synthetic_camera.yaml");
    if (exists(default_camera_file)) return default_camera_file;
    const auto& [name, what, text] = config_.tracker;
    if (parts_.tracker->is_live) open_camera(name, what);  // a missing camera is reported first
    throw Error(fmt::format("tracker \"{}\" needs the camera's calibration: --camera-file "
                            "CAMERA.yaml; make one with heft calibrate camera. A {} in the current "
                            "directory would be used",
                            name, default_camera_file),
                ExitCode::usage);
  }

  // A named file must be valid, even if it is not needed.
  void take_texts() {
    const bool are_read = has_person(config_) || parts_.view->has_screen;
    const bool are_asked = !questionnaires_of(protocol_).empty();
    ConfigFile& texts = config_.texts;
    if (!given_.protocol_file.empty()) config_.protocol_file = absolute_path(given_.protocol_file);
    if (given_.language || (texts.text.empty() && (are_read || are_asked)))
      texts = read_config_file(texts_file(given_.language.value_or(protocol_.screens.language)));
    add_questionnaires(texts, config_.protocol_file, protocol_);
    if (!texts.text.empty()) parts_.texts = parse_texts(texts.text, texts.path);
    if (!are_read && !are_asked) {
      texts = {};
      parts_.texts = {};
    }
    config_.language = parts_.texts.language;
  }

  void take_display() {
    if (!parts_.view->has_screen) return forget_display();
    if (given_.display) config_.display = given_.display;
    if (given_.windowed) config_.window = WindowState::windowed;
    const bool had_screen = logged_ && view_named(logged_->view.name).has_screen;
    if (given_.display_file)
      measure_display(*given_.display_file);
    else if (!had_screen && exists(default_display_file))
      measure_display(default_display_file);
  }

  void measure_display(const std::string& file) {
    config_.display_file = absolute_path(file);
    const DisplayMeasures measured =
        parse_display(read_text_file(config_.display_file), config_.display_file);
    config_.display_w_px = measured.w_px;
    config_.display_h_px = measured.h_px;
    config_.display_w_mm = measured.w_mm;
    config_.display_h_mm = measured.h_mm;
    config_.eye_distance_mm = measured.eye_distance_mm;
    config_.display_latency_ms = measured.latency_ms;
  }

  void forget_display() {
    config_.window.reset();
    config_.display.reset();
    config_.display_file.clear();
    config_.display_w_px = config_.display_h_px = {};
    config_.display_w_mm = config_.display_h_mm = config_.refresh_hz = {};
    config_.eye_distance_mm = config_.display_scale = {};
    config_.display_latency_ms.clear();
  }

  bool simulator_stays() const {
    if (config_.simulator.empty() || !config_.rate_hz) return false;
    if (!parts_.tracker->has_pictures || !tracker_named(logged_->tracker.name).has_pictures)
      return false;
    if (!given_.simulator) return true;
    // A session keeps the choice of `auto` from its start, even if the error table has changed.
    if (given_.simulator == automatic && !config_.simulator_reason.empty()) return true;
    return simulator_named(*given_.simulator).make == simulator_named(config_.simulator).make;
  }

  void take_simulator() {
    if (!parts_.tracker->has_pictures && given_.simulator)
      throw Error(fmt::format("tracker \"{}\" has straight strokes alone, which it computes by "
                              "\"{}\"; expected no --simulator, or --tracker hand",
                              parts_.tracker->name, surrogate_simulator),
                  ExitCode::usage);
    if (!simulator_stays()) {
      const std::string& held =
          config_.simulator.empty() ? protocol_.simulator.name : config_.simulator;
      const SimulatorPick pick =
          parts_.tracker->has_pictures
              ? simulator_for(given_.simulator.value_or(held), protocol_)
              : SimulatorPick{std::string(surrogate_simulator), protocol_.display_rate_hz, ""};
      config_.simulator = pick.simulator;
      config_.rate_hz = pick.rate_hz;
      config_.simulator_reason = pick.why;
    }
    config_.simulator_edition = simulator_named(config_.simulator).edition;
    config_.input = protocol_.simulator.input.mode;
    config_.predict_s = protocol_.simulator.input.predict_s;
  }

  void take_the_rest() {
    if (!logged_) config_.settings = given_.settings;
    config_.display_rate_hz = protocol_.display_rate_hz;
    config_.gap_s = protocol_.onset.gap_s;
    config_.min_answer_s = protocol_.onset.min_answer_s;
    if (given_.controls) config_.controls = *given_.controls;
    if (given_.hand) config_.hand = given_.hand;
    if (given_.keys) config_.keys = given_.keys;
    if (!given_.run_by.empty()) config_.run_by = given_.run_by;
    if (!given_.backup.empty()) config_.backup = absolute_path(given_.backup);
    config_.heft_version = HEFT_VERSION;
    config_.build = build_name();
    config_.participant_parameters = {};
    if (!has_person(config_)) config_.participant_parameters = parts_.model.drawn(parts_.seed);
  }

  // Checks texts and protocol against each other.
  void take_protocol() {
    parts_.protocol = protocol_for(protocol_, config_);
    if (!parts_.texts.pages.empty()) require_questions(*parts_.protocol);
    if (has_person(config_) || parts_.view->has_screen)
      require_words(parts_.texts, *parts_.protocol, config_.texts.path);
  }

  void take_places() {
    parts_.film = config_.view.what;
    parts_.pictures = config_.record_camera;
    if (!logged_) return;
    for (std::string* path : {&parts_.film, &parts_.pictures})
      if (!path->empty()) *path = next_part(*path);
  }

  const SessionOptions& given_;
  const SessionConfig* logged_;
  const Protocol& protocol_;
  ResolvedConfig::Parts parts_;
  SessionConfig& config_ = parts_.config;
};

ResolvedConfig resolve(const SessionOptions& options, const Protocol& protocol,
                       std::uint64_t seed) {
  return Resolver(options, nullptr, protocol, seed).resolved();
}

ResolvedConfig resolve(const SessionOptions& options, const SessionConfig& logged,
                       const Protocol& protocol, std::uint64_t seed) {
  return Resolver(options, &logged, protocol, seed).resolved();
}

ResolvedModel resolve_model(Plug given) {
  const ResponderEntry& entry = responder_named(given.name);
  if (entry.file == ResponderFile::none && !given.what.empty())
    throw Error(fmt::format("responder \"{}\" takes no file", entry.name), ExitCode::usage);
  if (entry.file == ResponderFile::folder && given.what.empty())
    throw Error(fmt::format("responder \"{0}\" needs a folder: {0}:FOLDER", entry.name),
                ExitCode::usage);
  if (!given.what.empty()) {
    given.what = absolute_path(given.what);
    if (entry.file == ResponderFile::parameters) given.text = read_text_file(given.what);
  }
  return logged_model(std::move(given));
}

}  // namespace heft
