// A camera's response: the tone curve that the tracker learns from the board's edges, taken from
// the calibration's pictures, kept in the camera's file, and told in gray levels.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/Image.h"
#include "tracking/detection/ToneCurve.h"
#include "tracking/pose/MarkerBody.h"

namespace heft {

/// @param pictures of the board, in which the camera is calibrated already
/// @return none where the board's edges told nothing, as where its white is clipped
std::optional<std::array<double, 3>> learned_response(const Intrinsics& camera,
                                                      const MarkerBody& board,
                                                      const std::vector<Image>& pictures);

/// sRGB where the file says nothing.
ToneCurve response_of(const Intrinsics& camera);

/// How much brighter than by another curve middle grays are stored between a print's black and its
/// white, which both curves store alike: gray levels of 255, the most of any; negative where they
/// are darker.
double brighter_levels(const ToneCurve& curve, const ToneCurve& than);

/// From so many levels on a camera is said to bend tones.
inline constexpr double bending_levels = 10;

/// "12 of 255 levels darker than sRGB's"
std::string beside_srgb(double brighter_levels);

/// A line for the top of a camera's file.
std::string response_in_words(const Intrinsics& camera);

}  // namespace heft
