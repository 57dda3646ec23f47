#include "tracking/calibration/CameraCalibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "base/Error.h"
#include "base/Names.h"
#include "tracking/calibration/PrintFit.h"
#include "tracking/camera/ImageConversion.h"

namespace heft {

namespace {
constexpr int most_bias_rounds = 6;
constexpr double settled_bias_px = 0.002;
constexpr int excess_rounds = 3;

// Corners of one picture and of the board.
struct Points {
  std::vector<cv::Point3f> on_board;
  std::vector<cv::Point2f> in_picture;
  std::vector<Eigen::Vector2d> outward;  ///< direction in which each moves with the edge bias
};

struct View {
  TagView tags;
  CalibratedView result;
};

Points points_of(const View& view, const MarkerBody& board) {
  Points points;
  for (const SeenTag& seen : view.tags.tags) {
    const auto moves = outward_moves(seen.corners_px);
    for (std::size_t c = 0; c < 4; ++c) {
      const Eigen::Vector3f on_board = board.tags[seen.tag].corners_m[c].cast<float>();
      const Eigen::Vector2f px =
          (seen.corners_px[c] - view.result.bias_px * moves[c]).cast<float>();
      points.on_board.emplace_back(on_board.x(), on_board.y(), on_board.z());
      points.in_picture.emplace_back(px.x(), px.y());
      points.outward.push_back(moves[c]);
    }
  }
  return points;
}

// Parameters and results of OpenCV's calibration.
struct Solution {
  cv::Mat matrix, distortion;
  double focal_sd_px = 0, center_sd_px = 0;
  std::vector<cv::Mat> turns, shifts;
};

bool is_flat(const MarkerBody& board) {
  return std::ranges::all_of(board.tags, [](const Tag& tag) {
    return std::ranges::all_of(tag.corners_m, [](const auto& c) { return std::abs(c.z()) < 1e-9; });
  });
}

cv::Mat matrix_of(const Intrinsics& c) {
  return (cv::Mat_<double>(3, 3) << c.fx_px, 0, c.cx_px, 0, c.fy_px, c.cy_px, 0, 0, 1);
}

Solution solve(const std::vector<Points>& points, const Intrinsics& guess, bool use_guess) {
  std::vector<std::vector<cv::Point3f>> on_board;
  std::vector<std::vector<cv::Point2f>> in_picture;
  for (const Points& view : points) {
    on_board.push_back(view.on_board);
    in_picture.push_back(view.in_picture);
  }
  Solution solution{matrix_of(guess), cv::Mat::zeros(1, 5, CV_64F), 0, 0, {}, {}};
  cv::Mat errors, pose_errors, per_view;
  try {
    cv::calibrateCamera(on_board, in_picture, cv::Size(guess.width_px, guess.height_px),
                        solution.matrix, solution.distortion, solution.turns, solution.shifts,
                        errors, pose_errors, per_view,
                        use_guess ? cv::CALIB_USE_INTRINSIC_GUESS : 0);
  } catch (const cv::Exception& error) {
    throw Error(fmt::format("no camera fits these views ({}); check the board file", error.err));
  }
  solution.focal_sd_px = std::max(errors.at<double>(0), errors.at<double>(1));
  solution.center_sd_px = std::max(errors.at<double>(2), errors.at<double>(3));
  return solution;
}

Intrinsics intrinsics_of(const Solution& solution, Intrinsics camera) {
  camera.fx_px = solution.matrix.at<double>(0, 0);
  camera.fy_px = solution.matrix.at<double>(1, 1);
  camera.cx_px = solution.matrix.at<double>(0, 2);
  camera.cy_px = solution.matrix.at<double>(1, 2);
  for (int i = 0; i < 5; ++i)
    camera.distortion[static_cast<std::size_t>(i)] = solution.distortion.at<double>(i);
  return camera;
}

// Statistics of a view's residuals: their size, the remaining edge bias, the board's normal.
// @return change of the bias, pixels
double judge(View& view, const Points& points, const Solution& solution, std::size_t i) {
  std::vector<cv::Point2f> projected;
  cv::projectPoints(points.on_board, solution.turns[i], solution.shifts[i], solution.matrix,
                    solution.distortion, projected);
  double sum_px2 = 0, along = 0, squares = 0;
  for (std::size_t k = 0; k < projected.size(); ++k) {
    const cv::Point2f off = points.in_picture[k] - projected[k];
    const Eigen::Vector2d residual(off.x, off.y);
    sum_px2 += residual.squaredNorm();
    along += residual.dot(points.outward[k]);
    squares += points.outward[k].squaredNorm();
  }
  view.result.reprojection_px = std::sqrt(sum_px2 / static_cast<double>(projected.size()));
  view.result.bias_px += along / squares;
  const Pose camera_from_board = pose_from(solution.turns[i], solution.shifts[i]);
  view.result.normal = camera_from_board.orientation * Eigen::Vector3d::UnitZ();
  view.result.distance_m = camera_from_board.position_m.norm();
  return std::abs(along / squares);
}

std::vector<View*> used_of(std::vector<View>& views) {
  std::vector<View*> used;
  for (View& view : views)
    if (view.result.used) used.push_back(&view);
  return used;
}

// Alternates between camera and biases: gaps between tags grow as tags shrink, so that each round
// leaves a small part of the bias.
Solution solve_with_bias(std::vector<View>& views, const MarkerBody& board,
                         const Intrinsics& guess) {
  Solution solution;
  double change_px = 1;
  for (int round = 0; round < most_bias_rounds && change_px > settled_bias_px; ++round) {
    const std::vector<View*> used = used_of(views);
    std::vector<Points> points;
    for (const View* view : used) points.push_back(points_of(*view, board));
    solution = solve(points, guess, !is_flat(board));
    change_px = 0;
    for (std::size_t i = 0; i < used.size(); ++i)
      change_px = std::max(change_px, judge(*used[i], points[i], solution, i));
  }
  return solution;
}

// Leaves out views that are much worse than the others. @return whether there were any
bool reject_outliers(std::vector<View>& views) {
  constexpr double times_median = 3, never_below_px = 0.1;
  std::vector<View*> used = used_of(views);
  std::ranges::sort(used, {}, [](const View* view) { return view->result.reprojection_px; });
  const double median_px = used[used.size() / 2]->result.reprojection_px;
  const double limit_px = std::max(times_median * median_px, never_below_px);
  bool any = false;
  for (View* view : used)
    if (view->result.reprojection_px > limit_px && used_of(views).size() > least_views) {
      view->result.used = false;
      any = true;
    }
  return any;
}

std::vector<View> views_of(const MarkerBody& board, const std::vector<Image>& pictures,
                           const std::vector<std::string>& names, const Intrinsics& camera) {
  TagViewer viewer(board);
  std::vector<View> views;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    View view{viewer.view(pictures[i], camera), {}};
    view.result.name = names.at(i);
    view.result.n_tags = view.tags.tags.size();
    if (view.result.n_tags >= least_tags_of_a_view) views.push_back(std::move(view));
  }
  if (views.size() < least_views)
    throw Error(fmt::format(
        "{} or more of the board's tags are clear in {} of {}, expected in at least "
        "{} and better 20; check the board file, focus and light",
        least_tags_of_a_view, views.size(), counted(std::ssize(pictures), "picture"), least_views));
  return views;
}

PrintShape print_of(std::vector<View>& views, const MarkerBody& board, const Solution& solution) {
  std::vector<FittedView> fitted;
  const std::vector<View*> used = used_of(views);
  for (std::size_t i = 0; i < used.size(); ++i) {
    Points points = points_of(*used[i], board);
    fitted.push_back({std::move(points.on_board), std::move(points.in_picture), solution.turns[i],
                      solution.shifts[i]});
  }
  return shape_of_print(fitted, solution.matrix, solution.distortion);
}

double rms_px(std::vector<View>& views) {
  double sum = 0, n = 0;
  for (const View* view : used_of(views)) {
    const auto weight = static_cast<double>(view->result.n_tags);
    sum += weight * view->result.reprojection_px * view->result.reprojection_px;
    n += weight;
  }
  return std::sqrt(sum / n);
}

// The camera with the views that it was found from.
struct Solved {
  Intrinsics camera;
  Solution solution;
  std::vector<View> views;
};

Solved solved(const MarkerBody& board, const std::vector<Image>& pictures,
              const std::vector<std::string>& names, const Intrinsics& guess) {
  Solved result{guess, {}, views_of(board, pictures, names, guess)};
  do {
    result.solution = solve_with_bias(result.views, board, guess);
  } while (reject_outliers(result.views));
  result.camera = intrinsics_of(result.solution, guess);
  return result;
}
}  // namespace

Intrinsics guessed_camera(int width_px, int height_px) {
  const double focal_px = width_px / (2 * std::tan(M_PI / 6));
  return {width_px, height_px, focal_px, focal_px, (width_px - 1) / 2.0, (height_px - 1) / 2.0, {}};
}

std::optional<Pose> rough_pose(const MarkerBody& board, const Intrinsics& camera,
                               const TagView& view) {
  const Points points = points_of({view, {}}, board);
  cv::Vec3d turn, shift;
  if (points.on_board.size() < 4 * least_tags_of_a_view ||
      !cv::solvePnP(points.on_board, points.in_picture, matrix_of(camera), cv::noArray(), turn,
                    shift))
    return std::nullopt;
  return pose_from(turn, shift);
}

CameraCalibration calibrate_camera(const MarkerBody& board, const std::vector<Image>& pictures,
                                   const std::vector<std::string>& names) {
  if (pictures.empty()) throw Error("there are no pictures of the board to calibrate from");
  CameraCalibration result;
  const Intrinsics guess = guessed_camera(pictures[0].width, pictures[0].height);
  // The second round knows the lens's bending of edges.
  Solved best = solved(board, pictures, names, solved(board, pictures, names, guess).camera);
  result.tags = print_of_tags(board, best.camera, pictures);
  // As above: each round leaves a small part of the excess.
  MarkerBody printed = board;
  for (int round = 0; round < excess_rounds && result.tags.is_off(); ++round) {
    printed = with_scaled_tags(board, 1 + result.tags.excess);
    best = solved(printed, pictures, names, best.camera);
    const double before = result.tags.excess;
    result.tags = print_of_tags(printed, best.camera, pictures);
    result.tags.excess = (1 + before) * (1 + result.tags.excess) - 1;
  }
  const Solution& solution = best.solution;
  std::vector<View>& views = best.views;
  result.camera = best.camera;
  result.focal_sd_px = solution.focal_sd_px;
  result.center_sd_px = solution.center_sd_px;
  result.rms_px = rms_px(views);
  if (is_flat(board)) result.print = print_of(views, printed, solution);
  for (const View& view : views) {
    result.views.push_back(view.result);
    if (view.result.used)
      result.coverage.add(view.tags, result.camera.width_px, result.camera.height_px);
  }
  return result;
}

}  // namespace heft
