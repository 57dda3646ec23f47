// Renders a camera's pictures: a table, the printed board, a hand that holds the effector with its
// tags; through a lens, with an exposure time and a sensor. The pictures are processed by the same
// tracker, and the true poses are known.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "base/Image.h"
#include "base/PoseTypes.h"
#include "tracking/detection/MarkerBody.h"

namespace heft {

/// The camera of the project's goals: fx 540 at 640 pixels across, 1000 at 1280, others in
/// proportion; distortion k1 0.06, k2 -0.15.
Intrinsics default_camera(int width_px, int height_px);

struct Optics {
  double blur_px = 0.6;  ///< SD of the lens's blur, in linear light; larger out of focus
  /// Tone curve: stored is light to the power of 1/gamma, 1 being linear; none: sRGB.
  std::optional<double> gamma = std::nullopt;
  double vignetting = 0.3;  ///< fraction of light lost in the corners; grows with distance squared
  double exposure = 1;      ///< 1: white paper just below saturation
  double noise = 3;         ///< SD in gray levels of 255; equal in all three channels, so that gray
                            ///< pictures have it, too
  double exposure_s = 0.004;  ///< exposure time; moving objects are blurred
  double readout_s = 0;       ///< delay of the last row after the first; moving objects are sheared

  // Imperfections of other cameras and of light, in the order of their effect:
  /// Fraction of light missing on one side of a line through the effector.
  double shadow = 0;
  /// Light added by a lamp's reflection on the effector, relative to white; half of it at a
  /// sixteenth of the picture's width from there.
  double glare = 0;
  double film_curve = 0;  ///< weight of a film curve, with a toe and a shoulder, on stored values
  double s_curve = 0;     ///< weight of mid-tone contrast, v^2 (3 - 2 v), on stored values
  bool mosaic = false;    ///< each pixel has one color, the others are interpolated
  double sharpening = 0;  ///< factor of the difference to a blur of 1 px, on stored values
  int jpeg_quality = 0;   ///< libjpeg's scale, 1 to 100; 0: not compressed

  // Changes over time:
  double auto_gain = 0;           ///< amplitude of the gain, relative to 1; period 4 s
  double auto_white_balance = 0;  ///< of red's gain, and of blue's in opposition; period 5 s
  double flicker = 0;             ///< amplitude of light at 100 Hz, relative to its mean
  double breathing = 0;           ///< amplitude of the focal length, relative to it; period 3 s
  double last_picture = 0;        ///< fraction of the last picture in each: temporal denoising
  double repeated = 0;            ///< fraction of pictures that repeat the last one
  double dropped = 0;             ///< fraction of pictures that are lost
};

/// True values relative to the files of the apparatus.
struct FileErrors {
  double board_tag_scale = 1, effector_tag_scale = 1;  ///< tags about their centers
  double focal_length_scale = 1;
  double ink_m = 0;  ///< by which ink spreads beyond the edges of both prints' black cells
};

struct SyntheticSettings {
  /// The camera's pose; the default sees the whole board from the participant's side.
  Pose camera_from_board;
  Optics optics;
  FileErrors files;
  bool hand = true;  ///< draws a hand that holds the effector's back end and occludes
  bool left_hand = false;
  /// Minimum number of renderings averaged over the exposure while the effector moves; more if the
  /// smear is so long that they would be visible.
  int motion_samples = 4;

  SyntheticSettings();
};

class SyntheticCamera {
 public:
  /// The effector over time, seconds; none: out of view.
  using EffectorPath = std::function<std::optional<Pose>(double t_s)>;

  /// @param seed of the noise; equal seed, number and path give equal pixels
  /// @param apparatus as described by its files
  /// @throws Error for an unknown tag family, a board tag that is not on the table, an effector tag
  /// that is not on
  ///   a face of the box
  SyntheticCamera(const Apparatus& apparatus, const SyntheticSettings& settings,
                  std::uint64_t seed);
  ~SyntheticCamera();
  SyntheticCamera(SyntheticCamera&&) noexcept;
  SyntheticCamera& operator=(SyntheticCamera&&) noexcept;

  /// The picture whose first row's exposure has its middle at t_s. A camera that denoises or
  /// repeats pictures continues the last one.
  /// @param number of the picture, for its noise
  Image picture(const EffectorPath& board_from_effector, double t_s, std::uint64_t number);

  /// Whether that picture is lost on its way.
  bool drops(std::uint64_t number) const;

  /// The next picture does not continue the last one.
  void restart();

  /// Coverage by the visible hand: 255 completely, one channel.
  Image hand_in_picture(const Pose& board_from_effector);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heft
