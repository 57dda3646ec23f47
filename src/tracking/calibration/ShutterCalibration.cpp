#include "tracking/calibration/ShutterCalibration.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/Error.h"
#include "base/Pose.h"
#include "base/math/LevenbergMarquardt.h"
#include "base/math/Quantiles.h"
#include "tracking/calibration/CameraCalibration.h"

namespace heft {

namespace {
// The pose (a rotation about the camera's axes, a shift) and the read-out.
using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

constexpr double corner_sd_px = 0.1;
constexpr int rounds = 8;

struct Placed {
  const TimedView* seen;
  Pose pose;  ///< camera from board, when the first row was read
  std::optional<Velocity> velocity;
};

struct Equations {
  Matrix7 matrix = Matrix7::Zero();
  Vector7 rhs = Vector7::Zero();
  double sum_squares_px2 = 0;
  int n = 0;
};

void add_corner(Equations& equations, const Placed& at, const Intrinsics& camera,
                const Eigen::Vector3d& corner_m, const Eigen::Vector2d& pixel, double readout_s) {
  const double fraction = pixel.y() / camera.height_px;
  const Velocity velocity = at.velocity.value_or(Velocity{});
  const Eigen::Vector3d arm = at.pose.orientation * corner_m;
  const Eigen::Vector3d moves = velocity.linear_m_s + velocity.angular_rad_s.cross(arm);
  const Eigen::Vector3d p = at.pose.position_m + arm + readout_s * fraction * moves;
  if (!(p.z() > 0.01)) return;
  const auto [projected, by_point] = project_with_derivative(camera, p);
  Eigen::Matrix<double, 2, 7> by;
  by << -by_point * cross_matrix(arm), by_point, fraction * by_point * moves;
  const Eigen::Vector2d residual = pixel - projected;
  const double weight =
      huber(residual.norm() / corner_sd_px).weight / (corner_sd_px * corner_sd_px);
  equations.matrix.noalias() += weight * by.transpose() * by;
  equations.rhs.noalias() += weight * by.transpose() * residual;
  equations.sum_squares_px2 += residual.squaredNorm();
  equations.n += 2;
}

Equations equations_of(const Placed& at, const MarkerBody& board, const Intrinsics& camera,
                       double readout_s) {
  Equations equations;
  for (const SeenTag& tag : at.seen->view.tags)
    for (std::size_t i = 0; i < 4; ++i)
      add_corner(equations, at, camera, board.tags[tag.tag].corners_m[i], tag.corners_px[i],
                 readout_s);
  return equations;
}

void move(Pose& pose, const Eigen::Matrix<double, 6, 1>& step) {
  pose.orientation = (rotation_from_vector(step.head<3>()) * pose.orientation).normalized();
  pose.position_m += step.tail<3>();
}

std::vector<Placed> placed(const MarkerBody& board, const Intrinsics& camera,
                           const std::vector<TimedView>& views) {
  std::vector<Placed> all;
  for (const TimedView& seen : views) {
    const auto pose = rough_pose(board, camera, seen.view);
    if (!pose) continue;
    all.push_back({&seen, *pose, std::nullopt});
    for (int i = 0; i < 10; ++i) {  // without a rolling shutter
      const Equations equations = equations_of(all.back(), board, camera, 0);
      move(all.back().pose,
           equations.matrix.topLeftCorner<6, 6>().ldlt().solve(equations.rhs.head<6>()));
    }
  }
  return all;
}

double unsteadiness_of(const std::vector<Placed>& all) {
  std::vector<double> changes;
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    if (!all[i].velocity) continue;
    const auto mean_m_s = [&](const Placed& from, const Placed& to) {
      return mean_velocity(from.pose, to.pose, to.seen->t_s - from.seen->t_s).linear_m_s;
    };
    const Eigen::Vector3d before_m_s = mean_m_s(all[i - 1], all[i]);
    const Eigen::Vector3d after_m_s = mean_m_s(all[i], all[i + 1]);
    const double sum_m_s = before_m_s.norm() + after_m_s.norm();
    if (sum_m_s > 0) changes.push_back((after_m_s - before_m_s).norm() / sum_m_s);
  }
  return quantile(changes, 0.5).value_or(0);
}

void find_velocities(std::vector<Placed>& all) {
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    const double before_s = all[i].seen->t_s - all[i - 1].seen->t_s;
    const double after_s = all[i + 1].seen->t_s - all[i].seen->t_s;
    if (std::max(before_s, after_s) > longest_between_s || !(std::min(before_s, after_s) > 0))
      continue;
    all[i].velocity = mean_velocity(all[i - 1].pose, all[i + 1].pose, before_s + after_s);
  }
}
}  // namespace

ShutterCalibration calibrate_shutter(const MarkerBody& board, const Intrinsics& camera,
                                     const std::vector<TimedView>& views) {
  std::vector<Placed> all = placed(board, camera, views);
  ShutterCalibration result;
  std::vector<double> speeds_m_s;
  for (int round = 0; round < rounds; ++round) {
    find_velocities(all);
    double information = 0, rhs = 0, sum_px2 = 0;
    int n = 0;
    for (Placed& at : all) {
      const Equations equations = equations_of(at, board, camera, result.readout_s);
      const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> own(equations.matrix.topLeftCorner<6, 6>());
      const Eigen::Matrix<double, 6, 1> mixed = equations.matrix.topRightCorner<6, 1>();
      if (at.velocity) {
        information += equations.matrix(6, 6) - mixed.dot(own.solve(mixed));
        rhs += equations.rhs(6) - mixed.dot(own.solve(equations.rhs.head<6>()));
        sum_px2 += equations.sum_squares_px2;
        n += equations.n;
      }
      move(at.pose, own.solve(equations.rhs.head<6>()));
    }
    if (n == 0)
      throw Error(fmt::format(
          "no picture of the board has one within {:.0f} ms before and after it; film at 15 "
          "pictures a second or more, the whole board in view",
          1e3 * longest_between_s));
    result.rms_px = std::sqrt(sum_px2 / n);
    if (!(information > 0)) continue;
    result.readout_s += rhs / information;
    result.sd_s = std::max(result.rms_px / corner_sd_px, 1.0) / std::sqrt(information);
  }
  for (const Placed& at : all)
    if (at.velocity) speeds_m_s.push_back(at.velocity->linear_m_s.norm());
  result.unsteadiness = unsteadiness_of(all);
  std::ranges::sort(speeds_m_s);
  result.n_pictures = speeds_m_s.size();
  result.fastest_m_s = speeds_m_s[speeds_m_s.size() * 9 / 10];
  return result;
}

std::vector<std::string> doubts(const ShutterCalibration& calibration) {
  constexpr double most_sd_s = 0.0005, longest_s = 0.05, most_unsteadiness = 0.5;
  std::vector<std::string> found;
  if (calibration.n_pictures < enough_waved_pictures / 2)
    found.push_back(fmt::format("only {} pictures of a moving board; wave it for several seconds",
                                calibration.n_pictures));
  if (calibration.unsteadiness > most_unsteadiness)
    found.emplace_back(
        "the board jumps from picture to picture instead of moving: the pictures are still "
        "views, or their times are wrong; film the board while you wave it");
  if (!(calibration.sd_s < most_sd_s))
    found.push_back(fmt::format(
        "the read-out has a standard error of {:.1f} ms; wave the board faster, to and fro and up "
        "and down, in more light",
        1e3 * calibration.sd_s));
  if (calibration.readout_s < -2 * calibration.sd_s - most_sd_s ||
      calibration.readout_s > longest_s)
    found.emplace_back(
        "no shutter has such a read-out time; check that the pictures' times are the camera's, and "
        "that the board is flat");
  return found;
}

double half_millimeter_m_s(double readout_s) {
  constexpr double rows_of_the_effector = 0.1;  // as a fraction of the picture's
  return 0.0005 / (rows_of_the_effector * readout_s);
}

std::string summary(const ShutterCalibration& calibration) {
  std::string text = fmt::format(
      "read-out {:.1f} ms from the first row to the last, sd {:.2f} ms, from {} pictures of a "
      "board that moved at up to {:.2f} m/s; corners {:.2f} px off\n",
      1e3 * calibration.readout_s, 1e3 * calibration.sd_s, calibration.n_pictures,
      calibration.fastest_m_s, calibration.rms_px);
  if (calibration.readout_s > 0.001)
    text += fmt::format("uncorrected, the error would be half a millimeter at {:.2f} m/s\n",
                        half_millimeter_m_s(calibration.readout_s));
  const auto all = doubts(calibration);
  for (const std::string& doubt : all) text += "doubtful: " + doubt + "\n";
  return text + (all.empty() ? "verdict: good\n" : "verdict: doubtful\n");
}

}  // namespace heft
