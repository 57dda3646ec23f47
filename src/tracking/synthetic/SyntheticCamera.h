// A camera that renders what a real one would film: a table, the printed board, a hand that holds
// the effector with its tags; through a lens, with an exposure time and a sensor. Its pixels go to
// the same tracker. Exact ground truth: the poses it was given.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "base/Image.h"
#include "base/PoseTypes.h"
#include "tracking/pose/MarkerBody.h"

namespace heft {

/// The camera that the project's goals are stated for: fx 540 at 640 pixels across, 1000 at 1280,
/// others in proportion; distortion k1 .06, k2 -.15.
Intrinsics default_camera(int width_px, int height_px);

struct Optics {
  double blur_px = 0.6;  ///< sd of the lens' blur, on linear light; more where out of focus
  /// The tone curve: light to the power of 1/gamma is stored, 1 being linear; none: sRGB.
  std::optional<double> gamma = std::nullopt;
  double vignetting = 0.3;  ///< fraction of light lost in the corners; grows with distance squared
  double exposure = 1;      ///< 1: white paper just below saturation
  double noise = 3;  ///< sd, of 255; the same in all three channels, so gray pictures have it too
  double exposure_s = 0.004;  ///< how long the shutter is open; moving things blur
  double readout_s = 0;  ///< how much later the last row is exposed than the first; they lean, too

  // What other cameras, and the light before them, do to a picture, in the order in which it comes.
  /// Light that is missing on one side of a line through the effector, 1 being all of it.
  double shadow = 0;
  /// Light that a lamp's reflection adds on the effector, 1 being white; half of it at a sixteenth
  /// of the picture's width from there.
  double glare = 0;
  double film_curve = 0;  ///< share of what is stored that bends as film does: a toe, a shoulder
  double s_curve = 0;     ///< contrast in the middle of what is stored, 1 being v^2 (3 - 2 v)
  bool mosaic = false;    ///< each pixel has one color, the others are interpolated
  double sharpening = 0;  ///< of the stored values: what a blur of 1 px takes off, times it
  int jpeg_quality = 0;   ///< of libjpeg's scale, 1 to 100; 0: not compressed
};

/// How things are against what the files of the apparatus say.
struct FileErrors {
  double board_tag_scale = 1, effector_tag_scale = 1;  ///< tags about their centers
  double focal_length_scale = 1;
};

struct SyntheticSettings {
  /// Where the camera stands; the default looks down on the whole board from the participant's
  /// side.
  Pose camera_from_board;
  Optics optics;
  FileErrors files;
  bool hand = true;  ///< a hand that holds the effector's back end and occludes
  bool left_hand = false;
  /// Renderings averaged over the exposure where the effector moves, at least; more where it smears
  /// so far that they would show.
  int motion_samples = 4;

  SyntheticSettings();
};

class SyntheticCamera {
 public:
  /// The effector over time, seconds; none: out of view.
  using EffectorPath = std::function<std::optional<Pose>(double t_s)>;

  /// @param seed of the noise; the same seed, number and path give the same pixels
  /// @param apparatus as its files have it
  /// @throws Error for an unknown tag family, a board tag that does not lie on the table, an
  ///   effector tag that does not lie on a face of the box
  SyntheticCamera(const Apparatus& apparatus, const SyntheticSettings& settings,
                  std::uint64_t seed);
  ~SyntheticCamera();
  SyntheticCamera(SyntheticCamera&&) noexcept;
  SyntheticCamera& operator=(SyntheticCamera&&) noexcept;

  /// The picture whose exposure, of its first row, has its middle at t_s. @param number of the
  /// picture: its noise
  Image picture(const EffectorPath& board_from_effector, double t_s, std::uint64_t number);

  /// What of a picture is hand, as it is seen: 255 wholly, one channel.
  Image hand_in_picture(const Pose& board_from_effector);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heft
