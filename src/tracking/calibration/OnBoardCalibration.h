// The ratio of the effector's print to the board's, from pictures of the effector standing on the
// board. Pictures do not determine a body's overall size, only its size relative to its distance.
// Where the effector stands on the board, its lower face is in the board's plane, so that the board
// gives its distance. Thus only one of both sheets' rulers must be measured, and a wrong one is
// found. Fitted together by least squares: the size of the effector's tags and the distances
// between them, the place of its box relative to its tags, the edge biases, and each picture's
// poses of board and effector.
#pragma once

#include <string>
#include <vector>

#include "base/PoseTypes.h"
#include "tracking/calibration/TagViews.h"

namespace heft {

/// One picture of the effector standing on the board.
struct StandingView {
  TagView board, effector;
  Pose camera_from_board, board_from_effector;  ///< approximately, with a face down
  double face_m = 0;                            ///< distance of that face from the origin
};

/// Selects the pictures that show the effector standing still on the board.
class StandingViews {
 public:
  /// @param live a person may be holding the effector: it must be still in two pictures
  StandingViews(const MarkerBody& board, const MarkerBody& effector, const Intrinsics& camera,
                bool live);

  /// @return whether it was kept
  /// @throws Error for a picture of another size than the camera's calibration
  bool offer(const Image& image, const std::string& name);

  bool complete() const { return views_.size() >= enough; }
  bool full() const { return views_.size() >= most; }
  double progress() const { return static_cast<double>(views_.size()) / enough; }
  /// "of 9 pictures 5 were kept; 2 do not show 4 of the board's tags clearly; ..."
  std::string tally() const;
  const std::vector<StandingView>& views() const { return views_; }

 private:
  static constexpr std::size_t enough = 8, most = 60;

  MarkerBody board_, effector_;
  Intrinsics camera_;
  TagViewer board_viewer_, effector_viewer_;
  bool live_;
  TagView last_;
  std::vector<StandingView> views_;
  int n_offered_ = 0, n_without_board_ = 0, n_without_effector_ = 0, n_not_standing_ = 0,
      n_moving_ = 0, n_alike_ = 0;
};

struct OnBoardCalibration {
  MarkerBody effector;                                     ///< scaled to fit the board
  bool board_measured = false, effector_measured = false;  ///< the rulers of the sheets
  /// Size of the effector's tags, and of the distances between them, relative to its file, if the
  /// board is as large as its file says; standard errors.
  double tag_scale = 1, tag_scale_sd = 0, place_scale = 1, place_scale_sd = 0;
  double rms_px = 0;  ///< reprojection
  int n_views = 0, n_left_out = 0;

  /// Whether tags and the distances between them differ by the same factor.
  bool is_uniform() const;
};

/// @param effector its tags' places as measured by calibrate_effector, or as designed
/// @throws Error without a view
OnBoardCalibration calibrate_on_board(const MarkerBody& board, const MarkerBody& effector,
                                      const Intrinsics& camera,
                                      const std::vector<StandingView>& views);

/// Reasons to distrust the result, with advice; empty if there are none.
std::vector<std::string> doubts(const OnBoardCalibration& calibration);

/// Description of the result, for the top of its file.
std::string summary(const OnBoardCalibration& calibration);

}  // namespace heft
