// An experiment as data: the content of a protocol file, typed and checked. protocols/paper.toml
// documents every key with its meaning, unit and default.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/SimulationChoices.h"
#include "experiment/SessionConfig.h"
#include "experiment/Stage.h"
#include "physics/scene/Scene.h"
#include "protocol/study/AnalysisPlan.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft {

/// Treatment of a cube that leaves the area or falls: it is reset once untouched; all cubes are
/// reset together when the hand is clear of them (so that no jump reveals the light one); or it
/// stays.
enum class OutOfArea { give_back, together, stay };
template <>
struct EnumNames<OutOfArea> {
  static constexpr std::array<std::string_view, 3> names{"return", "together", "stay"};
};

/// Whether `friction` is the coefficient between two surfaces, or each body's, for engines that
/// multiply them (0.8 per body is 0.64 between two).
enum class FrictionIs { between_surfaces, per_body };
template <>
struct EnumNames<FrictionIs> {
  static constexpr std::array<std::string_view, 2> names{"between_surfaces", "per_body"};
};

/// Limits of ScreensChosen::text_size.
inline constexpr double least_text_size = 0.75, most_text_size = 2;

/// Settings of a participant's screens.
struct ScreensChosen {
  std::string language =
      "en";  ///< of protocols/texts/, unless the session's options choose another
  bool consent = false;
  bool about_you = false;
  bool how_decided = false;
  bool crop = true;      ///< the scene is cropped to the reach of cubes and effector
  double text_size = 1;  ///< relative to the usual size
  bool patch = false;    ///< for a photodiode: changes its shade with each frame
  /// Names of questionnaires by the block that they follow; "" for the end.
  std::map<std::string, std::vector<std::string>> questionnaires = {};
};

struct SimulatorChoice {
  std::string name = "boxes";
  double rate_hz = 240;
  DriveInput input;
};

struct Layout {
  double cube_size_m = 0.035;
  double gap_m = 0.045;                ///< between neighboring cubes' faces
  double row_y_m = 0;                  ///< of the cubes' centers
  double start_distance_m = 0.06;      ///< from the cubes' near faces to the resting effector's tip
  Eigen::Vector2d area_m{0.40, 0.30};  ///< width and depth, centered on the origin
  /// The default is the behavior before this key existed, for replaying older logs.
  OutOfArea out_of_area = OutOfArea::give_back;
  double clear_m = 0.02;  ///< cubes appear once the effector is this far from every slot
};

struct Protocol : SessionPlan {
  std::string name;
  std::string text;    ///< the file's contents; kept in the log
  std::string sha256;  ///< of text
  std::string title;
  double display_rate_hz = 15;
  double void_after_s = 5;  ///< a camera or board lost for longer voids the trial
  /// A contact that a gap between pictures interrupts ends before it. Not a key of files; false for
  /// logs before version 8, where it ended after the gap.
  bool gaps_end_contacts = true;
  Onset onset;
  Eigen::Vector3d effector_size_m{0.09, 0.04, 0.04};
  Coupling coupling;                  ///< of C2, and defaults of declared techniques
  std::vector<Technique> techniques;  ///< declared ones; C1 and C2 need no declaration
  double friction = 0.8;
  FrictionIs friction_is = FrictionIs::between_surfaces;
  double contact_compliance_m_per_n = 0;  ///< see Scene
  double gravity_m_s2 = 9.81;
  SimulatorChoice simulator;
  Layout layout;
  ScreensChosen screens;
  AnalysisPlan analysis;
  ExclusionRules exclusion;
};

/// The questionnaires after blocks, at the end, and with questions in trials.
std::set<std::string> questionnaires_of(const Protocol& protocol);

/// Centers of n cubes in a row along x, leftmost first.
std::vector<Eigen::Vector3d> slot_positions(const Layout& layout, int n);

/// The visible geometry of a trial with n cubes.
Stage stage_of(const Protocol& protocol, int n);

/// The physics of a trial: the name of its technique; masses in grams and friction on the table,
/// leftmost first. @param table_friction empty: the protocol's friction
Scene scene_of(const Protocol& protocol, const std::string& technique,
               const std::vector<double>& masses_g, const std::vector<double>& table_friction = {});

/// @param text contents of the file  @param file its name, for messages
/// @param settings changes to it
/// @throws InvalidFile with every mistake at its line and column; Error for an unusable setting
Protocol parse_protocol(const std::string& text, const std::string& file,
                        std::span<const ProtocolSetting> settings = {});

/// @throws Error if the file cannot be read, InvalidFile as parse_protocol
Protocol load_protocol(const std::string& path, std::span<const ProtocolSetting> settings = {});

using TrialsByTask = std::map<std::string, double>;

/// With catch trials. A staircase whose length depends on the answers is simulated (up to 1000
/// trials) with 200 observers. Their thresholds are evenly spaced between a quarter of the largest
/// level planned at the reference (an adaptive staircase's start) and that level; an observer
/// perceives a difference of 1.4 times its threshold in 84 % of trials. Equal protocols give equal
/// results.
TrialsByTask expected_trials(const Protocol& protocol);

double total_of(const TrialsByTask& trials);

/// Whether the number of trials in any block depends on the answers.
bool depends_on_answers(const Protocol& protocol);

/// Assumed duration of a trial of a task: mean over the protocol's blocks.
double assumed_trial_s(const Protocol& protocol, std::string_view task);
/// Duration of these trials by assumed_trial_s(), with demonstrations, minimum breaks and
/// gaps between trials.
double expected_minutes(const Protocol& protocol, const TrialsByTask& trials);

}  // namespace heft
