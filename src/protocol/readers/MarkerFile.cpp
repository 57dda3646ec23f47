#include <fmt/format.h>

#include <algorithm>

#include "base/files/TextFile.h"
#include "protocol/readers/Files.h"
#include "protocol/toml/Tags.h"
#include "tracking/detection/TagFamily.h"
#include "tracking/pose/MarkerBody.h"

namespace heft {

namespace {
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

// Called after the file was closed, when a misspelled table has been reported.
void check_placed_once(TableReader& reader, const std::string& shorthand) {
  if (reader.has(shorthand) && reader.has("tag"))
    reader.mistake(
        "tag", fmt::format("the file has [{}] and [[tag]], expected only one of them", shorthand));
  else if (!reader.has(shorthand) && !reader.has("tag") && reader.good({shorthand, "tag"}))
    reader.mistake(shorthand,
                   fmt::format("the file places no tags, expected [{}] or [[tag]]", shorthand));
}

void read_common(TableReader& reader, MarkerBody& body) {
  if (const auto family = reader.read_name("family", tag_family_names())) body.family = *family;
}

// One length for both rulers, or one each: across the sheet, and down it.
void read_ruler(TableReader& reader, MarkerBody& body) {
  if (!reader.is_list("ruler_measured_m"))
    return reader.read("ruler_measured_m", body.measured_ruler_m, plausible_ruler_m);
  Eigen::Vector2d both_m(ruler_m, ruler_m);
  reader.read("ruler_measured_m", both_m, plausible_ruler_m);
  body.measured_ruler_m = both_m.x();
  body.measured_across_m = both_m.y();
}

// The upper long edges may be cut off as long as some of the top and of the sides remains.
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
  read_common(reader, board);
  read_ruler(reader, board);
  if (auto grid = reader.table("grid")) board.tags = read_grid(*grid, board.family);
  std::vector<PlacedTag> tags = read_tags(reader);
  std::ranges::for_each(tags, check_upwards);
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
  read_common(reader, effector);
  read_ruler(reader, effector);
  reader.require({"size_m"});
  reader.read("size_m", effector.size_m, above_zero);
  read_chamfer(reader, effector);
  std::vector<PlacedTag> tags = read_tags(reader);
  std::ranges::for_each(tags, check_outwards);
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
