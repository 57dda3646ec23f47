// A camera's response: the tone curve that the tracker learns from the board's edges in the
// calibration's pictures. It is kept in the camera's file and described in gray levels.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/Image.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/detection/ToneCurve.h"

namespace heft {

/// @param pictures of the board, used for the camera's calibration before
/// @return none if the board's edges do not determine it, for example if white is clipped
std::optional<std::array<double, 3>> learned_response(const Intrinsics& camera,
                                                      const MarkerBody& board,
                                                      const std::vector<Image>& pictures);

/// sRGB if the file has none.
ToneCurve response_of(const Intrinsics& camera);

/// The largest difference between the middle grays of two curves, scaled to have equal black and
/// white of a print: gray levels of 255; negative where `curve` is darker.
double brighter_levels(const ToneCurve& curve, const ToneCurve& than);

/// From this many levels on, a camera's curve counts as different.
inline constexpr double bending_levels = 10;

/// "12 of 255 levels darker than sRGB's"
std::string beside_srgb(double brighter_levels);

/// A line for the top of a camera's file.
std::string response_in_words(const Intrinsics& camera);

}  // namespace heft
