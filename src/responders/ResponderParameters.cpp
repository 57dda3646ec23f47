#include "responders/ResponderParameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <vector>

#include "base/Random.h"

namespace heft {

namespace {
using P = ResponderParameters;
using enum ParameterPart;

// part, name, unit, default, least, most, spread between participants, member, reason
constexpr std::array rows{
    ParameterRow{everyone, "participant_spread", "1", 1, 0, 3, 0, &P::participant_spread,
                 "multiplies every spread between participants; 0 makes them all alike"},
    ParameterRow{perception, "moved_share", "1", 0, 0, 1, 0, &P::moved_share,
                 "share of the participants who judge by whether a cube moved; 0: none"},
    // The hand.
    ParameterRow{hand, "strokes_per_cube", "1", 2.5, 1, 10, 0.2, &P::strokes_per_cube,
                 "one push is checked by another, seldom by more when first impressions count"},
    ParameterRow{hand, "stroke_length_m", "m", 0.09, 0.03, 0.2, 0.12, &P::stroke_length_m,
                 "a push with the forearm resting on the table spans about a hand's width"},
    ParameterRow{hand, "stroke_peak_speed_m_s", "m/s", 0.27, 0.05, 1, 0.2,
                 &P::stroke_peak_speed_m_s,
                 "unhurried reaches of about 10 cm take some 0.6 s with a bell-shaped speed"},
    ParameterRow{hand, "stroke_variation", "1", 0.1, 0, 0.3, 0, &P::stroke_variation,
                 "unguided repeated movements vary by about a tenth in extent and speed"},
    ParameterRow{hand, "travel_peak_speed_m_s", "m/s", 0.5, 0.1, 1.5, 0.2,
                 &P::travel_peak_speed_m_s, "hands travel faster through free air than they push"},
    ParameterRow{hand, "hold_s", "s", 0.25, 0.05, 2, 0.2, &P::hold_s,
                 "a fixation long enough to take in the end of a push"},
    ParameterRow{hand, "pause_s", "s", 0.2, 0, 2, 0.2, &P::pause_s,
                 "a visual reaction time between one movement and the next"},
    ParameterRow{hand, "lateral_error_m", "m", 0.003, 0, 0.01, 0.2, &P::lateral_error_m,
                 "endpoint scatter of aimed movements watched through a screen: a few millimeters"},
    ParameterRow{hand, "yaw_error_rad", "rad", 0.02, 0, 0.1, 0.2, &P::yaw_error_rad,
                 "a held stick is kept parallel to a seen edge to about one degree"},
    ParameterRow{hand, "hover_m", "m", 0.005, 0.001, 0.02, 0, &P::hover_m,
                 "the effector glides just above the table, so that it does not scrape"},
    ParameterRow{hand, "reach_m", "m", 0.3, 0.05, 0.6, 0, &P::reach_m,
                 "behind a tablet the tip gets about a forearm's length past the row's near faces"},
    ParameterRow{hand, "stop_gap_m", "m", 0, 0, 0.2, 0, &P::stop_gap_m,
                 "a push ends where the clone is seen this far behind (exploration adapts to what "
                 "it finds: Lederman and Klatzky 1987); 0: never"},
    ParameterRow{hand, "stop_motion_m", "m", 0, 0, 0.2, 0, &P::stop_motion_m,
                 "a push ends where the cube is seen to have moved this far; 0: never"},
    // The eye and its memory.
    ParameterRow{perception, "just_visible_mm", "mm", 2, 0, 20, 0.3, &P::just_visible_mm,
                 "a few pixels of a camera that films 40 cm: less looks like one contour"},
    ParameterRow{perception, "localization_noise_mm", "mm", 1, 0, 20, 0.3,
                 &P::localization_noise_mm,
                 "placing an edge in one small moving picture is good to about a pixel or two"},
    ParameterRow{perception, "length_noise", "1", 0.03, 0, 0.5, 0.3, &P::length_noise,
                 "Weber fraction of seen lengths: a few percent"},
    ParameterRow{perception, "integration_s", "s", 0.1, 0, 1, 0, &P::integration_s,
                 "vision sums over about a tenth of a second, here as a first-order lag"},
    ParameterRow{perception, "memory_noise", "1", 0.08, 0, 1, 0.3, &P::memory_noise,
                 "a length kept in mind over seconds and other lengths blurs by 5 to 10 %"},
    ParameterRow{perception, "haptic_noise_mm", "mm", 0, 0, 200, 0, &P::haptic_noise_mm,
                 "noise of the held effector's weight, which is weighed against the seen cue by "
                 "their variances (Ernst and Banks 2002); 0: the weight is ignored"},
    ParameterRow{perception, "haptic_mm", "mm", 0, 0, 200, 0, &P::haptic_mm,
                 "the cue that the held effector's weight suggests for any cube"},
    // The decision and the finger.
    ParameterRow{decision, "judgment_noise_mm", "mm", 1.5, 0, 50, 0.3, &P::judgment_noise_mm,
                 "comparing adds noise of the order of what the eye adds, even to nothing seen"},
    ParameterRow{decision, "criterion_mm", "mm", 5, 0, 100, 0.4, &P::criterion_mm,
                 "a difference counts when it is over twice the noise of two small percepts"},
    ParameterRow{decision, "criterion_fraction", "1", 0.1, 0, 1, 0.4, &P::criterion_fraction,
                 "and over about what equal cubes differ by from stroke to stroke, for large ones"},
    ParameterRow{
        decision, "guess_probability", "1", 0.5, 0, 1, 0.4, &P::guess_probability,
        "without a difference some order the cubes anyway; nothing speaks for more or less"},
    ParameterRow{decision, "lapse_rate", "1", 0.02, 0, 1, 0.5, &P::lapse_rate,
                 "one or two answers in a hundred have nothing to do with what was seen"},
    ParameterRow{decision, "correction_probability", "1", 0.1, 0, 1, 0.3,
                 &P::correction_probability, "now and then a first label is put wrong and moved"},
    ParameterRow{decision, "think_s", "s", 1, 0.3, 10, 0.3, &P::think_s,
                 "deciding, and taking a hand from the effector to the screen"},
    ParameterRow{decision, "tap_interval_s", "s", 0.7, 0.4, 5, 0.2, &P::tap_interval_s,
                 "finding and tapping the next of a few large buttons"},
    ParameterRow{decision, "criterion_drift_mm", "mm", 0, 0, 20, 0, &P::criterion_drift_mm,
                 "standard deviation of the criterion's change from trial to trial; 0: none"},
    ParameterRow{decision, "criterion_persistence", "1", 0, 0, 0.999, 0, &P::criterion_persistence,
                 "share of a change of the criterion that is left one trial later"},
    ParameterRow{
        decision, "repetition_mm", "mm", 0, 0, 50, 0, &P::repetition_mm,
        "the criterion is this much lower after the answer \"different\", and higher after "
        "\"same\" (answers depend on the last one: Fruend et al. 2011); 0: none"},
    // The coin.
    ParameterRow{coin, "p", "1", 0.5, 0, 1, 0, &P::p, "probability of answering \"different\""},
    ParameterRow{coin, "concentration", "1", 0, 0, 1000, 0, &P::concentration,
                 "p differs between participants as Beta(p c, (1 - p) c) for concentration c; 0: "
                 "it does not"},
    // Models that know the plan.
    ParameterRow{anchor, "anchor_fraction", "1", 0.5, 0, 3, 0.4, &P::anchor_fraction,
                 "\"same\" once the level has come down to this fraction of where it started: a "
                 "judgment anchored on the first value (Tversky and Kahneman 1974)"},
    ParameterRow{anchor, "anchor_noise", "1", 0.2, 0, 3, 0.3, &P::anchor_noise,
                 "standard deviation from trial to trial, as a fraction of the start"},
    ParameterRow{
        weber, "weber_fraction", "1", 0.1, 0, 20, 0.4, &P::weber_fraction,
        "\"different\" where the heaviest mass exceeds the lightest by this fraction of it; "
        "lifted weights: 0.02 to 0.1 (Ross and Murray 1996)"},
    ParameterRow{weber, "weber_noise", "1", 0.1, 0, 3, 0.3, &P::weber_noise,
                 "standard deviation of the logarithm of each judged mass"},
};

constexpr std::string_view cue_reason =
    "what heaviness is seen by: the clone's distance from the effector, the cube's missing motion, "
    "the share of the hand's motion that it lacks, whether it moved, or the distance while it "
    "slides";

bool has(std::span<const ParameterPart> parts, ParameterPart part) {
  return std::ranges::find(parts, part) != parts.end();
}

std::vector<std::string_view> names(std::span<const ParameterPart> parts) {
  std::vector<std::string_view> found;
  if (has(parts, perception)) found.push_back("cue");
  for (const ParameterRow& row : rows)
    if (has(parts, row.part)) found.push_back(row.name);
  return found;
}

std::string unknown(const std::string& name, std::span<const ParameterPart> parts) {
  const auto known = names(parts);
  if (const auto nearest = nearest_name(name, known))
    return fmt::format("unknown parameter \"{}\", did you mean \"{}\"?", name, *nearest);
  return fmt::format("unknown parameter \"{}\", expected {}", name, quoted_list(known));
}

// Each of these returns the mistake, or an empty string.
std::string set_cue(const Parameter& parameter, P& parameters) {
  const auto* text = std::get_if<std::string>(&parameter.value);
  const auto cue = text ? named<Cue>(*text) : std::nullopt;
  if (!cue) return fmt::format("cue must be {}", quoted_list(EnumNames<Cue>::names));
  parameters.cue = *cue;
  return {};
}

std::string set_number(const Parameter& parameter, const ParameterRow& row, P& parameters) {
  const auto* value = std::get_if<double>(&parameter.value);
  if (!value) return fmt::format("{} must be a number ({})", row.name, row.unit);
  if (!(*value >= row.least && *value <= row.most))
    return fmt::format("{} is {}, expected {} to {} ({})", row.name, *value, row.least, row.most,
                       row.unit);
  parameters.*row.member = *value;
  return {};
}

std::string set(const Parameter& parameter, std::span<const ParameterPart> parts, P& parameters) {
  const std::string_view name = without_median(parameter.name);
  if (name == "cue" && has(parts, perception)) return set_cue(parameter, parameters);
  const ParameterRow* row = find_row(name, parts);
  return row ? set_number(parameter, *row, parameters) : unknown(std::string(name), parts);
}

// Draws the cue and the p of one participant.
void draw_kind(std::uint64_t seed, P& parameters) {
  if (parameters.moved_share > 0) {
    const bool is_one = RandomStream(seed, "participant's cue").coin(parameters.moved_share);
    if (is_one) parameters.cue = Cue::moved;
    parameters.moved_share = is_one ? 1 : 0;
  }
  if (parameters.concentration > 0) {
    const double yes = parameters.p * parameters.concentration;
    const double no = parameters.concentration - yes;
    if (yes > 0 && no > 0)
      parameters.p =
          boost::math::ibeta_inv(yes, no, RandomStream(seed, "participant's p").uniform());
    parameters.concentration = 0;
  }
}

bool is_given(const ResponderOptions& options, std::string_view name) {
  return std::ranges::any_of(
      options.parameters, [&](const Parameter& one) { return without_median(one.name) == name; });
}

}  // namespace

std::span<const ParameterRow> parameter_rows() {
  return rows;
}

const ParameterRow* find_row(std::string_view name, std::span<const ParameterPart> parts) {
  const auto row = std::ranges::find(rows, name, &ParameterRow::name);
  return row != rows.end() && has(parts, row->part) ? &*row : nullptr;
}

std::string_view without_median(std::string_view name) {
  constexpr std::string_view ending = ".median";
  if (name.ends_with(ending)) name.remove_suffix(ending.size());
  return name;
}

ResponderParameters default_parameters() {
  ResponderParameters parameters;
  for (const ParameterRow& row : rows) parameters.*row.member = row.value;
  return parameters;
}

ResponderParameters participant_parameters(const ResponderOptions& options,
                                           std::span<const ParameterPart> parts) {
  ResponderParameters parameters = default_parameters();
  Variation variation;
  std::vector<Mistake> mistakes;
  for (const Parameter& parameter : options.parameters) {
    const std::string wrong = Variation::takes(parameter.name) ? variation.set(parameter, parts)
                                                               : set(parameter, parts, parameters);
    if (!wrong.empty()) mistakes.push_back({parameter.place, wrong});
  }
  if (const auto impossible = variation.factorize()) mistakes.push_back(*impossible);
  if (!mistakes.empty()) throw InvalidFile(std::move(mistakes));
  variation.vary(options.seed, parameters);
  draw_kind(options.seed, parameters);
  return parameters;
}

std::map<std::string, double> drawn_values(const ResponderOptions& options,
                                           std::span<const ParameterPart> parts) {
  std::map<std::string, double> values;
  if (parts.empty()) return values;
  const ResponderParameters drawn = participant_parameters(options, parts);
  for (const ParameterRow& row : rows)
    if (has(parts, row.part) && (row.value > 0 || is_given(options, row.name)))
      values.emplace(row.name, drawn.*row.member);
  return values;
}

std::string describe_parameters(std::span<const ParameterPart> parts) {
  std::string text;
  if (has(parts, perception))
    text += fmt::format("cue = \"{}\"  ({}): {}\n", name_of(default_parameters().cue),
                        quoted_list(EnumNames<Cue>::names), cue_reason);
  for (const ParameterRow& row : rows) {
    if (!has(parts, row.part)) continue;
    const std::string spread =
        row.spread > 0 ? fmt::format(", varies by {:g} % between participants", 100 * row.spread)
                       : "";
    text += fmt::format("{} = {}  ({}, {} to {}{}): {}\n", row.name, row.value, row.unit, row.least,
                        row.most, spread, row.reason);
  }
  return text;
}

}  // namespace heft
