// What a session runs with and that could change: recorded as the event `setup` and in the table
// `setup`. Every trial refers to the configuration that it ran under; views, analysis, report and
// replay read nothing else. Text exists at the edges alone: to_text() and from_text() serve
// columns, JSON and the command line.
#pragma once

#include <concepts>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/SimulationChoices.h"
#include "experiment/Column.h"
#include "experiment/EventType.h"

namespace heft {

/// An entry of a plug table and what follows its colon: "video:session.mp4".
struct Plug {
  std::string name;
  std::string what = {};  ///< a path, or the number of a live camera; empty: nothing follows
  std::string text = {};  ///< contents of the file of settings that `what` names, if it does
  bool operator==(const Plug&) const = default;
};

struct Person {
  bool operator==(const Person&) const = default;
};
using WhoAnswers = std::variant<Person, Plug>;

/// A file as it was read, so that a session resumes and is replayed without it.
struct ConfigFile {
  std::string path = {}, text = {}, sha256 = {};
  bool operator==(const ConfigFile&) const = default;
};

/// A change to the protocol: --set KEY=VALUE.
struct ProtocolSetting {
  std::string key, value;
  bool operator==(const ProtocolSetting&) const = default;
};

/// A display by its number, from 0, and the name that the window system gives it.
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

/// Whether the participant's window takes keys as answers.
enum class TakesKeys { no, yes };
template <>
struct EnumNames<TakesKeys> {
  static constexpr std::array<std::string_view, 2> names{"no", "yes"};
};

struct SessionConfig {
  static constexpr EventType event_type{"setup", EventRole::setting};
  WhoAnswers responder = Plug{"simulated"};
  Plug tracker{"hand"};
  Plug view{"headless"};
  std::string simulator;
  std::optional<int> simulator_edition;
  std::optional<double> rate_hz, display_rate_hz;
  std::string simulator_why;
  std::optional<InputMode> input;
  std::optional<double> predict_s;
  std::optional<double> source_rate_hz;
  std::vector<ProtocolSetting> settings;
  Side handed = Side::right;
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
  /// What a simulated participant was drawn as, by name; in a table of its own.
  std::map<std::string, double> participant_parameters;
  // In the event, not in the table: where the protocol was read, so that questionnaires beside it
  // are found, and the folder that copies of the log are put into.
  std::string protocol_file, backup;

  static void event_columns(auto& setup, auto& row) { row.detail(setup); }
  bool operator==(const SessionConfig&) const = default;
};

// Their texts in columns, JSON and on the command line (Column.h). A plug's text keeps its
// settings.

std::string to_text(const Plug& plug);
std::string to_text(const WhoAnswers& responder);
std::string to_text(const ProtocolSetting& setting);
std::string to_text(const std::vector<ProtocolSetting>& settings);  ///< a line each
std::string to_text(const NamedDisplay& display);
bool from_text(std::string_view text, Plug& plug);
bool from_text(std::string_view text, WhoAnswers& responder);
bool from_text(std::string_view text, ProtocolSetting& setting);
bool from_text(std::string_view text, std::vector<ProtocolSetting>& settings);
bool from_text(std::string_view text, NamedDisplay& display);

/// Calls visit(column, field) for each column of the table `setup`.
template <typename Row, typename Visit>
requires std::same_as<std::remove_const_t<Row>, SessionConfig>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"responder", "", "who answered: human, or a model NAME[:FILE]"},
        AsText{row.responder});
  visit(LogColumn{"tracker", "", "where the effector's poses came from, NAME[:WHAT]"},
        AsText{row.tracker});
  visit(LogColumn{"simulator", "", "simulator of the decoupling; empty: the protocol's"},
        row.simulator);
  visit(LogColumn{"simulator_edition", "", "edition of that simulator"}, row.simulator_edition);
  visit(LogColumn{"rate_hz", "Hz", "steps of the simulator a second"}, row.rate_hz);
  visit(LogColumn{"display_rate_hz", "Hz", "frames displayed a second"}, row.display_rate_hz);
  visit(LogColumn{"view", "", "what showed the frames, NAME[:FILE]"}, AsText{row.view});
  visit(LogColumn{"display", "", "the display, by number and name"}, AsText{row.display});
  visit(LogColumn{"display_w_px", "px", "width of the display"}, row.display_w_px);
  visit(LogColumn{"display_h_px", "px", "height of the display"}, row.display_h_px);
  visit(LogColumn{"display_w_mm", "mm", "width of the display"}, row.display_w_mm);
  visit(LogColumn{"display_h_mm", "mm", "height of the display"}, row.display_h_mm);
  visit(LogColumn{"refresh_hz", "Hz", "refresh rate of the display"}, row.refresh_hz);
  visit(LogColumn{"eye_distance_mm", "mm", "from the eyes to the display"}, row.eye_distance_mm);
  visit(LogColumn{"language", "", "of the participant's texts; empty: nobody reads"}, row.language);
  visit(LogColumn{"heft_version", "", "version of the program"}, row.heft_version);
  visit(LogColumn{"build", "", "compiler and machine that built the program"}, row.build);
  visit(LogColumn{"simulator_why", "", "why `auto` picked this simulator; empty: it was named"},
        row.simulator_why);
  visit(LogColumn{"input", "", "how poses between two pictures are taken: path, hold, extrapolate"},
        AsText{row.input});
  visit(LogColumn{"predict_s", "s", "how far ahead poses are predicted"}, row.predict_s);
  visit(LogColumn{"source_rate_hz", "Hz",
                  "pictures a second that the source gives; empty: as many as the display shows"},
        row.source_rate_hz);
  visit(LogColumn{"settings", "", "changes to the protocol by --set, one KEY=VALUE a line"},
        AsText{row.settings});
  visit(LogColumn{"handed", "", "hand that the controls are laid out for: left, right"},
        AsText{row.handed});
  visit(LogColumn{"camera_file", "", "the camera's calibration"}, row.camera.path);
  visit(LogColumn{"camera_sha256", "", "hash of its contents"}, row.camera.sha256);
  visit(LogColumn{"board_file", "", "the board"}, row.board.path);
  visit(LogColumn{"board_sha256", "", "hash of its contents"}, row.board.sha256);
  visit(LogColumn{"effector_file", "", "the effector"}, row.effector.path);
  visit(LogColumn{"effector_sha256", "", "hash of its contents"}, row.effector.sha256);
  visit(LogColumn{"texts_file", "", "the participant's texts"}, row.texts.path);
  visit(LogColumn{"texts_sha256", "", "hash of their contents"}, row.texts.sha256);
  visit(LogColumn{"record_camera", "", "folder that the camera's pictures are kept in"},
        row.record_camera);
  visit(LogColumn{"gap_s", "s", "least time from a trial's end to the next one's start; empty: 0"},
        row.gap_s);
  visit(LogColumn{"min_answer_s", "s",
                  "least time from a trial's cubes to its first answer, earlier ones are refused; "
                  "empty: 0"},
        row.min_answer_s);
  visit(LogColumn{"keys", "",
                  "whether the participant's window took keys: yes, no; empty: not told, or no "
                  "window"},
        AsText{row.keys});
  visit(LogColumn{"hand", "", "hand that holds the effector: left, right; empty: not told"},
        NullIfEmpty{row.hand});
  visit(LogColumn{"window", "", "how the window stood at first: full screen, window; empty: none"},
        NullIfEmpty{row.window});
  visit(LogColumn{"display_scale", "", "pixels of the display a unit of the window system"},
        row.display_scale);
  visit(LogColumn{"display_file", "", "file of the measured display"},
        NullIfEmpty{row.display_file});
}

/// What only the event keeps: places, the contents of its files, and the drawn participant.
template <typename Row, typename Visit>
requires std::same_as<std::remove_const_t<Row>, SessionConfig>
void visit_contents(Row& row, Visit&& visit) {
  visit("participant_parameters", row.participant_parameters);
  visit("protocol_file", row.protocol_file);
  visit("backup", row.backup);
  if (auto* model = std::get_if<Plug>(&row.responder)) visit("responder_text", model->text);
  visit("tracker_text", row.tracker.text);
  visit("camera_text", row.camera.text);
  visit("board_text", row.board.text);
  visit("effector_text", row.effector.text);
  visit("texts_text", row.texts.text);
}

/// A person answers, not a model.
inline bool has_person(const SessionConfig& setup) {
  return std::holds_alternative<Person>(setup.responder);
}

}  // namespace heft
