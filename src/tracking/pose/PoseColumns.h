// Poses as CSV, for `heft track` and for recordings of a synthetic camera, with equal columns to
// compare them.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>

#include "base/PoseTypes.h"

namespace heft {

/// The effector's center in the board's frame, then the board in the camera's frame.
inline constexpr std::string_view pose_columns =
    "x_m,y_m,z_m,qw,qx,qy,qz,camera_x_m,camera_y_m,camera_z_m,camera_qw,camera_qx,camera_qy,"
    "camera_qz";

/// Cells of a pose: shortest digits that read back as the same doubles; empty for none.
inline std::string pose_cells(const std::optional<Pose>& pose) {
  if (!pose) return std::string(6, ',');
  const auto& p = pose->position_m;
  const auto& q = pose->orientation;
  return fmt::format("{},{},{},{},{},{},{}", p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
}

inline std::string pose_cells(const std::optional<Pose>& board_from_effector,
                              const std::optional<Pose>& camera_from_board) {
  return pose_cells(board_from_effector) + "," + pose_cells(camera_from_board);
}

}  // namespace heft
