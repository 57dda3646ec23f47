// Parameters of simulated participants. The table in ResponderParameters.cpp gives each its name,
// unit, default, allowed range, spread between participants and reason. The values are provisional:
// based on general knowledge of hands and eyes, not fitted to an experiment.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/Error.h"
#include "base/Names.h"
#include "responders/Responder.h"

namespace heft {

/// The visible cue to a cube's heaviness.
/// offset: distance of the clone from the effector while it touches the cube.
/// cube_motion: how much less the cube has moved than the hand since they touched.
/// cd_ratio: the share of the hand's movement that the cube lacks, as -ln(cube's / hand's) times a
///   usual stroke of 90 mm (control/display ratio; Samad et al. 2019).
/// moved: nothing if the cube was seen to move, else a usual stroke.
/// sliding_offset: the offset's mean while the cube slides, or its largest if it never does. Starts
/// and ends of strokes, where the cube's inertia counts, cancel.
enum class Cue { offset, cube_motion, cd_ratio, moved, sliding_offset };
template <>
struct EnumNames<Cue> {
  static constexpr std::array<std::string_view, 5> names{"offset", "cube_motion", "cd_ratio",
                                                         "moved", "sliding_offset"};
};

/// The part of a responder that has the parameter.
enum class ParameterPart { everyone, hand, perception, decision, coin, anchor, weber };

inline constexpr std::array simulated_parts{ParameterPart::everyone, ParameterPart::hand,
                                            ParameterPart::perception, ParameterPart::decision};
inline constexpr std::array criterion_only_parts{ParameterPart::everyone, ParameterPart::decision};
inline constexpr std::array coin_parts{ParameterPart::coin};
inline constexpr std::array ideal_parts{ParameterPart::everyone, ParameterPart::hand};
inline constexpr std::array start_anchored_parts{ParameterPart::everyone, ParameterPart::coin,
                                                 ParameterPart::anchor};
inline constexpr std::array weber_parts{ParameterPart::everyone, ParameterPart::weber};

/// One participant's values. Meanings, units and defaults: see the table.
struct ResponderParameters {
  double participant_spread = 0, moved_share = 0;

  double strokes_per_cube = 0;
  double stroke_length_m = 0, stroke_peak_speed_m_s = 0, stroke_variation = 0;
  double travel_peak_speed_m_s = 0;
  double hold_s = 0, pause_s = 0;
  double lateral_error_m = 0, yaw_error_rad = 0;
  double hover_m = 0, reach_m = 0;
  double stop_gap_m = 0, stop_motion_m = 0;

  Cue cue = Cue::offset;
  double just_visible_mm = 0, localization_noise_mm = 0, length_noise = 0;
  double integration_s = 0, memory_noise = 0;
  double haptic_mm = 0, haptic_noise_mm = 0;

  double judgment_noise_mm = 0, criterion_mm = 0, criterion_fraction = 0;
  double guess_probability = 0, lapse_rate = 0, correction_probability = 0;
  double think_s = 0, tap_interval_s = 0;
  double criterion_drift_mm = 0, criterion_persistence = 0, repetition_mm = 0;

  double p = 0, concentration = 0;
  double anchor_fraction = 0, anchor_noise = 0;
  double weber_fraction = 0, weber_noise = 0;
};

/// A row of the table. Of a mechanism that is off by default the value is 0.
struct ParameterRow {
  ParameterPart part;
  std::string_view name, unit;
  double value, least, most;
  double spread;  ///< SD between participants of the value's logarithm
  double ResponderParameters::*member;
  std::string_view reason;
};

/// All numeric parameters; the cue, a name, is not in the table.
std::span<const ParameterRow> parameter_rows();

/// @return null if these parts have no such parameter
const ParameterRow* find_row(std::string_view name, std::span<const ParameterPart> parts);

/// Ending of the name of a parameter's spread in a model's file.
inline constexpr std::string_view spread_ending = ".spread";

/// The name of a parameter: files may write NAME.median instead of NAME.
std::string_view without_median(std::string_view name);

/// Defaults of all parts: an average participant.
ResponderParameters default_parameters();

/// How parameters differ between participants. All are at least 0 and log-normal: a participant's
/// value is the median times exp(spread * z), with z standard normal over participants.
class Variation {
 public:
  Variation();  ///< the table's spreads, no correlations

  /// Takes "NAME.spread" (SD of the logarithm, 0 to 3) or "correlation.NAME.NAME" (of the
  /// logarithms, between -1 and 1).
  /// @return the mistake, or an empty string
  std::string set(const Parameter& parameter, std::span<const ParameterPart> parts);
  static bool takes(std::string_view name);

  /// @return the mistake if no distribution has all these correlations
  std::optional<Mistake> factorize();

  /// One stream per parameter, keyed by the seed: a new row of the table changes no other value.
  /// Correlated draws are the Cholesky factor times the independent ones. Values are clamped to
  /// their ranges.
  void vary(std::uint64_t seed, ResponderParameters& parameters) const;

 private:
  std::vector<double> spread_;               ///< by row
  std::vector<std::vector<double>> matrix_;  ///< correlations; after factorize() their factor
  SourcePlace last_correlation_;
};

/// Defaults, overridden by the options' parameters, then varied between participants.
/// A parameter is given as NAME = MEDIAN or NAME = {median = , spread = }.
/// @param parts whose parameters may be given
/// @throws InvalidFile naming each unknown or invalid parameter at its place
ResponderParameters participant_parameters(const ResponderOptions& options,
                                           std::span<const ParameterPart> parts);

/// The drawn parameters of those parts, by name; of mechanisms only those that the file gives.
/// @throws InvalidFile as participant_parameters
std::map<std::string, double> drawn_values(const ResponderOptions& options,
                                           std::span<const ParameterPart> parts);

/// One line per parameter: name, default, unit, range, spread, reason.
std::string describe_parameters(std::span<const ParameterPart> parts);

}  // namespace heft
