#include "tracking/EdgeAdjustment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/Pose.h"

namespace heft {

namespace {
// Six of the pose (a turn about the camera's axes through the body's origin, then a shift), one of
// the bias.
using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

constexpr double model_sd_px = 0.02;  // how straight and well placed printed edges are taken to be
constexpr double huber = 2.5;
constexpr double behind = 1e12;  // cost of a pose that has a tag behind the camera

struct Unknowns {
  Pose pose;
  double bias_px;
};

struct Equations {
  Matrix7 matrix = Matrix7::Zero();
  Vector7 pull = Vector7::Zero();
  double cost = 0, sum_px2 = 0;
  int n = 0;
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
  const double size = std::abs(residual_px) / std::sqrt(variance);
  const double weight = (size > huber ? huber / size : 1) / variance;
  equations.matrix.noalias() += (weight * by) * by.transpose();
  equations.pull -= weight * residual_px * by;
  equations.cost += size > huber ? huber * (2 * size - huber) : size * size;
  equations.sum_px2 += residual_px * residual_px;
  ++equations.n;
}

bool add_edge(Equations& equations, const TagObservation::Edge& edge, double outward,
              const Unknowns& at) {
  End a, b;
  if (!project_end(at.pose, edge.start_m, a) || !project_end(at.pose, edge.end_m, b)) return false;
  const Eigen::Vector2d along = b.ray - a.ray;
  const double length = along.norm();
  const Eigen::Vector2d normal(along.y() / length, -along.x() / length);  // outwards
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Vector2d from_a = edge.rays[i] - a.ray;
    const double share = from_a.dot(along) / (length * length);
    const double scale = edge.px_per_ray[i];
    Vector7 by;
    by.head<6>() = -scale * ((1 - share) * a.by_pose + share * b.by_pose).transpose() * normal;
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
  const double sd = std::max(prior.sd_px, 1e-6);
  const double off = (at.bias_px - prior.mean_px) / sd;
  equations.matrix(6, 6) += 1 / (sd * sd);
  equations.pull(6) -= off / sd;
  equations.cost += off * off;
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
  const Matrix7 covariance = equations.matrix.ldlt().solve(Matrix7::Identity());
  fit.covariance = covariance.topLeftCorner<6, 6>();
  fit.bias_sd_px = std::sqrt(covariance(6, 6));
  fit.cost = equations.cost;
  fit.rms_px = std::sqrt(equations.sum_px2 / std::max(1, equations.n));
  return fit;
}
}  // namespace

BodyFit adjust(const std::vector<TagObservation>& tags, const Pose& start, const BiasPrior& prior) {
  constexpr int most_steps = 25;
  Unknowns at{start, prior.mean_px};
  Equations equations = equations_at(tags, at, prior);
  double damping = 1e-4;
  for (int i = 0; i < most_steps && damping < 1e8; ++i) {
    Matrix7 matrix = equations.matrix;
    matrix.diagonal() *= 1 + damping;
    const Vector7 step = matrix.ldlt().solve(equations.pull);
    const Unknowns there = moved(at, step);
    const Equations next = equations_at(tags, there, prior);
    if (!(next.cost <= equations.cost)) {
      damping *= 10;
      continue;
    }
    const double gained = equations.cost - next.cost;
    at = there;
    equations = next;
    damping = std::max(damping / 10, 1e-9);
    if (gained <= 1e-6 * (1 + equations.cost)) break;
  }
  return fit_of(at, equations);
}

double tag_rms_px(const TagObservation& tag, const BodyFit& fit) {
  const BiasPrior fixed{fit.bias_px, 0};
  const Equations equations = equations_at({tag}, {fit.camera_from_body, fit.bias_px}, fixed);
  return equations.cost >= behind ? behind : std::sqrt(equations.sum_px2 / equations.n);
}

}  // namespace heft
