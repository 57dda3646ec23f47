// What a camera's temporal denoising leaves of the last picture in each, and pictures without it:
//
//   seen(n) = (1 - share) * light(n) + share * seen(n - 1)
//
// of stored values. The share follows from noise where nothing moves, an autoregressive process of
// first order. With d(n) = seen(n) - seen(n - 1), d(n) = share * d(n - 1) + (1 - share) * (light(n)
// - light(n - 1)), whose last term is independent of d(n - 2), so that
//
//   share = cov(d(n), d(n - 2)) / cov(d(n - 1), d(n - 2))
//
// (an instrumental variable: Anderson and Hsiao, J. Am. Stat. Assoc. 76, 1981). A denoiser that
// spares motion leaves no ghost of a moving tag: solving for light(n) would then give values beyond
// black and white, and is not done.
#pragma once

#include <deque>

#include "base/Image.h"

namespace heft {

class TemporalMix {
 public:
  /// Takes the next picture.
  /// @param gray 1 channel, as it was seen  @param noise its SD, gray levels
  /// @return the same without the last picture's share, if that is known and can be removed
  Image cleared(Image gray, double t_s, double noise);

  /// Fraction of the last picture in each; 0 if none or unknown.
  double share() const { return share_; }

  /// Whether the last picture repeated the one before.
  bool repeats() const { return repeats_; }

  /// Whether a ghost is left in the last picture: pictures before it were lost.
  bool leaves_ghost() const { return leaves_ghost_; }

  /// The next picture does not continue the last ones. Keeps the share.
  void reset();

 private:
  struct Seen {
    Image gray;
    double t_s;
  };
  void learn(double noise);
  bool keeps_motion_sharp() const;

  std::deque<Seen> seen_;             ///< the last pictures, the newest first
  double next_ = 0, after_next_ = 0;  ///< covariances of d(n - 2), summed
  double share_ = 0;
  int n_taken_ = 0;            ///< pictures, in all
  std::size_t n_regular_ = 0;  ///< pictures without a gap before them
  bool repeats_ = false, leaves_ghost_ = false;
  double usual_gap_s_ = 0;
};

}  // namespace heft
