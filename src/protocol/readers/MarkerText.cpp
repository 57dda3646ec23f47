// Descriptions and files of marker bodies.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "base/Error.h"
#include "base/Names.h"
#include "base/files/TextFile.h"
#include "protocol/readers/Files.h"
#include "tracking/detection/MarkerBody.h"

namespace heft {

namespace {
std::vector<int> sorted_ids(const MarkerBody& body) {
  std::vector<int> ids;
  for (const Tag& tag : body.tags) ids.push_back(tag.id);
  std::ranges::sort(ids);
  return ids;
}

// "0-23" without gaps, else "0, 1, 5".
std::string ids_in_words(const std::vector<int>& ids) {
  const bool gapless = ids.back() - ids.front() + 1 == static_cast<int>(ids.size());
  if (gapless && ids.size() > 2) return fmt::format("{}-{}", ids.front(), ids.back());
  return fmt::format("{}", fmt::join(ids, ", "));
}

std::string sides_in_words(const MarkerBody& body) {
  double smallest_m = 1e9, largest_m = 0;
  for (const Tag& tag : body.tags) {
    const double side_m = (tag.corners_m[1] - tag.corners_m[0]).norm();
    smallest_m = std::min(smallest_m, side_m);
    largest_m = std::max(largest_m, side_m);
  }
  const std::string from = fmt::format("{:.4g}", smallest_m * 1e3);
  const std::string to = fmt::format("{:.4g}", largest_m * 1e3);
  return from == to ? from + " mm" : fmt::format("{}-{} mm", from, to);
}

// The extent of the tags along each axis, or an effector's size.
std::string extent_in_words(const MarkerBody& body) {
  Eigen::AlignedBox3d box;
  for (const Tag& tag : body.tags)
    for (const Eigen::Vector3d& corner_m : tag.corners_m) box.extend(corner_m);
  if (!body.size_m.isZero()) {
    const Eigen::Vector3d mm = body.size_m * 1e3;
    const std::string size = fmt::format("{:.4g} x {:.4g} x {:.4g} mm", mm.x(), mm.y(), mm.z());
    if (body.chamfer_m <= 0) return "a box of " + size;
    return fmt::format("a box of {}, its upper edges cut by {:.4g} mm", size, body.chamfer_m * 1e3);
  }
  const Eigen::Vector3d mm = box.sizes() * 1e3;
  return fmt::format("over {:.4g} x {:.4g} mm", mm.x(), mm.y());
}

std::string ruler_in_words(const MarkerBody& body) {
  if (!body.measured_ruler_m) return "ruler not measured yet";
  const std::string along = fmt::format("ruler measured: {:.6g}", *body.measured_ruler_m * 1e3);
  if (!body.measured_across_m) return along + " mm";
  return fmt::format("{} x {:.6g} mm", along, *body.measured_across_m * 1e3);
}

std::string as_row(const Eigen::Vector3d& v) {
  return fmt::format("[{:.9f}, {:.9f}, {:.9f}]", v.x(), v.y(), v.z());
}
}  // namespace

std::string described(const MarkerBody& body) {
  const std::vector<int> ids = sorted_ids(body);
  return fmt::format("{} of {}, {}, {} {}, {}, {}", counted(std::ssize(ids), "tag"), body.family,
                     sides_in_words(body), ids.size() == 1 ? "id" : "ids", ids_in_words(ids),
                     extent_in_words(body), ruler_in_words(body));
}

void require_different_tags(const MarkerBody& board, const MarkerBody& effector) {
  if (board.family != effector.family) return;
  const std::vector<int> ids = sorted_ids(board), others = sorted_ids(effector);
  std::vector<int> both;
  std::ranges::set_intersection(ids, others, std::back_inserter(both));
  if (!both.empty())
    throw Error(fmt::format("the board and the effector both have tag {} of {}; give one of them "
                            "other ids and print it again",
                            fmt::join(both, ", "), board.family),
                ExitCode::invalid_file);
}

std::string effector_to_toml(const MarkerBody& effector, const std::string& comment) {
  const MarkerBody designed = as_designed(effector);
  std::string text;
  for (const std::string_view line : lines_of(comment))
    text += line.empty() ? "#\n" : fmt::format("# {}\n", line);
  text += fmt::format("family = \"{}\"\n", effector.family);
  text += fmt::format("size_m = {}\n", as_row(designed.size_m));
  if (designed.chamfer_m > 0) text += fmt::format("chamfer_m = {:.9f}\n", designed.chamfer_m);
  if (effector.measured_across_m)
    text += fmt::format("ruler_measured_m = [{}, {}]\n", *effector.measured_ruler_m,
                        *effector.measured_across_m);
  else if (effector.measured_ruler_m)
    text += fmt::format("ruler_measured_m = {}\n", *effector.measured_ruler_m);
  for (const Tag& tag : designed.tags) {
    text += fmt::format("\n[[tag]]\nid = {}\ncorners_m = [\n", tag.id);
    for (const Eigen::Vector3d& corner_m : tag.corners_m)
      text += fmt::format("  {},\n", as_row(corner_m));
    text += "]\n";
  }
  return text;
}

}  // namespace heft
