// A path of the effector's center, and the CSV files that hold one:
// t_s,x_m,y_m,z_m,qw,qx,qy,qz; one row per sample, times strictly increasing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/PoseTypes.h"

namespace heft {

struct TrajectoryRow {
  double t_s = 0;
  std::optional<Pose> pose;  ///< none: out of view between the neighboring rows
};

class Trajectory {
 public:
  /// @param rows at least one, times strictly increasing
  explicit Trajectory(std::vector<TrajectoryRow> rows) : rows_(std::move(rows)) {}

  double start_s() const { return rows_.front().t_s; }
  double end_s() const { return rows_.back().t_s; }

  /// Interpolates positions linearly and orientations by slerp; before the first and after the last
  /// row that row's pose. None while the effector is out of view.
  std::optional<Pose> at(double t_s) const;

  const std::vector<TrajectoryRow>& rows() const { return rows_; }

 private:
  std::vector<TrajectoryRow> rows_;
};

/// @throws InvalidFile naming each invalid row, its column and what was expected
Trajectory parse_trajectory(const std::string& text, const std::string& file);

/// @throws Error if the file cannot be read; InvalidFile as parse_trajectory
Trajectory load_trajectory(const std::string& path);

}  // namespace heft
