#include "tracking/PoseColumns.h"

#include <fmt/format.h>

namespace heft {

namespace {
std::string cells(const std::optional<Pose>& pose) {
  if (!pose) return std::string(6, ',');
  const auto& p = pose->position_m;
  const auto& q = pose->orientation;
  return fmt::format("{},{},{},{},{},{},{}", p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
}
}  // namespace

std::string pose_cells(const std::optional<Pose>& board_from_effector,
                       const std::optional<Pose>& camera_from_board) {
  return cells(board_from_effector) + "," + cells(camera_from_board);
}

}  // namespace heft
