// Board and effector files: their tags as [[tag]] or by the shorthands [grid] and [box].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/files/TextFile.h"
#include "protocol/readers/Files.h"
#include "protocol/toml/TableReader.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/detection/TagFamily.h"

namespace heft {

namespace {
// A longer side is probably in another unit.
constexpr double largest_tag_m = 2;

// A tag and its table: a [[tag]] or a shorthand.
struct PlacedTag {
  Tag tag;
  TableReader table;
  std::string id_key;
};

// Relative to a side. Manual measurements are within a millimeter; typing errors are far larger.
constexpr double tolerance = 0.05;

const std::string corners = "corners_m";

// The deviation of corners from a square; empty for a square.
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

constexpr double grid_tolerance_m = 1e-6;  ///< rounding in a hand-written file
constexpr Range tag_side_m{0, largest_tag_m, true};

struct Grid {
  int columns = 1, rows = 1, first_id = 0;
  double tag_m = 0, pitch_m = 0;
  int last_id() const { return first_id + columns * rows - 1; }
};

// Whether the part of a print beyond the detected corners is white, not code.
bool has_white_margin(const TagPattern& print) {
  for (int i = 0; i < print.n_cells; ++i)
    if (!print.is_white(i, 0)) return false;
  return true;
}

void check_pitch(TableReader& table, const Grid& grid, const TagPattern& print) {
  if (!table.good({"tag_m", "pitch_m"})) return;
  const bool shared = has_white_margin(print);  // neighbors can share white, but not code
  const double gap_m = print.margin_m(grid.tag_m) * (shared ? 1 : 2);
  if (grid.pitch_m < grid.tag_m + gap_m - grid_tolerance_m)
    table.mistake("pitch_m",
                  fmt::format("pitch_m is {:.6g}, expected at least {:.6g}: tag_m and {:.6g} m of "
                              "{} between two tags",
                              grid.pitch_m, grid.tag_m + gap_m, gap_m, shared ? "white" : "code"));
}

void check_grid_ids(TableReader& table, const Grid& grid, const std::string& family, int n_codes) {
  if (table.good({"columns", "rows", "first_id"}) && grid.last_id() >= n_codes)
    table.mistake(table.has("first_id") ? "first_id" : "columns",
                  fmt::format("the grid needs the ids {} to {}, but {} has only 0 to {}",
                              grid.first_id, grid.last_id(), family, n_codes - 1));
}

std::vector<Tag> tags_of(const Grid& grid) {
  const FaceFrame board{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                        Eigen::Vector2d::Zero()};
  std::vector<Tag> tags;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Vector2d cells(column - (grid.columns - 1) / 2.0, (grid.rows - 1) / 2.0 - row);
      const int id = grid.first_id + static_cast<int>(tags.size());
      tags.push_back(tag_on(board, id, cells * grid.pitch_m, grid.tag_m));
    }
  return tags;
}

struct Box {
  double tag_m = 0, tip_margin_m = 0;
};

Tag tag_of(const Box& box, BoxFace face, const FaceFrame& frame, int id) {
  const bool is_end = face == BoxFace::tip || face == BoxFace::back;
  const double up_m = is_end ? 0 : frame.size_m.y() / 2 - box.tip_margin_m - box.tag_m / 2;
  return tag_on(frame, id, {0, up_m}, box.tag_m);
}

// The corners of the white margin must be on the face, too.
bool fits(const Tag& tag, const FaceFrame& face, double white_m) {
  const Eigen::Vector2d center_m = face.flat(tag_center_m(tag));
  for (const Eigen::Vector3d& corner_m : tag.corners_m) {
    const Eigen::Vector2d out_m = face.flat(corner_m) - center_m;
    const Eigen::Vector2d white_corner_m = center_m + out_m + white_m * out_m.cwiseSign();
    if (face.inside_m(white_corner_m) < -grid_tolerance_m) return false;
  }
  return true;
}

void check_fits(TableReader& table, const std::string& face_name, const Tag& tag,
                const FaceFrame& face, double white_m) {
  if (table.good({"tag_m", "tip_margin_m", face_name}) && !fits(tag, face, white_m))
    table.mistake(face_name,
                  fmt::format("the {} face of {:.6g} x {:.6g} m has no room for its tag with "
                              "{:.6g} m of white around it; make tag_m or tip_margin_m fit",
                              face_name, face.size_m.x(), face.size_m.y(), white_m));
}

// Reports corners, at corners_m, that do not form a square.
void check_square(PlacedTag& placed) {
  if (!placed.table.good({corners})) return;
  const std::string found = flaw(placed.tag.corners_m);
  if (!found.empty())
    placed.table.mistake(
        corners, fmt::format("tag {} {}, expected a flat square: top left, top right, bottom "
                             "right, bottom left corner of the upright tag, in meters",
                             placed.tag.id, found));
}

// Reports corners in reverse order, which put a tag on the wrong side of the paper.
void check_front(PlacedTag& placed, bool is_visible, std::string_view faces,
                 std::string_view seen_from) {
  if (placed.table.good({corners}) && !is_visible)
    placed.table.mistake(corners,
                         fmt::format("tag {} faces {}; expected its corners clockwise as seen from "
                                     "{}, from the upright tag's top left",
                                     placed.tag.id, faces, seen_from));
}

// Reports ids that the family lacks, and repeated ones.
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
      table.mistake(key, fmt::format("tag {} is listed twice, expected each id once", tag.id));
  }
}

// A grid around the board's center: columns, rows, tag_m, pitch_m, first_id (0), counted row by
// row from the far left.
std::vector<Tag> read_grid(TableReader& table, const std::string& family) {
  Grid grid;
  const int n_codes = n_tags_of(family);
  const WholeRange across{1, 1000};
  table.require({"columns", "rows", "tag_m", "pitch_m"});
  table.read("columns", grid.columns, across);
  table.read("rows", grid.rows, across);
  table.read("tag_m", grid.tag_m, tag_side_m);
  table.read("pitch_m", grid.pitch_m, tag_side_m);
  table.read("first_id", grid.first_id, WholeRange{0, n_codes - 1});
  table.close();
  check_pitch(table, grid, tag_pattern(family, 0));
  check_grid_ids(table, grid, family, n_codes);
  return tags_of(grid);
}

// Tags at the tip of a box, in the middle of its faces: tag_m, tip_margin_m (from the tip's edge;
// by default the family's minimum), and an id for each face with a tag.
std::vector<PlacedTag> read_box(TableReader& table, const std::string& family,
                                const BoxShape& shape) {
  Box box;
  table.require({"tag_m"});
  table.read("tag_m", box.tag_m, tag_side_m);
  const double white_m = tag_pattern(family, 0).margin_m(box.tag_m);
  box.tip_margin_m = white_m;
  table.read("tip_margin_m", box.tip_margin_m, zero_or_more);
  std::vector<PlacedTag> tags;
  for (const BoxFace face : faces_of(shape)) {
    const std::string key(name_of(face));
    const FaceFrame frame = face_frame(shape, face);
    int id = 0;
    table.read(key, id, WholeRange{});
    if (!table.has(key) || !table.good({key})) continue;
    const Tag tag = tag_of(box, face, frame, id);
    check_fits(table, key, tag, frame, white_m);
    tags.push_back({tag, table, key});
  }
  table.close();
  if (tags.empty() &&
      table.good({"tip", "top", "left", "right", "bottom", "back", "upper_left", "upper_right"}))
    table.mistake("tip",
                  "[box] has no face, expected at least one with its tag's id, such as "
                  "tip = 30");
  return tags;
}

constexpr Range plausible_ruler_m{0.12, 0.18};

std::vector<PlacedTag> read_tags(TableReader& reader) {
  std::vector<PlacedTag> tags;
  for (TableReader& table : reader.tables("tag")) {
    PlacedTag& placed = tags.emplace_back(PlacedTag{{}, std::move(table), "id"});
    placed.table.require({"id", "corners_m"});
    placed.table.read("id", placed.tag.id, WholeRange{});
    placed.table.read("corners_m", placed.tag.corners_m);
    placed.table.close();
    check_square(placed);
  }
  return tags;
}

void append(std::vector<Tag>& tags, const std::vector<PlacedTag>& placed) {
  for (const PlacedTag& one : placed) tags.push_back(one.tag);
}

// Called after close(), which reports a misspelled table.
void check_placed_once(TableReader& reader, const std::string& shorthand) {
  if (reader.has(shorthand) && reader.has("tag"))
    reader.mistake(
        "tag", fmt::format("the file has [{}] and [[tag]], expected only one of them", shorthand));
  else if (!reader.has(shorthand) && !reader.has("tag") && reader.good({shorthand, "tag"}))
    reader.mistake(shorthand,
                   fmt::format("the file places no tags, expected [{}] or [[tag]]", shorthand));
}

void read_family(TableReader& reader, MarkerBody& body) {
  if (const auto family = reader.read_name("family", tag_family_names())) body.family = *family;
}

// One length for both rulers, or [across, down].
void read_ruler(TableReader& reader, MarkerBody& body) {
  if (!reader.is_list("ruler_measured_m"))
    return reader.read("ruler_measured_m", body.measured_ruler_m, plausible_ruler_m);
  Eigen::Vector2d both_m(ruler_m, ruler_m);
  reader.read("ruler_measured_m", both_m, plausible_ruler_m);
  body.measured_ruler_m = both_m.x();
  body.measured_across_m = both_m.y();
}

// The cut-off upper edges must leave some of the top and of the sides.
void read_chamfer(TableReader& reader, MarkerBody& body) {
  reader.read("chamfer_m", body.chamfer_m, zero_or_more);
  if (!reader.good({"size_m", "chamfer_m"})) return;
  const double most_m = std::min(body.size_m.y() / 2, body.size_m.z());
  if (body.chamfer_m < most_m) return;
  reader.mistake("chamfer_m",
                 fmt::format("chamfer_m is {:.6g}, expected less than {:.6g}: half the "
                             "width, and the height, in size_m",
                             body.chamfer_m, most_m));
  body.chamfer_m = 0;
}
}  // namespace

MarkerBody parse_board(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  const TomlTable root = parse_toml(text, file);
  TableReader reader(root, mistakes);
  MarkerBody board;
  read_family(reader, board);
  read_ruler(reader, board);
  if (auto grid = reader.table("grid")) board.tags = read_grid(*grid, board.family);
  std::vector<PlacedTag> tags = read_tags(reader);
  for (PlacedTag& placed : tags)
    check_front(placed, tag_normal(placed.tag).z() > 0, "down", "above the board");
  reader.close();
  check_placed_once(reader, "grid");
  check_ids(tags, board.family);
  mistakes.throw_if_any();
  append(board.tags, tags);
  return as_printed(board);
}

MarkerBody parse_effector(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  const TomlTable root = parse_toml(text, file);
  TableReader reader(root, mistakes);
  MarkerBody effector;
  effector.size_m.setConstant(1);  // after a mistake in it, no other is reported
  read_family(reader, effector);
  read_ruler(reader, effector);
  reader.require({"size_m"});
  reader.read("size_m", effector.size_m, above_zero);
  read_chamfer(reader, effector);
  std::vector<PlacedTag> tags = read_tags(reader);
  for (PlacedTag& placed : tags)
    check_front(placed, tag_normal(placed.tag).dot(tag_center_m(placed.tag)) > 0,
                "the effector's center", "outside");
  if (auto box = reader.table("box"))
    std::ranges::move(read_box(*box, effector.family, effector.box()), std::back_inserter(tags));
  reader.close();
  check_placed_once(reader, "box");
  check_ids(tags, effector.family);
  mistakes.throw_if_any();
  append(effector.tags, tags);
  return as_printed(effector);
}

MarkerBody load_board(const std::string& path) {
  return parse_board(read_text_file(path), path);
}

MarkerBody load_effector(const std::string& path) {
  return parse_effector(read_text_file(path), path);
}

}  // namespace heft
