// Information of one tag's pixels on a body's pose, and the selection of pixels that show the tag.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/Image.h"
#include "tracking/pose/RollingShutter.h"
#include "tracking/pose/TagModel.h"

namespace heft {

class TagFit {
 public:
  using MatrixShared = Eigen::Matrix<double, TagModel::n_shared, TagModel::n_shared>;
  using VectorShared = Eigen::Matrix<double, TagModel::n_shared, 1>;
  using MatrixAll = Eigen::Matrix<double, TagModel::n_all, TagModel::n_all>;
  using VectorAll = TagModel::VectorAll;

  /// Round of an adjustment: at first residuals come from the pose, at last from other objects.
  enum class Round { first, next, last };

  /// @param noise SD of the picture's, gray levels; for the others see align_densely
  TagFit(const Image& gray, const Intrinsics& camera, const DenseTag& tag, const Pose& start,
         const ToneCurve& curve, double noise, const std::optional<Smear>& smear,
         const std::optional<RowsHeld>& rows);

  bool usable() const { return pixels_.size() > 100; }

  /// Adds the pixels' equations for the shared unknowns, with the tag's own unknowns eliminated.
  void add_to(MatrixShared& matrix, VectorShared& rhs, const Pose& pose, double bias_px,
              Round round);

  /// Updates the tag's own unknowns after a step of the shared ones.
  void step(const VectorShared& shared) { model_.change_own(own_step_ - own_by_shared_ * shared); }

  /// Whether a lamp is reflected.
  bool reflects() const { return reflects_; }

  /// Fraction of pixels explained.
  double explained() const;

 private:
  struct Pixel {
    Eigen::Vector2d ray;
    double value;
  };

  void collect(const Image& gray, const Intrinsics& camera, const Pose& pose,
               const std::optional<RowsHeld>& rows);
  void leave_out_covered(const Pose& pose);
  double far_off(double share) const;
  static double gained(const MatrixAll& all, const VectorAll& rhs);

  TagModel model_;
  const TagObservation& seen_;
  double picture_noise_, noise_;
  std::vector<Pixel> pixels_;
  TagModel::VectorOwn own_step_ = TagModel::VectorOwn::Zero();
  Eigen::Matrix<double, TagModel::n_own, TagModel::n_shared> own_by_shared_;
  int used_ = 0;
  bool reflects_ = false;
};

}  // namespace heft
