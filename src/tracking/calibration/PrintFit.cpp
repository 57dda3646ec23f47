#include "tracking/calibration/PrintFit.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

namespace heft {

namespace {
// Smaller deviations move the effector by less than half a millimeter; noise alone does not reach
// this many standard errors.
constexpr double least_stretch = 0.0008, least_shear_rad = 0.0008, least_deviations = 4;

// Unknowns: nine of the camera, stretch and shear, six of each view.
constexpr Eigen::Index n_of_camera = 9, stretch_at = 9, shear_at = 10, views_at = 11, n_of_view = 6;

bool stands_out(double value, double sd, double least) {
  return std::abs(value) > std::max(least, least_deviations * sd);
}

// Derivatives of a view's pixels, and its residuals.
struct Linear {
  Eigen::MatrixXd by_view, by_camera, by_shape;
  Eigen::VectorXd residuals;
};

// Derivatives of pixels by a point's position on the board, from those by the board's position.
Eigen::MatrixXd by_shape(const FittedView& view, const Eigen::MatrixXd& by_shift) {
  cv::Mat turn;
  cv::Rodrigues(view.turn, turn);
  Eigen::Matrix3d camera_from_board;
  cv::cv2eigen(turn, camera_from_board);
  Eigen::MatrixXd moves(by_shift.rows(), 2);
  for (Eigen::Index row = 0; row < by_shift.rows(); ++row) {
    const cv::Point3f& p = view.on_board[static_cast<std::size_t>(row / 2)];
    const Eigen::RowVector3d by_place = by_shift.row(row) * camera_from_board;
    moves(row, 0) = (by_place.x() * p.x - by_place.y() * p.y) / 2;
    moves(row, 1) = (by_place.x() * p.y + by_place.y() * p.x) / 2;
  }
  return moves;
}

Linear linear_at(const FittedView& view, const cv::Mat& matrix, const cv::Mat& distortion) {
  std::vector<cv::Point2f> projected;
  cv::Mat derivatives;
  cv::projectPoints(view.on_board, view.turn, view.shift, matrix, distortion, projected,
                    derivatives);
  Eigen::MatrixXd all;
  cv::cv2eigen(derivatives, all);
  Linear linear{all.leftCols(n_of_view), all.middleCols(n_of_view, n_of_camera),
                by_shape(view, all.middleCols(3, 3)), Eigen::VectorXd(all.rows())};
  for (std::size_t i = 0; i < projected.size(); ++i) {
    const cv::Point2f off = view.in_picture[i] - projected[i];
    linear.residuals.segment<2>(2 * static_cast<Eigen::Index>(i)) << off.x, off.y;
  }
  return linear;
}
}  // namespace

bool PrintShape::is_stretched() const {
  return stands_out(stretch, stretch_sd, least_stretch);
}

bool PrintShape::is_sheared() const {
  return stands_out(shear_rad, shear_sd_rad, least_shear_rad);
}

PrintShape shape_of_print(const std::vector<FittedView>& views, const cv::Mat& matrix,
                          const cv::Mat& distortion) {
  const auto n = views_at + n_of_view * static_cast<Eigen::Index>(views.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(n);
  double squares = 0, n_residuals = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const Linear linear = linear_at(views[v], matrix, distortion);
    Eigen::MatrixXd by(linear.residuals.size(), views_at + n_of_view);
    by << linear.by_camera, linear.by_shape, linear.by_view;
    const Eigen::MatrixXd products = by.transpose() * by;
    const Eigen::VectorXd view_rhs = by.transpose() * linear.residuals;
    const Eigen::Index at = views_at + n_of_view * static_cast<Eigen::Index>(v);
    normal.topLeftCorner<views_at, views_at>() += products.topLeftCorner<views_at, views_at>();
    normal.block(0, at, views_at, n_of_view) = products.topRightCorner(views_at, n_of_view);
    normal.block(at, 0, n_of_view, views_at) = products.bottomLeftCorner(n_of_view, views_at);
    normal.block(at, at, n_of_view, n_of_view) = products.bottomRightCorner(n_of_view, n_of_view);
    rhs.head<views_at>() += view_rhs.head<views_at>();
    rhs.segment(at, n_of_view) = view_rhs.tail(n_of_view);
    squares += linear.residuals.squaredNorm();
    n_residuals += static_cast<double>(linear.residuals.size());
  }
  // Focal lengths and distortion differ by orders of magnitude.
  const Eigen::VectorXd scale = normal.diagonal().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> solver(scale.asDiagonal() * normal * scale.asDiagonal());
  const Eigen::VectorXd step = scale.cwiseProduct(solver.solve(scale.cwiseProduct(rhs)));
  const double left = std::max(0.0, squares - step.dot(rhs));
  const double variance = left / std::max(1.0, n_residuals - static_cast<double>(n));
  const auto sd = [&](Eigen::Index at) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(n, at) * scale[at];
    return std::sqrt(std::max(0.0, variance * unit.dot(solver.solve(unit))));
  };
  return {step[stretch_at], sd(stretch_at), step[shear_at], sd(shear_at)};
}

}  // namespace heft
