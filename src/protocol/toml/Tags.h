// The tags of board and effector files: the tables [grid] and [box], which stand for many tags, and
// the check that a tag is a square with a code of its family.
#pragma once

#include <string>
#include <vector>

#include "protocol/toml/TableReader.h"
#include "tracking/pose/MarkerBody.h"

namespace heft {

/// A longer side is probably in another unit.
inline constexpr double largest_tag_m = 2;

/// A tag and its table: a [[tag]] or a shorthand.
struct PlacedTag {
  Tag tag;
  TableReader table;
  std::string id_key;
};

/// Reports corners, at corners_m, that do not form a square.
void check_square(PlacedTag& placed);

/// Reports a tag that faces the body's center: its corners are in reverse order.
void check_outwards(PlacedTag& placed);

/// Reports a board's tag whose corners are in reverse order: it would be on the board's back.
void check_upwards(PlacedTag& placed);

/// Reports ids that the family lacks, and repeated ones.
void check_ids(std::vector<PlacedTag>& tags, const std::string& family);

/// A grid around the board's center: columns, rows, tag_m, pitch_m, first_id (0), counted row by
/// row from the far left.
std::vector<Tag> read_grid(TableReader& table, const std::string& family);

/// Tags at the tip of a box, in the middle of its faces: tag_m, tip_margin_m (from the tip's edge;
/// by default the family's minimum), and an id for each face with a tag.
std::vector<PlacedTag> read_box(TableReader& table, const std::string& family,
                                const BoxShape& shape);

}  // namespace heft
