// What is in force while a session runs: everything that it is run with and that could change on
// the way. Told once, as the event `setup`; every trial points to the setup that it ran under, and
// whoever wants to know (views, analysis, report, replay, desk) reads that alone.
#pragma once

#include <concepts>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiment/Column.h"
#include "experiment/EventType.h"

namespace heft {

struct SessionConfig {
  static constexpr EventType event_type{"setup", EventRole::setting};
  std::string responder = "simulated";
  std::string tracker = "hand";
  std::string view = "headless";
  std::string simulator;
  std::optional<int> simulator_edition;
  std::optional<double> rate_hz, display_rate_hz;
  std::string simulator_why;
  std::string input;
  std::optional<double> predict_s;
  std::optional<double> source_rate_hz;
  std::string settings;
  std::string handed = "right";
  std::string hand;
  std::string window, display_file;
  std::optional<double> display_scale;
  std::string language;
  std::string display;
  std::optional<int> display_w_px, display_h_px;
  std::optional<double> display_w_mm, display_h_mm, refresh_hz, eye_distance_mm;
  std::string camera_file, camera_sha256;
  std::string board_file, board_sha256;
  std::string effector_file, effector_sha256;
  std::string texts_file, texts_sha256;
  std::string record_camera;
  std::optional<double> gap_s, min_answer_s;
  std::string keys;
  std::string heft_version, build;
  /// What a simulated participant was drawn as, by name; in a table of its own.
  std::map<std::string, double> participant_parameters;
  // In the event, not in the table: where the protocol was read, so that what stands beside it is
  // found; the folder that copies of the log are put to; and the files' contents, so that a session
  // goes on and is replayed without them.
  std::string protocol_file, backup;
  std::string responder_text, tracker_text, camera_text, board_text, effector_text, texts_text;

  static void event_columns(auto& setup, auto& row) { row.detail(setup); }
  bool operator==(const SessionConfig&) const = default;
};

/// Calls visit(column, field) for each column of the table `setup`.
template <typename Row, typename Visit>
requires std::same_as<std::remove_const_t<Row>, SessionConfig>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"responder", "", "who answered: human, or a model NAME[:FILE]", 3},
        row.responder);
  visit(LogColumn{"tracker", "", "where the effector's poses came from, NAME[:WHAT]", 3},
        row.tracker);
  visit(LogColumn{"simulator", "", "simulator of the decoupling; empty: the protocol's", 3},
        row.simulator);
  visit(LogColumn{"simulator_edition", "", "edition of that simulator", 3}, row.simulator_edition);
  visit(LogColumn{"rate_hz", "Hz", "steps of the simulator a second", 3}, row.rate_hz);
  visit(LogColumn{"display_rate_hz", "Hz", "frames displayed a second", 3}, row.display_rate_hz);
  visit(LogColumn{"view", "", "what showed the frames, NAME[:FILE]", 3}, row.view);
  visit(LogColumn{"display", "", "the display, by number and name", 3}, row.display);
  visit(LogColumn{"display_w_px", "px", "width of the display", 3}, row.display_w_px);
  visit(LogColumn{"display_h_px", "px", "height of the display", 3}, row.display_h_px);
  visit(LogColumn{"display_w_mm", "mm", "width of the display", 3}, row.display_w_mm);
  visit(LogColumn{"display_h_mm", "mm", "height of the display", 3}, row.display_h_mm);
  visit(LogColumn{"refresh_hz", "Hz", "refresh rate of the display", 3}, row.refresh_hz);
  visit(LogColumn{"eye_distance_mm", "mm", "from the eyes to the display", 3}, row.eye_distance_mm);
  visit(LogColumn{"language", "", "of the participant's texts; empty: nobody reads", 3},
        row.language);
  visit(LogColumn{"heft_version", "", "version of the program", 3}, row.heft_version);
  visit(LogColumn{"build", "", "compiler and machine that built the program", 3}, row.build);
  visit(LogColumn{"simulator_why", "", "why `auto` picked this simulator; empty: it was named", 3},
        row.simulator_why);
  visit(LogColumn{"input", "", "how poses between two pictures are taken: path, hold, extrapolate",
                  3},
        row.input);
  visit(LogColumn{"predict_s", "s", "how far ahead poses are predicted", 3}, row.predict_s);
  visit(
      LogColumn{"source_rate_hz", "Hz",
                "pictures a second that the source gives; empty: as many as the display shows", 3},
      row.source_rate_hz);
  visit(LogColumn{"settings", "", "changes to the protocol by --set, one KEY=VALUE a line", 3},
        row.settings);
  visit(LogColumn{"handed", "", "hand that the controls are laid out for: left, right", 3},
        row.handed);
  visit(LogColumn{"camera_file", "", "the camera's calibration", 3}, row.camera_file);
  visit(LogColumn{"camera_sha256", "", "hash of its contents", 3}, row.camera_sha256);
  visit(LogColumn{"board_file", "", "the board", 3}, row.board_file);
  visit(LogColumn{"board_sha256", "", "hash of its contents", 3}, row.board_sha256);
  visit(LogColumn{"effector_file", "", "the effector", 3}, row.effector_file);
  visit(LogColumn{"effector_sha256", "", "hash of its contents", 3}, row.effector_sha256);
  visit(LogColumn{"texts_file", "", "the participant's texts", 3}, row.texts_file);
  visit(LogColumn{"texts_sha256", "", "hash of their contents", 3}, row.texts_sha256);
  visit(LogColumn{"record_camera", "", "folder that the camera's pictures are kept in", 3},
        row.record_camera);
  visit(
      LogColumn{"gap_s", "s", "least time from a trial's end to the next one's start; empty: 0", 4},
      row.gap_s);
  visit(LogColumn{"min_answer_s", "s",
                  "least time from a trial's cubes to its first answer, earlier ones are refused; "
                  "empty: 0",
                  4},
        row.min_answer_s);
  visit(LogColumn{"keys", "",
                  "whether the participant's window took keys: yes, no; empty: not told, or no "
                  "window",
                  4},
        row.keys);
  visit(LogColumn{"hand", "", "hand that holds the effector: left, right; empty: not told", 4},
        NullIfEmpty{row.hand});
  visit(
      LogColumn{"window", "", "how the window stood at first: full screen, window; empty: none", 4},
      NullIfEmpty{row.window});
  visit(LogColumn{"display_scale", "", "pixels of the display a unit of the window system", 4},
        row.display_scale);
  visit(LogColumn{"display_file", "", "file of the measured display", 4},
        NullIfEmpty{row.display_file});
}

/// What only the event keeps: places, the contents of its files, and the drawn participant.
template <typename Row, typename Visit>
requires std::same_as<std::remove_const_t<Row>, SessionConfig>
void visit_contents(Row& row, Visit&& visit) {
  visit("participant_parameters", row.participant_parameters);
  visit("protocol_file", row.protocol_file);
  visit("backup", row.backup);
  visit("responder_text", row.responder_text);
  visit("tracker_text", row.tracker_text);
  visit("camera_text", row.camera_text);
  visit("board_text", row.board_text);
  visit("effector_text", row.effector_text);
  visit("texts_text", row.texts_text);
}

/// Its changes to the protocol, KEY=VALUE each.
std::vector<std::string> settings_of(const SessionConfig& setup);

/// A person answers, not a model.
inline bool has_person(const SessionConfig& setup) {
  return setup.responder == "human";
}

}  // namespace heft
