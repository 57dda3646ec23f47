#include "tracking/calibration/Response.h"

#include <fmt/format.h>

#include <cmath>

#include "tracking/Tracker.h"

namespace heft {

std::optional<std::array<double, 3>> learned_response(const Intrinsics& camera,
                                                      const MarkerBody& board,
                                                      const std::vector<Image>& pictures) {
  Tracker tracker({camera, board, {}});
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    tracker.reset();  // each view is from another place
    tracker.track(pictures[i], static_cast<double>(i));
  }
  if (!tracker.has_tone_evidence()) return std::nullopt;
  const ToneBend& bend = tracker.tone().bend();
  return std::array{bend[0], bend[1], bend[2]};
}

ToneCurve response_of(const Intrinsics& camera) {
  if (!camera.response) return ToneCurve();
  return ToneCurve(ToneBend(camera.response->data()));
}

double brighter_levels(const ToneCurve& curve, const ToneCurve& than) {
  constexpr double black = 40, white = 230;  // typical values of a print in good light
  const double dark = curve.light(black), bright = curve.light(white);
  const double other_dark = than.light(black), other_bright = than.light(white);
  double most = 0;
  for (double value = black; value <= white; value += 5) {
    const double share = (curve.light(value) - dark) / (bright - dark);
    const double off = value - than.stored(other_dark + share * (other_bright - other_dark)).value;
    if (std::abs(off) > std::abs(most)) most = off;
  }
  return most;
}

std::string beside_srgb(double brighter_levels) {
  return fmt::format("{:.0f} of 255 levels {} than sRGB's", std::abs(brighter_levels),
                     brighter_levels < 0 ? "darker" : "brighter");
}

std::string response_in_words(const Intrinsics& camera) {
  if (!camera.response)
    return "tone curve: not learned from the board's edges; check that its paper is not white "
           "(clipped)\n";
  const double levels = brighter_levels(response_of(camera), ToneCurve());
  return fmt::format("tone curve: {}, middle grays {}\n",
                     std::abs(levels) < bending_levels ? "close to sRGB" : "different from sRGB",
                     beside_srgb(levels));
}

}  // namespace heft
