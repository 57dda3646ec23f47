#include <algorithm>
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

bool add_edge(Equations& equations, const TagObservation::Edge& edge, double outward,
              const Unknowns& at) {
  if (std::isinf(edge.sd_px)) return true;
  End a, b;
  if (!project_end(at.pose, edge.start_m, a) || !project_end(at.pose, edge.end_m, b)) return false;
  const Eigen::Vector2d along = b.ray - a.ray;
  const double length = along.norm();
  const Eigen::Vector2d normal(along.y() / length, -along.x() / length);  // outwards
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Vector2d from_a = edge.rays[i] - a.ray;
    const double fraction = from_a.dot(along) / (length * length);
    const double scale = edge.px_per_ray[i];
    Vector7 by;
    by.head<6>() =
        -scale * ((1 - fraction) * a.by_pose + fraction * b.by_pose).transpose() * normal;
    by(6) = -outward;
    add_residual(equations, scale * normal.dot(from_a) - outward * at.bias_px, by, edge.sd_px);
  }
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

double tag_rms_px(const TagObservation& tag, const BodyFit& fit) {
  const BiasPrior fixed{fit.bias_px, 0};
  const Equations equations = equations_at({tag}, {fit.camera_from_body, fit.bias_px}, fixed);
  return equations.cost >= behind ? behind : equations.rms();
}

}  // namespace heft
