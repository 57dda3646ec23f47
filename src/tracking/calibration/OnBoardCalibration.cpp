#include "tracking/calibration/OnBoardCalibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/Error.h"
#include "base/Names.h"
#include "base/Pose.h"
#include "base/math/LevenbergMarquardt.h"
#include "base/math/Quantiles.h"
#include "tracking/calibration/CameraCalibration.h"

namespace heft {

namespace {
constexpr double corner_sd_px = 0.05;
// Prior SDs of the box's place relative to its tags: folded paper, and axes that are the tags' best
// fit.
constexpr double box_place_sd_m = 0.0003, box_turn_sd_rad = 0.01;
constexpr double bias_sd_px = 0.2, other_bias_sd_px = 0.01;  // the effector's less the board's
constexpr double places_differ_sd = 0.01;                    // scale of places less that of tags
constexpr double least_named = 0.002, deviations_named = 3;

// Unknowns: size of tags, distances between them, turn and place of the box, both biases; six of
// each view of the board, and along, across and turn of the effector on it.
enum Shared : Eigen::Index { tag_size = 0, places = 1, turn = 2, place = 5, bias = 8, other = 9 };
constexpr Eigen::Index n_shared = 10, n_of_view = 9, n_of_corner = n_shared + n_of_view;

using Equations = NormalEquations<Eigen::Dynamic>;

struct Unknowns {
  double tag_scale = 1, place_scale = 1;
  Pose box_from_tags;
  double bias_px = 0, other_bias_px = 0;
  std::vector<Pose> camera_from_board, board_from_box;  ///< of each view
};

Unknowns moved(Unknowns at, const Eigen::VectorXd& step) {
  const auto turned = [](const Eigen::Vector3d& by, const Eigen::Quaterniond& from) {
    return (rotation_from_vector(by) * from).normalized();
  };
  at.tag_scale += step(tag_size);
  at.place_scale += step(places);
  at.box_from_tags.orientation = turned(step.segment<3>(turn), at.box_from_tags.orientation);
  at.box_from_tags.position_m += step.segment<3>(place);
  at.bias_px += step(bias);
  at.other_bias_px += step(other);
  for (std::size_t i = 0; i < at.camera_from_board.size(); ++i) {
    const auto by = step.segment<n_of_view>(n_shared + n_of_view * static_cast<Eigen::Index>(i));
    Pose &board = at.camera_from_board[i], &box = at.board_from_box[i];
    board.orientation = turned(by.head<3>(), board.orientation);
    board.position_m += by.segment<3>(3);
    box.position_m.head<2>() += by.segment<2>(6);
    box.orientation = turned({0, 0, by(8)}, box.orientation);
  }
  return at;
}

// A corner in the camera's frame, and its derivatives by the shared unknowns and by its view's.
struct Corner {
  Eigen::Vector3d point_m;
  Eigen::Matrix<double, 3, n_of_corner> by = Eigen::Matrix<double, 3, n_of_corner>::Zero();
};

Corner on_board(const Pose& camera_from_board, const Eigen::Vector3d& corner_m) {
  Corner corner{camera_from_board * corner_m};
  corner.by.middleCols<3>(n_shared) = -cross_matrix(camera_from_board.orientation * corner_m);
  corner.by.middleCols<3>(n_shared + 3).setIdentity();
  return corner;
}

// The box stands on the face that is face_m below its origin.
Corner on_effector(const Unknowns& at, std::size_t view, double face_m, const Tag& tag,
                   std::size_t index) {
  const Pose& box = at.board_from_box[view];
  const Eigen::Vector3d middle_m = tag_center_m(tag), arm_m = tag.corners_m[index] - middle_m;
  const Eigen::Matrix3d box_from_tags = at.box_from_tags.orientation.toRotationMatrix();
  const Eigen::Vector3d turned_m =
      box_from_tags * (at.place_scale * middle_m + at.tag_scale * arm_m);
  const Eigen::Vector3d in_box_m = turned_m + at.box_from_tags.position_m;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d in_board_m =
      box.orientation * in_box_m +
      Eigen::Vector3d(box.position_m.x(), box.position_m.y(), at.place_scale * face_m);
  const Eigen::Matrix3d camera_from_board =
      at.camera_from_board[view].orientation.toRotationMatrix();
  const Eigen::Matrix3d camera_from_box = camera_from_board * box.orientation.toRotationMatrix();
  Corner corner = on_board(at.camera_from_board[view], in_board_m);
  corner.by.col(tag_size) = camera_from_box * box_from_tags * arm_m;
  corner.by.col(places) =
      camera_from_box * box_from_tags * middle_m + camera_from_board * (face_m * up);
  corner.by.middleCols<3>(turn) = -camera_from_box * cross_matrix(turned_m);
  corner.by.middleCols<3>(place) = camera_from_box;
  corner.by.middleCols<2>(n_shared + 6) = camera_from_board.leftCols<2>();
  corner.by.col(n_shared + 8) = camera_from_board * up.cross(box.orientation * in_box_m);
  return corner;
}

void add(Equations& equations, const Corner& corner, const Intrinsics& camera,
         const Eigen::Vector2d& seen_px, const Eigen::Vector2d& outward, const Unknowns& at,
         bool is_effector, std::size_t view) {
  const auto [pixel, by_point] = project_with_derivative(camera, corner.point_m);
  const double bias_px = at.bias_px + (is_effector ? at.other_bias_px : 0);
  const Eigen::Vector2d off_px = pixel + bias_px * outward - seen_px;
  Eigen::Matrix<double, 2, n_of_corner> by = by_point * corner.by;
  by.col(bias) = outward;
  if (is_effector) by.col(other) = outward;
  const RobustResidual robust = huber(off_px.norm() / corner_sd_px);
  const double weight = robust.weight / (corner_sd_px * corner_sd_px);
  const Eigen::Matrix<double, n_of_corner, n_of_corner> product = weight * by.transpose() * by;
  const Eigen::Matrix<double, n_of_corner, 1> rhs = -weight * by.transpose() * off_px;
  const Eigen::Index v = n_shared + n_of_view * static_cast<Eigen::Index>(view);
  equations.matrix.topLeftCorner<n_shared, n_shared>() +=
      product.topLeftCorner<n_shared, n_shared>();
  equations.matrix.block<n_shared, n_of_view>(0, v) +=
      product.topRightCorner<n_shared, n_of_view>();
  equations.matrix.block<n_of_view, n_shared>(v, 0) +=
      product.bottomLeftCorner<n_of_view, n_shared>();
  equations.matrix.block<n_of_view, n_of_view>(v, v) +=
      product.bottomRightCorner<n_of_view, n_of_view>();
  equations.rhs.head<n_shared>() += rhs.head<n_shared>();
  equations.rhs.segment<n_of_view>(v) += rhs.tail<n_of_view>();
  equations.cost += robust.cost;
  equations.sum_squares += off_px.squaredNorm();
  ++equations.n;
}

class Problem {
 public:
  Problem(const MarkerBody& board, const MarkerBody& effector, const Intrinsics& camera,
          const std::vector<StandingView>& views)
      : board_(board), effector_(effector), camera_(camera), views_(views) {}

  Unknowns start() const {
    Unknowns at;
    for (const StandingView& view : views_) {
      at.camera_from_board.push_back(view.camera_from_board);
      at.board_from_box.push_back(view.board_from_effector);
    }
    return at;
  }

  Equations equations(const Unknowns& at) const {
    Equations equations(n_shared + n_of_view * std::ssize(views_));
    for (std::size_t v = 0; v < views_.size(); ++v) add_view(equations, at, v);
    equations.add_prior(places, at.place_scale - at.tag_scale, places_differ_sd);
    const double coupled = 1 / (places_differ_sd * places_differ_sd);
    equations.matrix(tag_size, tag_size) += coupled;
    equations.matrix(tag_size, places) -= coupled;
    equations.matrix(places, tag_size) -= coupled;
    equations.rhs(tag_size) += coupled * (at.place_scale - at.tag_scale);
    const Eigen::Vector3d turned = rotation_vector(at.box_from_tags.orientation);
    for (Eigen::Index k = 0; k < 3; ++k) {
      equations.add_prior(turn + k, turned[k], box_turn_sd_rad);
      equations.add_prior(place + k, at.box_from_tags.position_m[k], box_place_sd_m);
    }
    equations.add_prior(bias, at.bias_px, bias_sd_px);
    equations.add_prior(other, at.other_bias_px, other_bias_sd_px);
    return equations;
  }

  /// Reprojection error of a view, rms.
  double rms_px(const Unknowns& at, std::size_t view) const {
    Equations equations(n_shared + n_of_view * std::ssize(views_));
    add_view(equations, at, view);
    return equations.rms();
  }

 private:
  void add_view(Equations& equations, const Unknowns& at, std::size_t v) const {
    const StandingView& view = views_[v];
    for (const bool is_effector : {false, true})
      for (const SeenTag& seen : (is_effector ? view.effector : view.board).tags) {
        const auto outward = outward_moves(seen.corners_px);
        for (std::size_t c = 0; c < 4; ++c)
          add(equations,
              is_effector ? on_effector(at, v, view.face_m, effector_.tags[seen.tag], c)
                          : on_board(at.camera_from_board[v], board_.tags[seen.tag].corners_m[c]),
              camera_, seen.corners_px[c], outward[c], at, is_effector, v);
      }
  }

  const MarkerBody &board_, &effector_;
  const Intrinsics& camera_;
  const std::vector<StandingView>& views_;
};

// Leaves out views that contradict the others, perhaps because the effector was lifted or not flat
// on the board.
std::vector<StandingView> without_outliers(const Problem& problem, const Unknowns& at,
                                           const std::vector<StandingView>& views) {
  constexpr double times_median = 3, never_below_px = 0.15;
  std::vector<double> all_px;
  for (std::size_t v = 0; v < views.size(); ++v) all_px.push_back(problem.rms_px(at, v));
  const double limit_px =
      std::max(never_below_px, times_median * quantile(all_px, 0.5).value_or(0));
  std::vector<StandingView> kept;
  for (std::size_t v = 0; v < views.size(); ++v)
    if (all_px[v] <= limit_px) kept.push_back(views[v]);
  return kept;
}

double percent(double scale) {
  return 100 * std::abs(scale - 1);
}
}  // namespace

bool OnBoardCalibration::is_uniform() const {
  const double sd = std::hypot(tag_scale_sd, place_scale_sd);
  return std::abs(tag_scale - place_scale) < std::max(least_named, deviations_named * sd);
}

OnBoardCalibration calibrate_on_board(const MarkerBody& board, const MarkerBody& effector,
                                      const Intrinsics& camera,
                                      const std::vector<StandingView>& views) {
  constexpr int most_steps = 50;
  constexpr double settled = 1e-9;
  if (views.empty()) throw Error("no picture shows the effector standing on the board");
  const auto solve = [](const Problem& problem, Unknowns& at) {
    return levenberg_marquardt(
        at, most_steps, settled, [&](const Unknowns& from) { return problem.equations(from); },
        [](const Unknowns& from, const Eigen::VectorXd& step) { return moved(from, step); });
  };
  const Problem first(board, effector, camera, views);
  Unknowns at = first.start();
  Equations equations = solve(first, at);
  const std::vector<StandingView> kept = without_outliers(first, at, views);
  if (kept.size() < views.size()) {
    const Problem second(board, effector, camera, kept);
    at = second.start();
    equations = solve(second, at);
  }
  OnBoardCalibration result{effector, board.measured_ruler_m.has_value(),
                            effector.measured_ruler_m.has_value()};
  const Eigen::MatrixXd covariance = equations.matrix.inverse();
  const double worse = std::max(1.0, equations.rms() / (std::sqrt(2) * corner_sd_px));
  result.tag_scale = at.tag_scale;
  result.place_scale = at.place_scale;
  result.tag_scale_sd = worse * std::sqrt(covariance(tag_size, tag_size));
  result.place_scale_sd = worse * std::sqrt(covariance(places, places));
  result.rms_px = equations.rms();
  result.n_views = static_cast<int>(kept.size());
  result.n_left_out = static_cast<int>(views.size() - kept.size());
  const double between = result.is_uniform() ? at.tag_scale : at.place_scale;
  MarkerBody& scaled = result.effector;
  scaled.size_m *= between;
  scaled.chamfer_m *= between;
  scaled.measured_ruler_m = between * effector.measured_ruler_m.value_or(ruler_m);
  if (scaled.measured_across_m) *scaled.measured_across_m *= between;
  for (Tag& tag : scaled.tags) {
    const Eigen::Vector3d middle_m = tag_center_m(tag);
    for (Eigen::Vector3d& corner_m : tag.corners_m)
      corner_m = between * middle_m + at.tag_scale * (corner_m - middle_m);
  }
  return result;
}

std::vector<std::string> doubts(const OnBoardCalibration& c) {
  constexpr double good_rms_px = 0.3, good_sd = 0.001;
  std::vector<std::string> list;
  const bool is_off =
      std::abs(c.tag_scale - 1) > std::max(least_named, deviations_named * c.tag_scale_sd);
  if (is_off && c.board_measured && c.effector_measured)
    list.push_back(fmt::format(
        "the rulers of both sheets disagree by {:.2f} %: measure both again; if the board's is "
        "right, the effector's is {:.2f} mm",
        percent(c.tag_scale), 1e3 * *c.effector.measured_ruler_m));
  if (!c.board_measured)
    list.push_back(fmt::format(
        "the board's ruler was not measured: the effector fits the board, but both may be too "
        "large or too small; measure it (ruler_measured_m), and repeat this"));
  if (!c.is_uniform())
    list.push_back(fmt::format(
        "the effector's tags are {:.2f} % {} than the distances between them, as if they were "
        "printed apart; compare the file with the sheet",
        percent(c.tag_scale / c.place_scale), c.tag_scale > c.place_scale ? "larger" : "smaller"));
  if (c.tag_scale_sd > good_sd)
    list.push_back(fmt::format(
        "the ratio has a standard error of {:.2f} %, expected {} %; stand the effector in more "
        "places, nearer, with two of its tags visible",
        100 * c.tag_scale_sd, 100 * good_sd));
  if (c.rms_px > good_rms_px)
    list.push_back(fmt::format(
        "corners are {:.2f} px off (rms), expected {} or less; check that the effector stands flat "
        "and still, and measure its tags first (heft calibrate effector without --on-board)",
        c.rms_px, good_rms_px));
  return list;
}

std::string summary(const OnBoardCalibration& c) {
  std::string text = fmt::format(
      "the effector stands on the board in {}, {} left out, reprojection {:.3f} px rms\n"
      "the effector's tags are {:.2f} % {} than in its file ({:.2f} either way), if the board is "
      "as large as its file says\n",
      counted(c.n_views, "picture"), c.n_left_out, c.rms_px, percent(c.tag_scale),
      c.tag_scale < 1 ? "smaller" : "larger", 200 * c.tag_scale_sd);
  text += fmt::format("written: ruler_measured_m = {:.6f}\n", *c.effector.measured_ruler_m);
  return text + verdict_of(doubts(c));
}

}  // namespace heft
