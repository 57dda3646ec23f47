#include <array>

#include "base/Pose.h"
#include "base/math/LevenbergMarquardt.h"
#include "tracking/calibration/EffectorCalibration.h"

namespace heft {

namespace {
// For the priors, relative to corners with an SD of 0.05 px.
constexpr double corner_sd_px = 0.05;
constexpr double place_sd_m = 0.005, turn_sd_rad = 0.1, bias_sd_px = 0.1;

// Unknowns: six of each tag, six of each view, the bias. A pose changes by a rotation about its
// origin and a shift, both in the target's axes.
struct Layout {
  Eigen::Index n_tags, n_views;
  Eigen::Index tag(std::size_t i) const { return 6 * static_cast<Eigen::Index>(i); }
  Eigen::Index view(std::size_t i) const { return 6 * (n_tags + static_cast<Eigen::Index>(i)); }
  Eigen::Index bias() const { return 6 * (n_tags + n_views); }
  Eigen::Index size() const { return bias() + 1; }
};

Layout layout_of(const TagBundle& bundle) {
  return {static_cast<Eigen::Index>(bundle.body_from_tag.size()),
          static_cast<Eigen::Index>(bundle.camera_from_body.size())};
}

using Equations = NormalEquations<Eigen::Dynamic>;

Pose moved(const Pose& pose, const Eigen::Matrix<double, 6, 1>& step) {
  return {pose.position_m + step.tail<3>(),
          (rotation_from_vector(step.head<3>()) * pose.orientation).normalized()};
}

TagBundle moved(const TagBundle& bundle, const Eigen::VectorXd& step) {
  const Layout at = layout_of(bundle);
  TagBundle next = bundle;
  for (std::size_t i = 0; i < next.body_from_tag.size(); ++i)
    next.body_from_tag[i] = moved(next.body_from_tag[i], step.segment<6>(at.tag(i)));
  for (std::size_t i = 0; i < next.camera_from_body.size(); ++i)
    next.camera_from_body[i] = moved(next.camera_from_body[i], step.segment<6>(at.view(i)));
  next.bias_px += step(at.bias());
  return next;
}

// The two equations of one corner: derivatives by its tag, its view and the bias.
struct CornerEquation {
  Eigen::Vector2d residual;
  Eigen::Matrix<double, 2, 6> by_tag, by_view;
  Eigen::Vector2d by_bias;
};

CornerEquation corner_equation(const TagBundle& bundle, const Intrinsics& camera,
                               const SeenTag& seen, std::size_t view, std::size_t corner,
                               const Eigen::Vector2d& outward) {
  const Pose& tag = bundle.body_from_tag[seen.tag];
  const Pose& body = bundle.camera_from_body[view];
  const Eigen::Vector3d in_tag = corner_in_tag(bundle.side_m[seen.tag], corner);
  const Eigen::Vector3d in_body = tag * in_tag, in_camera = body * in_body;
  const auto [pixel, by_point] = project_with_derivative(camera, in_camera);
  const Eigen::Matrix3d turn = body.orientation.toRotationMatrix();
  CornerEquation equation;
  equation.residual = pixel + bundle.bias_px * outward - seen.corners_px[corner];
  equation.by_view << -by_point * cross_matrix(body.orientation * in_body), by_point;
  equation.by_tag << -by_point * turn * cross_matrix(tag.orientation * in_tag), by_point * turn;
  equation.by_bias = outward;
  return equation;
}

void add(Equations& equations, const CornerEquation& corner, const Layout& at, std::size_t tag,
         std::size_t view) {
  Eigen::Matrix<double, 13, 2> by;
  by << corner.by_tag.transpose(), corner.by_view.transpose(), corner.by_bias.transpose();
  const RobustResidual robust = huber(corner.residual.norm() / corner_sd_px);
  const double weight = robust.weight / (corner_sd_px * corner_sd_px);
  const std::array<Eigen::Index, 3> place{at.tag(tag), at.view(view), at.bias()};
  const std::array<Eigen::Index, 3> from{0, 6, 12}, length{6, 6, 1};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto rows = by.middleRows(from[a], length[a]);
    equations.rhs.segment(place[a], length[a]) -= weight * rows * corner.residual;
    for (std::size_t b = 0; b < 3; ++b)
      equations.matrix.block(place[a], place[b], length[a], length[b]) +=
          weight * rows * by.middleRows(from[b], length[b]).transpose();
  }
  equations.cost += robust.cost;
  equations.sum_squares += corner.residual.squaredNorm();
  ++equations.n;
}

void add_springs(Equations& equations, const TagBundle& bundle, const TagBundle& start) {
  const Layout at = layout_of(bundle);
  for (std::size_t i = 0; i < bundle.body_from_tag.size(); ++i) {
    const Pose &now = bundle.body_from_tag[i], &then = start.body_from_tag[i];
    const Eigen::Vector3d turn = rotation_vector(now.orientation * then.orientation.conjugate());
    const Eigen::Vector3d shift = now.position_m - then.position_m;
    for (Eigen::Index k = 0; k < 3; ++k) {
      equations.add_prior(at.tag(i) + k, turn[k], turn_sd_rad);
      equations.add_prior(at.tag(i) + 3 + k, shift[k], place_sd_m);
    }
  }
  equations.add_prior(at.bias(), bundle.bias_px, bias_sd_px);
}

Equations equations_at(const TagBundle& bundle, const TagBundle& start, const Intrinsics& camera,
                       const std::vector<TagView>& views) {
  const Layout at = layout_of(bundle);
  Equations equations(at.size());
  for (std::size_t v = 0; v < views.size(); ++v)
    for (const SeenTag& seen : views[v].tags) {
      const auto outward = outward_moves(seen.corners_px);
      for (std::size_t c = 0; c < 4; ++c)
        add(equations, corner_equation(bundle, camera, seen, v, c, outward[c]), at, seen.tag, v);
    }
  add_springs(equations, bundle, start);
  return equations;
}
}  // namespace

Eigen::Vector3d corner_in_tag(double side_m, std::size_t corner) {
  const double half = side_m / 2;
  return {corner == 1 || corner == 2 ? half : -half, corner < 2 ? half : -half, 0};
}

double adjust(TagBundle& bundle, const Intrinsics& camera, const std::vector<TagView>& views) {
  constexpr int most_steps = 60;
  constexpr double settled = 1e-8;
  const TagBundle start = bundle;
  const auto at_this = [&](const TagBundle& at) { return equations_at(at, start, camera, views); };
  const auto step_from = [](const TagBundle& at, const Eigen::VectorXd& by) {
    return moved(at, by);
  };
  return levenberg_marquardt(bundle, most_steps, settled, at_this, step_from).rms();
}

}  // namespace heft
