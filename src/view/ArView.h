// The plug for what shows the session: a window, a video file, or nothing. A view draws what it is
// given and reports what was touched; it decides nothing. One table, in ArView.cpp, names them all.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/Image.h"
#include "experiment/ScreenState.h"
#include "experiment/ScreenTexts.h"
#include "experiment/Stage.h"
#include "tracking/camera/Intrinsics.h"

namespace heft {

/// One frame to show: the world as of its capture, over the camera picture that it belongs to.
struct ViewFrame {
  DisplayedFrame frame;
  std::shared_ptr<const Image> camera;    ///< none: a plain table is drawn
  std::optional<Pose> camera_from_board;  ///< none: where the camera was last, or the default
  /// Of the camera picture, what is before all cubes: 255 wholly, one channel; none: nothing known.
  std::shared_ptr<const Image> in_front = {};
  std::optional<Pose> other_clone = {};  ///< of a what-if, in another color; none: not drawn
};

/// What a view needs to know before the first frame.
struct ViewSetup {
  Stage stage;
  std::optional<Intrinsics> camera;  ///< none: no camera pictures will come
  ScreenTexts texts;
  bool left_handed = false;            ///< mirrors the controls, never the cubes
  bool patch = false;                  ///< a photodiode's, which changes with each frame
  double text_size = 1;                ///< times as large as usual
  bool takes_keys = false;             ///< answers from the keyboard too
  std::string file;                    ///< what follows the colon: "video:session.mp4"
  double rate_hz = 15;                 ///< frames a second
  Eigen::Vector2d area_m{0.40, 0.30};  ///< working area: width and depth around the board's center
  /// What of the board frame a window shows; none: all of the picture.
  std::optional<Eigen::AlignedBox3d> shown_m = {};
  int display = 0;                                ///< its number
  bool windowed = false;                          ///< not full screen
  std::shared_ptr<DraggedEffector> dragged = {};  ///< to be dragged in trials; none: it is held
};

class ArView {
 public:
  virtual ~ArView() = default;

  /// Presents one frame and the screen around it.
  /// @return monotonic time (base/Clock.h) at which it was presented; none: there is no display
  virtual std::optional<double> present(const ViewFrame& shown, const ScreenState& screen) = 0;

  /// Keeps the screen alive for up to `seconds` and returns early with what was touched since the
  /// last call, in order. A view without a screen returns nothing at once.
  virtual std::vector<Touch> wait(double seconds) = 0;

  /// Where it is shown; none: on no display.
  virtual std::optional<DisplayFacts> display() const { return std::nullopt; }
  /// Whether the window fills the display; none: there is no window.
  virtual std::optional<bool> is_full_screen() const { return std::nullopt; }
  /// Pixels of the display from the middle of the effector to its clone's, in the frame presented
  /// last; none: not both were shown.
  virtual std::optional<double> clone_offset_px() const { return std::nullopt; }
};

/// A row of the table of views.
struct ViewEntry {
  std::string_view name;
  std::string_view summary;
  bool has_screen;  ///< people can look at it and touch it; the session then runs on a wall clock
  bool has_file;    ///< NAME:FILE
  /// @throws Error (device_missing) when there is no display
  std::unique_ptr<ArView> (*make)(const ViewSetup& setup);
};

std::span<const ViewEntry> views();

/// @throws Error (usage) naming the nearest view when there is none of that name
const ViewEntry& view_named(std::string_view name);

/// setup.file names the video: .mp4 (MPEG-4) or .avi (Motion JPEG, which stays readable however the
/// program ends). It plays at setup.rate_hz and is complete once the view is gone.
/// @throws Error for another ending, a file that exists already, or one that can't be written
std::unique_ptr<ArView> make_video_view(const ViewSetup& setup);

}  // namespace heft
