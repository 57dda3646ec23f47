// What one tag's pixels say about a body's pose, and which of them are the tag's.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/Image.h"
#include "tracking/camera/RollingShutter.h"
#include "tracking/pose/TagModel.h"

namespace heft {

class TagFit {
 public:
  using MatrixShared = Eigen::Matrix<double, TagModel::n_shared, TagModel::n_shared>;
  using VectorShared = Eigen::Matrix<double, TagModel::n_shared, 1>;
  using MatrixAll = Eigen::Matrix<double, TagModel::n_all, TagModel::n_all>;
  using VectorAll = TagModel::VectorAll;

  /// Of an adjustment: at first pixels are off because the pose is, at last because they show
  /// another thing.
  enum class Round { first, next, last };

  /// @param noise sd of the picture's, gray levels; for the others see align_densely
  TagFit(const Image& gray, const Intrinsics& camera, const DenseTag& tag, const Pose& start,
         const ToneCurve& curve, double noise, const std::optional<Smear>& smear,
         const std::optional<RowsHeld>& rows);

  bool usable() const { return pixels_.size() > 100; }

  /// Adds what the pixels say about what tags share, the tag's own unknowns taken out.
  void add_to(MatrixShared& matrix, VectorShared& rhs, const Pose& pose, double bias_px,
              Round round);

  /// The tag's own unknowns follow what tags share.
  void step(const VectorShared& shared) { model_.change_own(own_step_ - own_by_shared_ * shared); }

  /// A lamp.
  bool reflects() const { return reflects_; }

  /// Of the pixels.
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
