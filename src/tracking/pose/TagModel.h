// The predicted gray level of a tag's pixel:
//
//   tone_curve((dark + contrast * B(s) + reflected(s)) * (1 + gradient . s))
//
// with B the tag's cells, 0 black and 1 white, blurred by a normal distribution; s the place on the
// tag hit by the pixel's ray; reflected a lamp's gloss, a polynomial of second degree, because a
// hill of light on a tag otherwise looks like larger cells.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>

#include "base/PoseTypes.h"
#include "tracking/detection/TagFamily.h"
#include "tracking/detection/ToneCurve.h"
#include "tracking/pose/BodyPose.h"

namespace heft {

// Intersections of rays with a tag.

/// A tag as a plane in the camera's frame: its border's top left corner and its cells' sides.
struct TagPlane {
  Eigen::Vector3d corner_m, right_m, down_m;
  /// For a point: number of cells to the right and down, and 1, times its depth.
  Eigen::Matrix3d cell_of;

  TagPlane(const Pose& pose, const std::array<Eigen::Vector3d, 4>& corners_m, int n_cells);
};

/// The place on the tag that a ray hits, and derivatives.
struct TagHit {
  Eigen::Vector2d cell;           ///< from the border's corner
  Eigen::Matrix2d cell_by_slant;  ///< by the ray's distance from a point, at the point's depth
  Eigen::Vector3d point_m;

  TagHit(const TagPlane& plane, const Eigen::Vector2d& ray);
};

struct DenseTag {
  const TagObservation* seen;
  const TagPattern* pattern;
};

/// Motion while the shutter is open, which smears cells.
struct Smear {
  Velocity velocity;         ///< of the body's origin, in the camera's frame
  double still_blur_px = 0;  ///< blur of objects at rest
};

class TagModel {
 public:
  /// Unknowns shared by tags: rotation, shift, bias.
  static constexpr int n_shared = 7;
  /// A tag's own unknowns: dark, contrast, gradient along and down, log of the blur; reflected
  /// light.
  static constexpr int n_sure = 5, n_reflected = 5, n_own = n_sure + n_reflected;
  static constexpr int n_all = n_shared + n_own;
  enum Own { dark, contrast, along, down, log_blur, reflected };
  using VectorAll = Eigen::Matrix<double, n_all, 1>;
  using VectorOwn = Eigen::Matrix<double, n_own, 1>;

  TagModel(const DenseTag& tag, const ToneCurve& curve);

  /// Bright enough, and not blurred over cells.
  bool is_clear() const;
  TagPlane plane(const Pose& pose) const;
  int border_cells() const { return pattern_.border_cells; }

  /// Sets the blur's shape to that of a moving tag.
  void smear_along(const Smear& smear, const Pose& pose);

  /// Distance beyond the border up to which pixels are compared; blur of an edge: cells along both
  /// axes.
  Eigen::Vector2d beyond_cells(const TagPlane& plane) const;
  Eigen::Vector2d near_cells(const TagPlane& plane) const;

  /// Whether no edge of the pattern is near a place. @param near distance in cells
  bool is_flat(const Eigen::Vector2d& cell, const Eigen::Vector2d& near) const;

  double blur_px() const { return blur_px_.maxCoeff(); }

  const VectorOwn& own() const { return own_; }
  void change_own(const VectorOwn& change);

  /// Predicted gray level of a ray's pixel.
  /// @param bias_px by which white is smaller on both sides  @param by its derivative
  double gray_level(const Eigen::Vector2d& ray, const TagPlane& plane, const Pose& pose,
                    double bias_px, VectorAll& by) const;

 private:
  TagHit middle(const TagPlane& plane) const;
  void paint();

  const TagObservation& seen_;
  const TagPattern& pattern_;
  const ToneCurve& curve_;
  const Eigen::Vector2d blur_px_;
  Eigen::Matrix2d blur_shape_ =
      Eigen::Matrix2d::Identity();  ///< covariance, relative to an isotropic one
  Eigen::MatrixXd white_;           ///< cells, 0 or 1
  int n_painted_ = 0;
  VectorOwn own_ = VectorOwn::Zero();
  double wider_ = 1;  ///< factor of the blur, from own_(log_blur)
};

}  // namespace heft
