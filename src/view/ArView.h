// Views: a window, a video file, or none. A view draws frames and reports touches; it makes no
// decisions. ArView.cpp has the table of all views.
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

/// One frame to display: the world at its capture, over the camera picture.
struct ViewFrame {
  DisplayedFrame frame;
  std::shared_ptr<const Image> camera;    ///< none: a plain table is drawn
  std::optional<Pose> camera_from_board;  ///< none: the last viewpoint, or the default
  /// How much of each camera pixel is in front of all cubes, of 255; one channel; none: unknown.
  std::shared_ptr<const Image> in_front = {};
  std::optional<Pose> other_clone = {};  ///< of a what-if, as an outline; none: not drawn
  /// Captions of a replay: above a video's frames, over a window's scene.
  std::vector<std::string> captions = {};
};

/// Configuration of a view.
struct ViewSetup {
  Stage stage;
  std::optional<Intrinsics> camera;  ///< none: there are no camera pictures
  ScreenTexts texts;
  bool left_handed = false;  ///< mirrors the controls, never the cubes
  bool patch = false;        ///< draws a patch for a photodiode that changes with each frame
  double text_size = 1;      ///< relative to the usual size
  bool takes_keys = false;   ///< answers from the keyboard, too
  std::string file;          ///< what follows the colon: "video:session.mp4"
  int n_captions = 0;        ///< lines above a video's frames (ViewFrame::captions)
  double rate_hz = 15;       ///< frames per second
  Eigen::Vector2d area_m{0.40, 0.30};  ///< working area: width and depth around the board's center
  /// The part of the board frame that a window shows; none: the whole picture.
  std::optional<Eigen::AlignedBox3d> shown_m = {};
  int display = 0;        ///< its number
  bool windowed = false;  ///< not full screen
  /// Dragged by the participant in trials; none: the effector is real or simulated.
  std::shared_ptr<DraggedEffector> dragged = {};
};

class ArView {
 public:
  virtual ~ArView() = default;

  /// Presents one frame and the screen around it.
  /// @return monotonic time (base/Clock.h) of its presentation; none: there is no display
  virtual std::optional<double> present(const ViewFrame& shown, const ScreenState& screen) = 0;

  /// Keeps the screen responsive for up to `seconds`; returns early with the touches since the last
  /// call, in order. A view without a screen returns immediately.
  virtual std::vector<Touch> wait(double seconds) = 0;

  /// The display of the view; none: no display.
  virtual std::optional<DisplayFacts> display() const { return std::nullopt; }
  /// Whether the window fills the display; none: there is no window.
  virtual std::optional<bool> is_full_screen() const { return std::nullopt; }
  /// Distance in pixels from the middle of the effector to its clone's, in the last presented
  /// frame; none: not both were visible.
  virtual std::optional<double> clone_offset_px() const { return std::nullopt; }
};

/// A row of the table of views.
struct ViewEntry {
  std::string_view name;
  std::string_view summary;
  bool has_screen;  ///< can be seen and touched; the session then runs on a wall clock
  bool has_file;    ///< NAME:FILE
  /// @throws Error (device_missing) if there is no display
  std::unique_ptr<ArView> (*make)(const ViewSetup& setup);
};

std::span<const ViewEntry> views();

/// @throws Error (usage) suggesting the most similar view if there is none of that name
const ViewEntry& view_named(std::string_view name);

/// setup.file names the video: .mp4 (MPEG-4) or .avi (Motion JPEG, which remains readable after a
/// crash). It plays at setup.rate_hz and is complete once the view is destroyed.
/// @throws Error for another extension, an existing file, or one that cannot be written
std::unique_ptr<ArView> make_video_view(const ViewSetup& setup);

}  // namespace heft
