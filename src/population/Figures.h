// Figures of a study as papers print them, means and standard deviations over participants, and
// what one participant contributes to each.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apparatus/configuration/ResolvedConfig.h"
#include "base/Names.h"
#include "record/stream/EventSink.h"

namespace heft {

/// jnd: mean estimate of the procedures at a reference, g.
/// correct, incorrect, dont_know: share of the sorting trials in a condition, %.
/// false_alarms: share of the catch trials in which a difference was named, %.
/// wrong_choices: share of the choices in comparisons that named the lighter cube, %.
/// stroke_depth: mean distance over which the hand pushed a cube in one contact, mm.
/// first_try: share of the introductions whose first answer is correct, %.
enum class FigureKind {
  jnd,
  correct,
  incorrect,
  dont_know,
  false_alarms,
  wrong_choices,
  stroke_depth,
  first_try
};
template <>
struct EnumNames<FigureKind> {
  static constexpr std::array<std::string_view, 8> names{
      "jnd",          "correct",       "incorrect",    "dont_know",
      "false_alarms", "wrong_choices", "stroke_depth", "first_try"};
};

/// "g", "%" or "mm".
std::string_view unit_of(FigureKind kind);

/// What a figure is a figure of.
struct FigurePlace {
  FigureKind kind = FigureKind::jnd;
  std::optional<double> reference_g;  ///< jnd only
  std::string condition;              ///< of sorting trials; empty: all trials

  bool operator==(const FigurePlace&) const = default;
};

/// "jnd at 200 g", "correct in C1".
std::string text_of(const FigurePlace& place);

/// A figure that a study found.
struct ReportedFigure {
  FigurePlace place;
  std::optional<double> mean, sd;  ///< over participants; none: not reported, only predicted
  int n = 1;                       ///< participants
  bool fitted = true;              ///< false: compared with the fit, but not part of it
};

/// @param file name in messages
/// @throws InvalidFile naming each mistake at its place
std::vector<ReportedFigure> parse_figures(const std::string& text, const std::string& file);

/// One participant's session without a log.
/// @param config whose tracker is `surrogate` or `hand`
/// @param each called with every event and what it changed
void run_alone(const ResolvedConfig& config, Responder& responder, std::uint64_t seed,
               std::function<void(const Event&, const Changes&)> each);

/// One participant's contribution to each figure, from such a session; none: they have no such
/// trial, or no estimate.
std::vector<std::optional<double>> figures_of_one(const ResolvedConfig& config,
                                                  Responder& responder, std::uint64_t seed,
                                                  std::span<const FigurePlace> places);

}  // namespace heft
