// The options a session is run with, as kept in session.run_options so that resume and replay need
// nothing but the log.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/Protocol.h"
#include "responders/Responder.h"
#include "tracking/MarkerBody.h"

namespace heft {

struct RunOptions {
  std::string responder = "simulated";  ///< NAME or NAME:FILE, FILE as an absolute path
  std::string responder_text;           ///< contents of a parameter FILE when the session started
  std::string tracker = "hand";         ///< NAME or NAME:WHAT, a file as an absolute path
  std::string tracker_text;             ///< contents of a FILE of settings when the session started
  std::string view = "headless";
  std::string simulator;  ///< instead of the protocol's; empty: the protocol's
  /// What `auto` was resolved to before the first trial: a simulator, its steps a second, and why.
  /// Empty where nobody asked for `auto`.
  std::string auto_simulator, auto_rate_hz, auto_why;
  // Files of the apparatus and the texts as they were when the session started; empty where neither
  // a camera nor a person takes part.
  std::string camera_file, camera_text;
  std::string board_file, board_text;
  std::string effector_file, effector_text;
  std::string texts_file, texts_text;
  std::string handed = "right";  ///< "left" mirrors the controls
  std::string record_camera;     ///< a folder for the camera's pictures; empty: they are not kept
};

/// Options as somebody gives them; for what is not given there is a default, or it stays as it was.
struct GivenOptions {
  std::optional<std::string> responder, tracker, view, simulator;
  std::optional<std::string> camera_file, board_file, effector_file;
};

/// A person answers, at a screen.
bool has_person(const RunOptions& options);

/// Whether the session keeps the time of day: with a live camera, a screen or a person. Otherwise
/// it runs as fast as it can, and no result depends on how fast that is.
bool runs_on_wall_clock(const RunOptions& options);

/// The camera's calibration and the marker bodies that the options hold; empty without a camera.
/// @throws InvalidFile naming what is wrong in which file; Error where board and effector share a
///   tag
Apparatus apparatus_of(const RunOptions& options);

/// "video:session.mp4": the name of a plug and what follows its colon.
struct NameAndFile {
  std::string name, file;
};
NameAndFile split_name(const std::string& option);

std::string to_json(const RunOptions& options);

/// @throws Error when the text is not what to_json writes
RunOptions run_options_from_json(const std::string& text);

/// The calibration that is taken where nobody names another, if the working folder has it.
inline constexpr const char* default_camera_file = "camera.yaml";

/// Makes the files' names absolute, reads what the session needs of them, and checks everything.
/// @throws Error (usage) for unknown names and combinations that can't work
void complete(RunOptions& options);

/// As complete(), for options from a log: the parameters stay those that were read then.
void check(const RunOptions& options);

/// Whether the two names in the table of simulators mean the same one.
/// @throws Error (usage) for an unknown name
bool is_same_simulator(const std::string& a, const std::string& b);

/// An option given anew when a session goes on. Its JSON is the detail of a `deviation` event:
/// {"option":"responder","from":"simulated","to":"coin"}.
struct OptionChange {
  std::string option, from, to;
};

std::string to_json(const OptionChange& change);

/// The options that differ, one change each.
std::vector<OptionChange> changes_between(const RunOptions& from, const RunOptions& to);

/// Puts a logged change in force; the detail of a deviation of another kind changes nothing.
void apply_deviation(RunOptions& options, const std::string& detail);

std::unique_ptr<Responder> make_responder(const RunOptions& options, std::uint64_t seed);

/// The options with what `auto` is for this protocol, if it is asked for and not resolved yet. A
/// choice that a log holds stays, whatever the error table says now.
RunOptions with_auto_resolved(RunOptions options, const Protocol& protocol);

/// The protocol with the options' simulator in place of its own; for `auto` what it was resolved
/// to, at its own rate.
std::shared_ptr<const Protocol> protocol_for(Protocol protocol, const RunOptions& options);

}  // namespace heft
