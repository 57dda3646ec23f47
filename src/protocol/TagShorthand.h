// The tables [grid] and [box] that stand for many tags.
#pragma once

#include <vector>

#include "protocol/TagChecks.h"

namespace heft {

/// A grid around the board's center: columns, rows, tag_m, pitch_m, first_id (0), counted row by
/// row from the far left.
std::vector<Tag> read_grid(TableReader& table, const std::string& family);

/// Tags at the tip's end of a box, in the middle of its faces' width: tag_m, tip_margin_m (from
/// the tip's edge; as little as the family allows), and an id for each face that has a tag.
std::vector<PlacedTag> read_box(TableReader& table, const std::string& family,
                                const Eigen::Vector3d& size_m);

}  // namespace heft
