// The tags of board and effector files: the tables [grid] and [box] that stand for many of them,
// and whether a tag, as a file gives it, can be one: a square of paper with a code of its family.
#pragma once

#include <string>
#include <vector>

#include "protocol/toml/TableReader.h"
#include "tracking/pose/MarkerBody.h"

namespace heft {

/// Sides beyond this are no printed tag but another unit.
inline constexpr double largest_tag_m = 2;

/// A tag and the table that it came from: a [[tag]] or a shorthand.
struct PlacedTag {
  Tag tag;
  TableReader table;
  std::string id_key;
};

/// Notes corners, at corners_m, that are no printed square.
void check_square(PlacedTag& placed);

/// Notes a tag whose front looks at the body's center: its corners go round the wrong way.
void check_outwards(PlacedTag& placed);

/// Notes a board's tag whose corners go round the wrong way: it would be printed on the board's
/// back.
void check_upwards(PlacedTag& placed);

/// Notes ids that the family does not have, and those given twice.
void check_ids(std::vector<PlacedTag>& tags, const std::string& family);

/// A grid around the board's center: columns, rows, tag_m, pitch_m, first_id (0), counted row by
/// row from the far left.
std::vector<Tag> read_grid(TableReader& table, const std::string& family);

/// Tags at the tip's end of a box, in the middle of its faces' width: tag_m, tip_margin_m (from
/// the tip's edge; as little as the family allows), and an id for each face that has a tag.
std::vector<PlacedTag> read_box(TableReader& table, const std::string& family,
                                const BoxShape& shape);

}  // namespace heft
