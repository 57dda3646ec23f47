#include "protocol/TagChecks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tracking/MarkerBody.h"
#include "tracking/TagFamily.h"

namespace heft {

namespace {
// Of a side. Measured by hand a corner may be off by a millimeter; a typing slip is far more.
constexpr double tolerance = 0.05;

const std::string corners = "corners_m";

// What makes the corners no square; empty where they are one.
std::string flaw(const std::array<Eigen::Vector3d, 4>& c) {
  const std::array sides_m{(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[3] - c[2]).norm(),
                           (c[0] - c[3]).norm()};
  const auto [shortest, longest] = std::ranges::minmax(sides_m);
  if (shortest <= 0) return "has a side of length 0";
  if (longest > largest_tag_m)
    return fmt::format("has a side of {:.6g} m; are these millimeters?", longest);
  if (longest > shortest * (1 + tolerance))
    return fmt::format("has sides of {:.6g} to {:.6g} m", shortest, longest);
  const Eigen::Vector3d a = c[2] - c[0], b = c[3] - c[1];  // diagonals
  if (std::abs(a.norm() - b.norm()) > tolerance * longest)
    return fmt::format("has diagonals of {:.6g} and {:.6g} m", a.norm(), b.norm());
  const Eigen::Vector3d gap = (c[0] + c[2] - c[1] - c[3]) / 2;  // between the diagonals' middles
  if (gap.norm() > tolerance * longest)
    return fmt::format("has a corner {:.6g} m out of place", gap.norm() * 2);
  return "";
}
}  // namespace

void check_square(PlacedTag& placed) {
  if (!placed.table.good({corners})) return;
  const std::string found = flaw(placed.tag.corners_m);
  if (!found.empty())
    placed.table.mistake(
        corners, fmt::format("tag {} {}, expected a flat square: top left, top right, bottom "
                             "right, bottom left corner of the upright tag, in meters",
                             placed.tag.id, found));
}

void check_outwards(PlacedTag& placed) {
  if (!placed.table.good({corners})) return;
  if (tag_normal(placed.tag).dot(tag_center_m(placed.tag)) <= 0)
    placed.table.mistake(
        corners, fmt::format("tag {} faces the effector's center; expected its corners clockwise "
                             "as seen from outside, from the upright tag's top left",
                             placed.tag.id));
}

void check_upwards(PlacedTag& placed) {
  if (!placed.table.good({corners})) return;
  if (tag_normal(placed.tag).z() <= 0)
    placed.table.mistake(
        corners, fmt::format("tag {} faces down; expected its corners clockwise as seen from above "
                             "the board, from the upright tag's top left",
                             placed.tag.id));
}

void check_ids(std::vector<PlacedTag>& tags, const std::string& family) {
  const int n_codes = n_tags_of(family);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    auto& [tag, table, key] = tags[i];
    if (!table.good({key})) continue;
    if (tag.id >= n_codes)
      table.mistake(key, fmt::format("{} is {}, expected an id of {}: 0 to {}", key, tag.id, family,
                                     n_codes - 1));
    const auto same = [&, id = tag.id](const PlacedTag& other) {
      return other.tag.id == id && other.table.good({other.id_key});
    };
    if (std::any_of(tags.begin(), tags.begin() + static_cast<std::ptrdiff_t>(i), same))
      table.mistake(key, fmt::format("tag {} is there twice, expected each id once", tag.id));
  }
}

}  // namespace heft
