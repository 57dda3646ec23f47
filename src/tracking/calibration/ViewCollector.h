// Selects pictures of a stream for calibration, and lists the missing views: different
// views of the board that cover the picture and are tilted to all sides; views of the effector with
// two or more tags.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tracking/calibration/CameraCalibration.h"
#include "tracking/calibration/TagViews.h"

namespace heft {

class ViewCollector {
 public:
  /// Sufficient for rays within 0.2 px; more than `most` only take time.
  static constexpr std::size_t enough = 20, most = 60;

  /// @param live pictures of a hand-held board: blurred ones are skipped, and views must differ
  /// more, to be
  ///   spread over the picture
  ViewCollector(const MarkerBody& board, int width_px, int height_px, bool live);

  /// @return whether the picture was kept: enough tags, unlike every kept one, not moving
  bool offer(const Image& image, const std::string& name);

  bool complete() const;
  bool full() const { return names_.size() >= most; }
  /// The next instruction for the operator; empty if complete.
  std::string wanted() const;
  /// All missing views, one after the other; empty if complete.
  std::vector<std::string> missing() const;
  /// Statistics of rejected pictures: without the board, moving, or similar to a kept one.
  std::string tally() const;

  std::size_t size() const { return names_.size(); }
  const Image& last_offered() const { return last_image_; }
  const Coverage& coverage() const { return coverage_; }
  const std::vector<Image>& pictures() const { return pictures_; }
  const std::vector<std::string>& names() const { return names_; }

 private:
  enum Side { left, right, upper, lower };
  void count_pose(const TagView& view);

  MarkerBody board_;
  Intrinsics guess_;
  TagViewer viewer_;
  bool live_;
  double least_difference_px_;
  TagView last_;
  Image last_image_;
  std::vector<TagView> views_;
  std::vector<Image> pictures_;
  std::vector<std::string> names_;
  Coverage coverage_;
  std::array<int, 4> tilted_{};  ///< number of views with that side of the board farther away
  double nearest_m_ = 0, farthest_m_ = 0;
  std::size_t n_offered_ = 0, n_without_board_ = 0, n_moving_ = 0, n_alike_ = 0;
};

class EffectorViews {
 public:
  EffectorViews(const MarkerBody& effector, const Intrinsics& camera);

  /// @throws Error for a picture of another size than the camera's calibration
  void offer(const Image& image, const std::string& name);

  /// Enough views, and enough of every tag.
  bool complete() const;
  bool full() const { return views_.size() >= most; }
  /// Fraction of the required views; at least 1 when there are enough.
  double progress() const { return static_cast<double>(views_.size()) / enough; }
  /// "12 pictures; tag 30: 7 tag 31: 5".
  std::string counts() const;
  const std::vector<TagView>& views() const { return views_; }

 private:
  static constexpr std::size_t enough = 46, most = 120;
  static constexpr int enough_of_a_tag = 12;

  void require_size(const Image& image, const std::string& name) const;

  MarkerBody effector_;
  Intrinsics camera_;
  TagViewer viewer_;
  std::vector<TagView> views_;
  std::vector<int> counts_;  ///< by tag
};

}  // namespace heft
