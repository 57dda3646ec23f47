// The one way from options to what runs: resolve() reads files, applies defaults, checks what may
// meet, picks the simulator and draws the participant. Sessions start from its result alone, which
// holds all of it, so that resume and replay need nothing but the log.
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
#include "tracking/pose/MarkerBody.h"

namespace heft {

struct SimulatorPick;
struct TrackerEntry;
struct ViewEntry;

/// What the caller chose. The rest has defaults, or stays as the logged session has it.
struct SessionOptions {
  std::optional<WhoAnswers> responder;     ///< else a person
  std::optional<Plug> tracker;             ///< else camera:0 for a person, hand for a model
  std::optional<Plug> view;                ///< else window for a person, headless for a model
  std::optional<std::string> simulator;    ///< else the protocol's
  std::optional<std::string> camera_file;  ///< else default_camera_file, or a made-up camera's
  std::optional<std::string> board_file, effector_file;  ///< else the shipped ones
  std::optional<std::string> language;                   ///< or FILE.toml; else the protocol's
  std::optional<NamedDisplay> display;                   ///< else the first
  std::optional<std::string> display_file;  ///< else default_display_file, if it is there
  bool windowed = false;
  std::vector<ProtocolSetting> settings = {};  ///< that the protocol was read with; to be logged
  std::optional<Side> controls, hand;          ///< controls: else right
  std::optional<TakesKeys> keys;
  std::string record_camera = {}, backup = {}, protocol_file = {};
};

/// The calibration that is taken where no other is named, if the working folder has it.
inline constexpr const char* default_camera_file = "camera.yaml";

/// The measured display that is taken where no other is named, likewise.
inline constexpr const char* default_display_file = "display.toml";

/// A model with its file read and checked: what responders are made from.
struct ResolvedModel {
  Plug named;  ///< as it is logged, its path absolute
  const ResponderEntry* entry = nullptr;
  ResponderOptions options;  ///< but for the seed

  std::unique_ptr<Responder> responder(std::uint64_t session_seed) const;
  /// What it is drawn as from a session's seed, by name.
  std::map<std::string, double> drawn(std::uint64_t session_seed) const;
};

/// Reads and checks the model's file.
/// @throws as resolve(); InvalidFile where its parameters have mistakes
ResolvedModel resolve_model(Plug given);

/// The same of a log, which keeps the contents of the file.
ResolvedModel logged_model(Plug logged);

/// All that a session runs with; only resolve() makes one.
class ResolvedConfig {
 public:
  struct Parts {
    SessionConfig config;                      ///< as it is logged, without what only devices know
    std::shared_ptr<const Protocol> protocol;  ///< with the configuration's simulator
    std::uint64_t seed = 0;                    ///< of the session
    const TrackerEntry* tracker = nullptr;
    const ViewEntry* view = nullptr;
    ResolvedModel model;  ///< of a person only the hand, where no camera films theirs
    bool on_wall_clock = false;
    Apparatus apparatus;  ///< empty without a camera
    ScreenTexts texts;    ///< without pages where no one reads them
    /// Where this run writes its video and the camera's pictures: of a session that is resumed,
    /// beside those from before.
    std::string film, pictures;
  };

  const Parts* operator->() const { return &parts_; }

  /// The same for another session: its participant is drawn again.
  ResolvedConfig with_seed(std::uint64_t seed) const;

 private:
  explicit ResolvedConfig(Parts parts);
  friend class Resolver;

  Parts parts_;
};

/// @param protocol read with the options' settings
/// @throws Error (usage) for unknown names and combinations that can't work; Error and InvalidFile
///   for files that can't be read or hold mistakes; Error (device_missing) where a live camera
///   without a calibration is not there
ResolvedConfig resolve(const SessionOptions& options, const Protocol& protocol, std::uint64_t seed);

/// A logged configuration with these options instead. Of its files only those are read that are
/// given or were not needed before; a simulator with its rate stays, whatever the error table of
/// `auto` says now.
ResolvedConfig resolve(const SessionOptions& options, const SessionConfig& logged,
                       const Protocol& protocol, std::uint64_t seed);

/// What only opened devices know.
struct DeviceFacts {
  std::optional<DisplayFacts> display;   ///< that the view is on; none: nothing is shown
  std::optional<double> source_rate_hz;  ///< pictures a second; none: as many as are shown
};

/// The configuration as it is logged. A source's rate is left out where it is the display's.
/// @throws Error (invalid_file) when the measured display has another size in pixels
SessionConfig with_devices(SessionConfig config, const DeviceFacts& devices);

/// Whether a session keeps the time of day: with a live camera, a screen or a person. Otherwise it
/// runs as fast as it can, and no result depends on how fast that is.
bool runs_on_wall_clock(bool person, const TrackerEntry& tracker, const ViewEntry& view);

/// The name of the simulator that is picked for the protocol; the log has the name of the pick.
inline constexpr std::string_view automatic = "auto";

/// What models all that a person may do, at the lowest rate that stays within the tolerance with
/// every technique of the protocol, at least the display's; the protocol's own rate is not asked.
SimulatorPick resolve_auto(const Protocol& protocol);

/// The named simulator at the protocol's rate; of `auto` the pick.
SimulatorPick simulator_for(const std::string& name, const Protocol& protocol);

/// The protocol with a logged configuration's simulator, rate, input and the words of its
/// questions.
std::shared_ptr<const Protocol> protocol_for(Protocol protocol, const SessionConfig& config);

/// Each column that differs, for people: name, before, after.
struct ConfigChange {
  std::string column, from, to;
};
std::vector<ConfigChange> changes_between(const SessionConfig& from, const SessionConfig& to);

/// The path itself where nothing is there, else the first free one of "film-2.avi", "film-3.avi"...
/// A video can't be added to, and recordings must not be mixed.
std::string next_part(const std::string& path);

/// @throws Error (usage) where a person can't see or touch the view, or drags where there is no
///   person or no window
void require_compatible_plugs(const ResolvedConfig::Parts& parts);

/// Whether the participant can give the answers that the protocol takes, and the simulator models
/// what their hand does.
/// @throws Error (usage) where answers need contact with every cube and a model's hand touches
///   none; where the simulator knows straight strokes alone and the hand does more
void require_answerable(const ResolvedConfig::Parts& parts, const Protocol& protocol);

/// @throws Error (invalid_file) where a block asks a question that the session's texts do not have
void require_questions(const Protocol& protocol);

struct Protocol;

/// A file of protocols/texts/ by its language, or any other by its path.
/// @throws Error (usage) naming the languages that there are
std::string texts_file(const std::string& language);

/// Puts the protocol's questionnaires below the texts, from NAME.LANGUAGE.toml beside the protocol
/// or in protocols/questionnaires. Those that the texts have already stay as they are.
/// @return the file that each questionnaire of these texts came from, by its name
/// @throws Error naming what is missing, or two files that have one of a name; InvalidFile where a
///   file has mistakes
std::map<std::string, std::string> add_questionnaires(ConfigFile& texts,
                                                      const std::string& protocol_file,
                                                      const Protocol& protocol);

}  // namespace heft
