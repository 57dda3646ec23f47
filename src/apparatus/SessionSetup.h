// How a session's setup comes about and what is made from it: options as somebody gives them, the
// files they name, what the protocol adds. A setup holds all of it, so that resume and replay need
// nothing but the log.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/DisplayFacts.h"
#include "experiment/SessionConfig.h"
#include "protocol/Protocol.h"
#include "responders/Responder.h"
#include "tracking/MarkerBody.h"

namespace heft {

struct SimulatorPick;

/// Options as somebody gives them; for what is not given there is a default, or it stays as it was.
struct GivenOptions {
  std::optional<std::string> responder, tracker, view, simulator;
  std::optional<std::string> camera_file, board_file, effector_file, texts_file;
  std::optional<std::string> display, display_file;
  bool windowed = false;
  std::vector<std::string> settings;  ///< changes to the protocol, KEY=VALUE each
};

/// Whether the session keeps the time of day: with a live camera, a screen or a person. Otherwise
/// it runs as fast as it can, and no result depends on how fast that is.
bool runs_on_wall_clock(const SessionConfig& options);

/// The camera's calibration and the marker bodies that the options hold; empty without a camera.
/// @throws InvalidFile naming what is wrong in which file; Error where board and effector share a
///   tag
Apparatus apparatus_of(const SessionConfig& options);

/// "video:session.mp4": the name of a plug and what follows its colon.
struct NameAndFile {
  std::string name, file;
};
NameAndFile split_name(const std::string& option);

/// The calibration that is taken where nobody names another, if the working folder has it.
inline constexpr const char* default_camera_file = "camera.yaml";

/// The measured display that is taken where nobody names another, likewise.
inline constexpr const char* default_display_file = "display.toml";

/// Makes the files' names absolute, reads what the session needs of them, and checks everything.
/// @throws Error (usage) for unknown names and combinations that can't work
void complete(SessionConfig& options);

/// The same of the participant's texts alone: what was read before stays as it is.
void complete_texts(SessionConfig& options);

/// Whether who takes part can do what the protocol asks.
/// @throws Error (usage) where answers need contact with every cube, and the hand is a model's that
///   touches none; where the simulator knows straight strokes alone, and the hand does more
void check(const SessionConfig& options, const Protocol& protocol);

/// As complete(), for options from a log: the parameters stay those that were read then.
void check(const SessionConfig& options);

/// The simulator that in_force() picks for the protocol; the log then has the name of its pick.
inline constexpr std::string_view automatic = "auto";

/// What models all a person may do, at the lowest rate that stays within the tolerance with every
/// technique of the protocol, at least the display's; the protocol's own rate is not asked.
SimulatorPick resolve_auto(const Protocol& protocol);

/// Whether the two names in the table of simulators mean the same one.
/// @throws Error (usage) for an unknown name
bool is_same_simulator(const std::string& a, const std::string& b);

std::unique_ptr<Responder> make_responder(const SessionConfig& options, std::uint64_t seed);

/// The setup with what the protocol and the program add to it: the simulator (what `auto` is for
/// this protocol, if that is asked for), rates, hashes, language, build. A simulator with its rate
/// stays, whatever the error table of `auto` says now.
SessionConfig in_force(SessionConfig setup, const Protocol& protocol);

/// The setup with what its simulated participant is drawn as from the session's seed.
SessionConfig with_participant(SessionConfig setup, std::uint64_t seed);

/// The setup with the display that the view is on; without one, where nothing is shown.
/// @throws Error (invalid_file) when its file is of a display of another size in pixels
SessionConfig with_display(SessionConfig setup, const std::optional<DisplayFacts>& display);

/// The number of the display that a setup names, "1" or "1 NAME"; 0 where it names none.
/// @throws Error (usage) when it is no number
int display_number(const SessionConfig& setup);

/// The setup's window is not full screen.
bool is_windowed(const SessionConfig& setup);

/// The setup with the rate of its pictures' source, where that is not about the display's.
SessionConfig with_source_rate(SessionConfig setup, std::optional<double> rate_hz);

/// The protocol with the setup's simulator, rate and input in place of its own.
std::shared_ptr<const Protocol> protocol_for(Protocol protocol, const SessionConfig& setup);

/// Each column that differs, for people: name, before, after.
struct SetupChange {
  std::string column, from, to;
};
std::vector<SetupChange> changes_between(const SessionConfig& from, const SessionConfig& to);

}  // namespace heft
