// From options to a complete configuration: resolve() reads files, applies defaults, checks
// combinations, chooses the simulator and draws the simulated participant. Sessions start from its
// result alone, so that resume and replay need only the log.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/ScreenTexts.h"
#include "experiment/SessionConfig.h"
#include "experiment/Stage.h"
#include "protocol/Protocol.h"
#include "responders/Responder.h"
#include "tracking/detection/MarkerBody.h"

namespace heft {

struct SimulatorPick;
struct TrackerEntry;
struct ViewEntry;

/// The caller's choices. Others get defaults, or the logged session's values.
struct SessionOptions {
  std::optional<ResponderChoice> responder;  ///< else a person
  std::optional<Plug> tracker;               ///< else camera:0 for a person, hand for a model
  std::optional<Plug> view;                  ///< else window for a person, headless for a model
  std::optional<std::string> simulator;      ///< else the protocol's
  std::optional<std::string> camera_file;  ///< else default_camera_file, or the synthetic camera's
  std::optional<std::string> board_file, effector_file;  ///< else the installed ones
  std::optional<std::string> language;                   ///< or FILE.toml; else the protocol's
  std::optional<NamedDisplay> display;                   ///< else the first
  std::optional<std::string> display_file;  ///< else default_display_file, if it exists
  bool windowed = false;
  std::vector<ProtocolSetting> settings = {};  ///< already applied to the protocol; logged
  std::optional<Side> controls, hand;          ///< controls: else right
  std::optional<TakesKeys> keys;
  std::string record_camera = {}, backup = {}, protocol_file = {}, run_by = {};
};

/// Calibration file used by default, if the working directory has it.
inline constexpr const char* default_camera_file = "camera.yaml";

/// File of the measured display used by default, if the working directory has it.
inline constexpr const char* default_display_file = "display.toml";

/// A model whose file was read and checked: creates responders.
struct ResolvedModel {
  Plug named;  ///< as logged, with an absolute path
  const ResponderEntry* entry = nullptr;
  ResponderOptions options;  ///< without the seed

  std::unique_ptr<Responder> responder(std::uint64_t session_seed) const;
  /// The parameters drawn from a session's seed, by name.
  std::map<std::string, double> drawn(std::uint64_t session_seed) const;
};

/// Reads and checks the model's file.
/// @throws as resolve(); InvalidFile if its parameters have mistakes
ResolvedModel resolve_model(Plug given);

/// The same from a log, which holds the contents of the file.
ResolvedModel logged_model(Plug logged);

/// A session's complete configuration; made by resolve() only.
class ResolvedConfig {
 public:
  struct Parts {
    SessionConfig config;                      ///< as logged, without the devices' facts
    std::shared_ptr<const Protocol> protocol;  ///< with the configuration's simulator
    std::uint64_t seed = 0;                    ///< of the session
    const TrackerEntry* tracker = nullptr;
    const ViewEntry* view = nullptr;
    ResolvedModel model;  ///< for a person only the hand, used if no camera films theirs
    bool on_wall_clock = false;
    Apparatus apparatus;  ///< empty without a camera
    ScreenTexts texts;    ///< without pages if there is no reader
    /// Files for this run's video and camera pictures; a resumed session writes them beside the
    /// earlier ones.
    std::string film, pictures;
  };

  const Parts* operator->() const { return &parts_; }

  /// The same for another session, with another simulated participant.
  ResolvedConfig with_seed(std::uint64_t seed) const;

  /// The configuration of sessions of a simulation: with this seed and the number of participants.
  ResolvedConfig of_simulation(int participants) const;

 private:
  explicit ResolvedConfig(Parts parts);
  friend class Resolver;

  Parts parts_;
};

/// @param protocol read with the options' settings
/// @throws Error (usage) for unknown names and impossible combinations; Error and InvalidFile for
///   files that are unreadable or have mistakes; Error (device_missing) if a live camera without a
///   calibration is missing
ResolvedConfig resolve(const SessionOptions& options, const Protocol& protocol, std::uint64_t seed);

/// A logged configuration changed by these options. Only files that are given, or were not needed
/// before, are read. A logged simulator keeps its rate, even if the error table of `auto` has
/// changed.
ResolvedConfig resolve(const SessionOptions& options, const SessionConfig& logged,
                       const Protocol& protocol, std::uint64_t seed);

/// Facts known only from opened devices.
struct DeviceFacts {
  std::optional<DisplayFacts> display;   ///< of the view; none: headless
  std::optional<double> source_rate_hz;  ///< none: the display's rate
};

/// The configuration as logged. A source's rate is omitted if it equals the display's.
/// @throws Error (invalid_file) if the measured display has another size in pixels
SessionConfig with_devices(SessionConfig config, const DeviceFacts& devices);

/// Whether a session runs in real time: with a live camera, a screen or a person. Otherwise it runs
/// as fast as possible, with the same results.
bool runs_on_wall_clock(bool person, const TrackerEntry& tracker, const ViewEntry& view);

/// Name of the automatic choice of a simulator; the log has the name of the chosen one.
inline constexpr std::string_view automatic = "auto";

/// The simulator of a tracker without pictures, whose strokes are straight.
inline constexpr std::string_view surrogate_simulator = "push";

/// The simulator that models all movements of a person, at a rate that suffices for the fastest
/// spring of the protocol's techniques, at least the display's. Ignores the protocol's rate.
SimulatorPick resolve_auto(const Protocol& protocol);

/// The named simulator at the protocol's rate; for `auto` the chosen one.
SimulatorPick simulator_for(const std::string& name, const Protocol& protocol);

/// The protocol with a logged configuration's simulator, rate, input mode and questions.
std::shared_ptr<const Protocol> protocol_for(Protocol protocol, const SessionConfig& config);

/// A column that differs, for messages: name, before, after.
struct ConfigChange {
  std::string column, from, to;
};
std::vector<ConfigChange> changes_between(const SessionConfig& from, const SessionConfig& to);

/// The path itself if it is free, else the first free one of "film-2.avi", "film-3.avi"... Videos
/// cannot be appended to, and recordings must not be mixed.
std::string next_part(const std::string& path);

/// @throws Error (usage) if a participant cannot see or touch the view, or the tracker drags the
///   effector without a participant or window
void require_compatible_plugs(const ResolvedConfig::Parts& parts);

/// Checks that the participant can give the protocol's answers, and that the simulator models the
/// hand's movements.
/// @throws Error (usage) if answers need contact with every cube but the model's hand touches
///   none; if the simulator models straight pushes only but the hand moves freely
void require_answerable(const ResolvedConfig::Parts& parts, const Protocol& protocol);

/// @throws Error (invalid_file) if a block asks a question that the session's texts lack
void require_questions(const Protocol& protocol);

struct Protocol;

/// A file of protocols/texts/ by its language, or any other file by its path.
/// @throws Error (usage) listing the existing languages
std::string texts_file(const std::string& language);

/// Adds the protocol's questionnaires to the texts, from NAME.LANGUAGE.toml beside the protocol or
/// in protocols/questionnaires. Questionnaires that the texts already have are kept.
/// @return the file of each questionnaire, by name
/// @throws Error naming what is missing, or two files with one questionnaire; InvalidFile if a file
///   has mistakes
std::map<std::string, std::string> add_questionnaires(ConfigFile& texts,
                                                      const std::string& protocol_file,
                                                      const Protocol& protocol);

}  // namespace heft
