// A recorded or made-up path of the effector's center, and the CSV files that hold one:
// t_s,x_m,y_m,z_m,qw,qx,qy,qz, one row a sample, times increasing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/PoseTypes.h"

namespace heft {

struct TrajectoryRow {
  double t_s = 0;
  std::optional<Pose> pose;  ///< absent: out of view from the row before until the row after
};

class Trajectory {
 public:
  /// @param rows at least one, times strictly increasing
  explicit Trajectory(std::vector<TrajectoryRow> rows) : rows_(std::move(rows)) {}

  double start_s() const { return rows_.front().t_s; }
  double end_s() const { return rows_.back().t_s; }

  /// Pose at a time: positions linearly, orientations by slerp between rows; the first or last
  /// row's outside. None where the effector is out of view.
  std::optional<Pose> at(double t_s) const;

  const std::vector<TrajectoryRow>& rows() const { return rows_; }

 private:
  std::vector<TrajectoryRow> rows_;
};

/// @throws InvalidFile naming every unusable row, its column and what was expected
Trajectory parse_trajectory(const std::string& text, const std::string& file);

/// @throws Error when the file can't be read, InvalidFile as parse_trajectory
Trajectory load_trajectory(const std::string& path);

}  // namespace heft
