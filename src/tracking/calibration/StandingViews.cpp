// The selection of pictures that show the effector standing on the board.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/Error.h"
#include "base/Names.h"
#include "tracking/calibration/CameraCalibration.h"
#include "tracking/calibration/OnBoardCalibration.h"
#include "tracking/detection/PlanarPose.h"

namespace heft {

namespace {
// A single tag's pose may be tilted by this much, and a print that is a few percent off, as far
// from the board.
constexpr double most_tilt_rad = 0.4, most_height_m = 0.025;
constexpr double least_difference = 0.01;  // of the picture's width
constexpr double steady_px = 1;            // between consecutive pictures

// The view without the lens's distortion.
TagView undistorted(TagView view, const Intrinsics& camera) {
  for (SeenTag& seen : view.tags)
    for (Eigen::Vector2d& px : seen.corners_px) {
      const Eigen::Vector2d ray = undistort(camera, px);
      px = {camera.fx_px * ray.x() + camera.cx_px, camera.fy_px * ray.y() + camera.cy_px};
    }
  return view;
}

struct Standing {
  Pose board_from_effector;
  double face_m = 0;
  double off = 0;  // relative to the limits
};

// The pose with its lowest face turned and moved onto the board; none if it is far from it.
std::optional<Standing> put_down(const MarkerBody& effector, const Pose& board_from_effector) {
  const Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();
  std::optional<Standing> nearest;
  for (const BoxFace name : faces_of(effector.box())) {
    const FaceFrame face = face_frame(effector.box(), name);
    const Eigen::Vector3d normal = board_from_effector.orientation * face.normal();
    const double tilt_rad = std::acos(std::clamp(normal.dot(down), -1.0, 1.0));
    const double height_m = (board_from_effector * face.center_m).z();
    if (tilt_rad > most_tilt_rad || std::abs(height_m) > most_height_m) continue;
    const double off = tilt_rad / most_tilt_rad + std::abs(height_m) / most_height_m;
    if (nearest && nearest->off < off) continue;
    Standing standing{board_from_effector, face.center_m.dot(face.normal()), off};
    Pose& pose = standing.board_from_effector;
    pose.orientation = Eigen::Quaterniond::FromTwoVectors(normal, down) * pose.orientation;
    pose.position_m.z() = standing.face_m;
    nearest = standing;
  }
  return nearest;
}

// The pose, among those that single tags allow, that is nearest to standing.
std::optional<Standing> standing_in(const TagView& view, const MarkerBody& effector,
                                    const Intrinsics& camera, const Pose& camera_from_board) {
  std::optional<Standing> nearest;
  for (const SeenTag& seen : view.tags) {
    std::array<Eigen::Vector2d, 4> rays;
    std::ranges::transform(seen.corners_px, rays.begin(),
                           [&](const Eigen::Vector2d& px) { return undistort(camera, px); });
    for (const Pose& pose : planar_poses(effector.tags[seen.tag].corners_m, rays)) {
      const auto standing = put_down(effector, camera_from_board.inverse() * pose);
      if (standing && (!nearest || standing->off < nearest->off)) nearest = standing;
    }
  }
  return nearest;
}
}  // namespace

StandingViews::StandingViews(const MarkerBody& board, const MarkerBody& effector,
                             const Intrinsics& camera, bool live)
    : board_(board),
      effector_(effector),
      camera_(camera),
      board_viewer_(board),
      effector_viewer_(effector),
      live_(live) {}

bool StandingViews::offer(const Image& image, const std::string& name) {
  if (image.width != camera_.width_px || image.height != camera_.height_px)
    throw Error(fmt::format("{} is {} x {} pixels, but the camera was calibrated at {} x {}", name,
                            image.width, image.height, camera_.width_px, camera_.height_px));
  ++n_offered_;
  const TagView before = std::move(last_);
  StandingView view{
      board_viewer_.view(image, camera_), effector_viewer_.view(image, camera_), {}, {}};
  view.board.name = view.effector.name = name;
  last_ = view.effector;
  const auto skipped = [](int& count) { return ++count, false; };
  const auto board = rough_pose(board_, camera_, undistorted(view.board, camera_));
  if (!board) return skipped(n_without_board_);
  if (view.effector.tags.empty()) return skipped(n_without_effector_);
  const auto standing = standing_in(view.effector, effector_, camera_, *board);
  if (!standing) return skipped(n_not_standing_);
  if (live_ && difference_px(view.effector, before) > steady_px) return skipped(n_moving_);
  for (const StandingView& kept : views_)
    if (difference_px(view.effector, kept.effector) < camera_.width_px * least_difference)
      return skipped(n_alike_);
  view.camera_from_board = *board;
  view.board_from_effector = standing->board_from_effector;
  view.face_m = standing->face_m;
  views_.push_back(std::move(view));
  return true;
}

std::string StandingViews::tally() const {
  std::string text =
      fmt::format("of {} {} were kept", counted(n_offered_, "picture"), views_.size());
  const auto add = [&](int n, const std::string& why) {
    if (n > 0) text += fmt::format("; {} {}", n, why);
  };
  add(n_without_board_,
      fmt::format("do not show the board clearly ({} tags or more)", least_tags_of_a_view));
  add(n_without_effector_, "do not show a tag of the effector clearly");
  add(n_not_standing_, "show it above the board or tilted");
  add(n_moving_, "were taken while it moved");
  add(n_alike_, "show it where another one does");
  return text;
}

}  // namespace heft
