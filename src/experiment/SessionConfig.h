// The configuration that a session runs with and that may change: the event `setup` and the table
// `setup`. Every trial refers to the configuration it ran under; views, analysis, report and replay
// read nothing else. Text exists only at the edges: to_text() and from_text() serve columns, JSON
// and the command line.
#pragma once

#include <concepts>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/SimulationChoices.h"
#include "experiment/Column.h"
#include "experiment/EventPayloads.h"

namespace heft {

/// An entry of a plug table and its argument after the colon: "video:session.mp4".
struct Plug {
  std::string name;
  std::string what = {};  ///< a path or the number of a live camera; may be empty
  std::string text = {};  ///< contents of the settings file that `what` names, if any
  bool operator==(const Plug&) const = default;
};

struct Person {
  bool operator==(const Person&) const = default;
};
using ResponderChoice = std::variant<Person, Plug>;

/// A file with its contents, so that resume and replay do not need it.
struct ConfigFile {
  std::string path = {}, text = {}, sha256 = {};
  bool operator==(const ConfigFile&) const = default;
};

/// A change to the protocol: --set KEY=VALUE.
struct ProtocolSetting {
  std::string key, value;
  bool operator==(const ProtocolSetting&) const = default;
};

/// A display by its number, from 0, and the window system's name for it.
struct NamedDisplay {
  int number = 0;
  std::string name = {};
  bool operator==(const NamedDisplay&) const = default;
};

enum class Side { left, right };
template <>
struct EnumNames<Side> {
  static constexpr std::array<std::string_view, 2> names{"left", "right"};
};

enum class WindowState { full_screen, windowed };
template <>
struct EnumNames<WindowState> {
  static constexpr std::array<std::string_view, 2> names{"full screen", "window"};
};

/// Whether the participant's window accepts keys as answers.
enum class TakesKeys { no, yes };
template <>
struct EnumNames<TakesKeys> {
  static constexpr std::array<std::string_view, 2> names{"no", "yes"};
};

struct SessionConfig {
  static constexpr EventType event_type{"setup", EventRole::setting};
  ResponderChoice responder = Plug{"simulated"};
  Plug tracker{"hand"};
  Plug view{"headless"};
  std::string simulator;
  std::optional<int> simulator_edition;
  std::optional<double> rate_hz, display_rate_hz;
  std::string simulator_reason;
  std::optional<InputMode> input;
  std::optional<double> predict_s;
  std::optional<double> source_rate_hz;
  std::vector<ProtocolSetting> settings;
  Side controls = Side::right;
  std::optional<Side> hand;
  std::optional<WindowState> window;
  std::string display_file;
  std::optional<double> display_scale;
  std::string language;
  std::optional<NamedDisplay> display;
  std::optional<int> display_w_px, display_h_px;
  std::optional<double> display_w_mm, display_h_mm, refresh_hz, eye_distance_mm;
  ConfigFile camera, board, effector, texts;
  std::string record_camera;
  std::optional<double> gap_s, min_answer_s;
  std::optional<TakesKeys> keys;
  std::string heft_version, build;
  std::string run_by;  ///< the experimenter; empty: unknown
  /// Of the display, by latency_names (Stage.h); in the event only. Empty: not measured.
  std::map<std::string, double> display_latency_ms;
  /// Parameters drawn for a simulated participant, by name; table `participant_parameter`.
  std::map<std::string, double> participant_parameters;
  // In the event only: the protocol's file, beside which questionnaires are found, and the folder
  // for copies of the log.
  std::string protocol_file, backup;
  // In the event of `heft simulate` only: the seed and the participants of the whole simulation.
  std::optional<std::uint64_t> simulation_seed;
  std::optional<int> simulation_participants;

  static void event_columns(auto& setup, auto& row) { row.detail(setup); }
  bool operator==(const SessionConfig&) const = default;
};

// Texts for columns, JSON and the command line (Column.h). from_text() keeps a plug's settings.

std::string to_text(const Plug& plug);
std::string to_text(const ResponderChoice& responder);
std::string to_text(const ProtocolSetting& setting);
std::string to_text(const std::vector<ProtocolSetting>& settings);  ///< one per line
std::string to_text(const NamedDisplay& display);
bool from_text(std::string_view text, Plug& plug);
bool from_text(std::string_view text, ResponderChoice& responder);
bool from_text(std::string_view text, ProtocolSetting& setting);
bool from_text(std::string_view text, std::vector<ProtocolSetting>& settings);
bool from_text(std::string_view text, NamedDisplay& display);

/// Calls visit(column, field) for each column of the table `setup`.
template <typename Row, typename Visit>
requires std::same_as<std::remove_const_t<Row>, SessionConfig>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"responder", "", "human, or the model that answered, NAME[:FILE]"},
        AsText{row.responder});
  visit(LogColumn{"tracker", "", "source of the effector's poses, NAME[:ARGUMENT]"},
        AsText{row.tracker});
  visit(LogColumn{"simulator", "", "simulator of decoupled clones; empty: the protocol's"},
        row.simulator);
  visit(LogColumn{"simulator_edition", "", "edition of that simulator"}, row.simulator_edition);
  visit(LogColumn{"rate_hz", "Hz", "simulation steps per second"}, row.rate_hz);
  visit(LogColumn{"display_rate_hz", "Hz", "displayed frames per second"}, row.display_rate_hz);
  visit(LogColumn{"view", "", "view that displayed the frames, NAME[:FILE]"}, AsText{row.view});
  visit(LogColumn{"display", "", "display, by number and name"}, AsText{row.display});
  visit(LogColumn{"display_w_px", "px", "width of the display"}, row.display_w_px);
  visit(LogColumn{"display_h_px", "px", "height of the display"}, row.display_h_px);
  visit(LogColumn{"display_w_mm", "mm", "width of the display"}, row.display_w_mm);
  visit(LogColumn{"display_h_mm", "mm", "height of the display"}, row.display_h_mm);
  visit(LogColumn{"refresh_hz", "Hz", "refresh rate of the display"}, row.refresh_hz);
  visit(LogColumn{"eye_distance_mm", "mm", "distance from the eyes to the display"},
        row.eye_distance_mm);
  visit(LogColumn{"language", "", "language of the participant's texts; empty: no texts shown"},
        row.language);
  visit(LogColumn{"heft_version", "", "version of the program"}, row.heft_version);
  visit(LogColumn{"build", "", "compiler and machine of the program's build"}, row.build);
  visit(LogColumn{"simulator_reason", "", "why `auto` chose this simulator; empty: it was named"},
        row.simulator_reason);
  visit(LogColumn{"input", "", "effector's motion between two pictures: path, hold, extrapolate"},
        AsText{row.input});
  visit(LogColumn{"predict_s", "s", "prediction horizon of the effector's poses"}, row.predict_s);
  visit(LogColumn{"source_rate_hz", "Hz",
                  "pictures per second of the tracker's source; empty: the display's rate"},
        row.source_rate_hz);
  visit(LogColumn{"settings", "", "changes to the protocol by --set, one KEY=VALUE per line"},
        AsText{row.settings});
  visit(LogColumn{"controls", "", "side of the screen with the buttons: left, right"},
        AsText{row.controls});
  visit(LogColumn{"camera_file", "", "calibration file of the camera"}, row.camera.path);
  visit(LogColumn{"camera_sha256", "", "SHA-256 of its contents"}, row.camera.sha256);
  visit(LogColumn{"board_file", "", "description of the board"}, row.board.path);
  visit(LogColumn{"board_sha256", "", "SHA-256 of its contents"}, row.board.sha256);
  visit(LogColumn{"effector_file", "", "description of the effector"}, row.effector.path);
  visit(LogColumn{"effector_sha256", "", "SHA-256 of its contents"}, row.effector.sha256);
  visit(LogColumn{"texts_file", "", "the participant's texts"}, row.texts.path);
  visit(LogColumn{"texts_sha256", "", "SHA-256 of their contents"}, row.texts.sha256);
  visit(LogColumn{"record_camera", "", "folder where camera pictures are stored"},
        row.record_camera);
  visit(LogColumn{"gap_s", "s", "minimum time between two trials; empty: 0"}, row.gap_s);
  visit(LogColumn{"min_answer_s", "s",
                  "minimum time from the cubes' onset to the first answer; earlier answers are "
                  "refused; empty: 0"},
        row.min_answer_s);
  visit(LogColumn{"keys", "",
                  "whether the participant's window accepted keys: yes, no; empty: unknown or no "
                  "window"},
        AsText{row.keys});
  visit(LogColumn{"hand", "", "hand that holds the effector: left, right; empty: unknown"},
        NullIfEmpty{row.hand});
  visit(LogColumn{"window", "", "initial state of the window: full screen, window; empty: none"},
        NullIfEmpty{row.window});
  visit(LogColumn{"display_scale", "", "display pixels per unit of the window system"},
        row.display_scale);
  visit(LogColumn{"display_file", "", "file with the measured size of the display"},
        NullIfEmpty{row.display_file});
  visit(LogColumn{"operator", "", "who ran the session from here on; empty: unknown"},
        NullIfEmpty{row.run_by});
}

/// Visits what only the event holds: paths, contents of files, drawn parameters and the display's
/// latency.
template <typename Row, typename Visit>
requires std::same_as<std::remove_const_t<Row>, SessionConfig>
void visit_contents(Row& row, Visit&& visit) {
  visit("participant_parameters", row.participant_parameters);
  visit("display_latency_ms", row.display_latency_ms);
  visit("protocol_file", row.protocol_file);
  visit("backup", row.backup);
  visit("simulation_seed", row.simulation_seed);
  visit("simulation_participants", row.simulation_participants);
  if (auto* model = std::get_if<Plug>(&row.responder)) visit("responder_text", model->text);
  visit("tracker_text", row.tracker.text);
  visit("camera_text", row.camera.text);
  visit("board_text", row.board.text);
  visit("effector_text", row.effector.text);
  visit("texts_text", row.texts.text);
}

/// Whether a person answers, not a model.
inline bool has_person(const SessionConfig& setup) {
  return std::holds_alternative<Person>(setup.responder);
}

}  // namespace heft
