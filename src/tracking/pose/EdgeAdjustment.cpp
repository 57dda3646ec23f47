#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/Pose.h"
#include "base/math/LevenbergMarquardt.h"
#include "tracking/detection/FitMath.h"
#include "tracking/pose/BodyPose.h"

namespace heft {

namespace {
// Six parameters of the pose (a rotation about the camera's axes through the body's origin, then a
// shift) and the bias.
using Vector7 = Eigen::Matrix<double, 7, 1>;
using Equations = NormalEquations<7>;

constexpr double model_sd_px = 0.02;  // assumed accuracy of printed edges
constexpr double behind = 1e12;       // cost of a pose with a tag behind the camera

struct Unknowns {
  Pose pose;
  double bias_px;
};

// An edge's end in the ray plane.
struct End {
  Eigen::Vector2d ray;
  Eigen::Matrix<double, 2, 6> by_pose;
};

bool project_end(const Pose& pose, const Eigen::Vector3d& point_m, End& end) {
  const Eigen::Vector3d arm = pose.orientation * point_m;
  const Eigen::Vector3d p = pose.position_m + arm;
  if (!(p.z() > 1e-3)) return false;
  const double w = 1 / p.z();
  end.ray = p.head<2>() * w;
  const Eigen::RowVector3d x_by_point(w, 0, -end.ray.x() * w), y_by_point(0, w, -end.ray.y() * w);
  end.by_pose.row(0) << arm.cross(x_by_point.transpose()).transpose(), x_by_point;
  end.by_pose.row(1) << arm.cross(y_by_point.transpose()).transpose(), y_by_point;
  return true;
}

void add_residual(Equations& equations, double residual_px, const Vector7& by, double sd_px) {
  const double variance = sd_px * sd_px + model_sd_px * model_sd_px;
  const RobustResidual robust = huber(std::abs(residual_px) / std::sqrt(variance));
  const double weight = robust.weight / variance;
  add_lower<7>(equations.matrix, weight * by, by);
  equations.rhs -= weight * residual_px * by;
  equations.cost += robust.cost;
  equations.sum_squares += residual_px * residual_px;
  ++equations.n;
}

// One of the two equations of an edge.
struct EdgeResidual {
  double px;
  Vector7 by;
  double by_focal;  ///< by the relative focal length
};

bool edge_residuals(const TagObservation::Edge& edge, double outward, const Unknowns& at,
                    std::array<EdgeResidual, 2>& residuals) {
  End a, b;
  if (!project_end(at.pose, edge.start_m, a) || !project_end(at.pose, edge.end_m, b)) return false;
  const Eigen::Vector2d along = b.ray - a.ray;
  const double length = along.norm();
  const Eigen::Vector2d normal(along.y() / length, -along.x() / length);  // outwards
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Vector2d from_a = edge.rays[i] - a.ray;
    const double fraction = from_a.dot(along) / (length * length);
    const double scale = edge.px_per_ray[i];
    EdgeResidual& one = residuals[i];
    one.px = scale * normal.dot(from_a) - outward * at.bias_px;
    one.by.head<6>() =
        -scale * ((1 - fraction) * a.by_pose + fraction * b.by_pose).transpose() * normal;
    one.by(6) = -outward;
    one.by_focal = -scale * normal.dot(edge.rays[i]);
  }
  return true;
}

bool add_edge(Equations& equations, const TagObservation::Edge& edge, double outward,
              const Unknowns& at) {
  if (std::isinf(edge.sd_px)) return true;
  std::array<EdgeResidual, 2> residuals;
  if (!edge_residuals(edge, outward, at, residuals)) return false;
  for (const EdgeResidual& one : residuals) add_residual(equations, one.px, one.by, edge.sd_px);
  return true;
}

Equations equations_at(const std::vector<TagObservation>& tags, const Unknowns& at,
                       const BiasPrior& prior) {
  Equations equations;
  for (const TagObservation& tag : tags)
    for (const auto& edge : tag.edges)
      if (!add_edge(equations, edge, tag.outward, at)) {
        equations.cost = behind;
        return equations;
      }
  complete_upper(equations.matrix);
  equations.add_prior(6, at.bias_px - prior.mean_px, std::max(prior.sd_px, 1e-6));
  return equations;
}

Unknowns moved(const Unknowns& from, const Vector7& step) {
  const Eigen::Vector3d turn = step.head<3>(), shift = step.segment<3>(3);
  return {{from.pose.position_m + shift,
           (rotation_from_vector(turn) * from.pose.orientation).normalized()},
          from.bias_px + step(6)};
}

BodyFit fit_of(const Unknowns& at, const Equations& equations) {
  BodyFit fit;
  fit.camera_from_body = at.pose;
  fit.bias_px = at.bias_px;
  const Eigen::Matrix<double, 7, 7> covariance =
      equations.matrix.ldlt().solve(Eigen::Matrix<double, 7, 7>::Identity());
  fit.covariance = covariance.topLeftCorner<6, 6>();
  fit.bias_sd_px = std::sqrt(covariance(6, 6));
  fit.cost = equations.cost;
  fit.rms_px = equations.rms();
  return fit;
}
}  // namespace

BodyFit adjust(const std::vector<TagObservation>& tags, const Pose& start, const BiasPrior& prior) {
  constexpr int most_steps = 25;
  constexpr double settled = 1e-6;
  Unknowns at{start, prior.mean_px};
  const auto at_these = [&](const Unknowns& these) { return equations_at(tags, these, prior); };
  const Equations equations = levenberg_marquardt(at, most_steps, settled, at_these, moved);
  return fit_of(at, equations);
}

// One step of Gauss and Newton with the focal length as the eighth unknown.
FocalError focal_error(const std::vector<TagObservation>& tags, const BodyFit& fit,
                       const BiasPrior& prior) {
  const Unknowns at{fit.camera_from_body, fit.bias_px};
  NormalEquations<8> equations;
  for (const TagObservation& tag : tags)
    for (const TagObservation::Edge& edge : tag.edges) {
      std::array<EdgeResidual, 2> residuals;
      if (std::isinf(edge.sd_px) || !edge_residuals(edge, tag.outward, at, residuals)) continue;
      for (const EdgeResidual& one : residuals) {
        const double variance = edge.sd_px * edge.sd_px + model_sd_px * model_sd_px;
        const double weight = huber(std::abs(one.px) / std::sqrt(variance)).weight / variance;
        Eigen::Matrix<double, 8, 1> by;
        by << one.by, one.by_focal;
        equations.matrix += weight * by * by.transpose();
        equations.rhs -= weight * one.px * by;
      }
    }
  equations.add_prior(6, fit.bias_px - prior.mean_px, std::max(prior.sd_px, 1e-6));
  const Eigen::LDLT<Eigen::Matrix<double, 8, 8>> solver(equations.matrix);
  const Eigen::Matrix<double, 8, 1> last = Eigen::Matrix<double, 8, 1>::Unit(7);
  return {solver.solve(equations.rhs)(7), std::sqrt(solver.solve(last)(7))};
}

double tag_rms_px(const TagObservation& tag, const BodyFit& fit) {
  const BiasPrior fixed{fit.bias_px, 0};
  const Equations equations = equations_at({tag}, {fit.camera_from_body, fit.bias_px}, fixed);
  return equations.cost >= behind ? behind : equations.rms();
}

}  // namespace heft
