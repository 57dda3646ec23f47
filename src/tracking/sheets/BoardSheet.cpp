// The board's sheet.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/Error.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/sheets/PdfSheet.h"
#include "tracking/sheets/Sheet.h"

namespace heft {

namespace {
Eigen::AlignedBox2d extent_mm(const MarkerBody& board) {
  Eigen::AlignedBox2d box;
  for (const Tag& tag : board.tags)
    for (const Eigen::Vector3d& corner_m : tag.corners_m) box.extend(corner_m.head<2>() * 1000);
  return box;
}

void refuse_what_is_not_flat(const MarkerBody& board) {
  constexpr double tolerance_m = 1e-4;
  for (const Tag& tag : board.tags) {
    const auto off = [](const Eigen::Vector3d& corner_m) { return std::abs(corner_m.z()); };
    if (std::ranges::max(tag.corners_m, {}, off).cwiseAbs().z() > tolerance_m ||
        tag_normal(tag).z() < 0)
      throw Error(fmt::format("tag {} is not face up on the table (z = 0); a sheet can only "
                              "have tags that are",
                              tag.id),
                  ExitCode::invalid_file);
  }
}

double side_mm(const Tag& tag) {
  return (tag.corners_m[1] - tag.corners_m[0]).norm() * 1000;
}

// White or code around the outermost corners.
double margin_mm(const MarkerBody& board) {
  double margin = 0;
  for (const Tag& tag : board.tags)
    margin = std::max(margin, tag_pattern(board.family, tag.id).margin_m(side_mm(tag)));
  const bool code = tag_pattern(board.family, board.tags.front().id).margin_cells() > 1;
  return code ? margin + unprintable_mm : std::max(margin, unprintable_mm);
}

// Space for the detected corners of a board.
PointMm room_mm(const PointMm& paper, double margin) {
  return {paper.x() - 2 * margin, paper.y() - 2 * margin - ruler_strip_mm};
}

// Left edge of the tags on the sheet: centered, or beside a ruler down the sheet if there is space
// for it.
struct LeftEdge {
  double tags_mm = 0;
  bool has_ruler = false;
};

LeftEdge left_edge(const PointMm& size_mm, const PointMm& sheet_mm, double margin) {
  constexpr double narrow_ruler_mm = 2;
  const double free_mm = sheet_mm.x() - size_mm.x();
  const double beside_ruler_mm = unprintable_mm + narrow_ruler_mm + margin;
  if (free_mm - margin < beside_ruler_mm) return {free_mm / 2, false};
  return {std::max(beside_ruler_mm, free_mm / 2), true};
}

// Portrait or landscape; none if the board fits neither.
std::optional<PointMm> fitting(const PointMm& upright, const PointMm& size_mm, double margin) {
  for (const PointMm& paper : {PointMm(upright.y(), upright.x()), upright})
    if ((size_mm.array() <= room_mm(paper, margin).array()).all()) return paper;
  return std::nullopt;
}

PointMm chosen_paper(const MarkerBody& board, Paper paper) {
  const PointMm size = extent_mm(board).sizes(), upright = paper_mm(paper);
  if (const auto fits = fitting(upright, size, margin_mm(board))) return *fits;
  const PointMm room = room_mm({upright.y(), upright.x()}, margin_mm(board));
  throw Error(fmt::format(
      "the board's tags span {:.4g} x {:.4g} mm, but a sheet of {} has space for "
      "{:.4g} x {:.4g}; use other paper (--paper), or fewer or smaller tags (the installed "
      "protocols/apparatus/board_letter.toml fits US letter)",
      size.x(), size.y(), name_of(paper), std::floor(room.x()), std::floor(room.y())));
}

// Instructions for measuring down the sheet. @param height_mm between the outermost detected
// corners
std::string measured_down(bool has_ruler_down, double height_mm) {
  if (has_ruler_down)
    return "Printers stretch paper more in one direction, so measure the line at the left, too. "
           "If "
           "they differ, write both, the bottom one first:\n"
           "    ruler_measured_m = [0.1496, 0.1503]";
  return fmt::format(
      "Printers stretch paper more in one direction: from the top of the first row's black\n"
      "to the bottom of the last one's it should be {:.1f} mm. If it is 0.2 % more, write\n"
      "    ruler_measured_m = [0.1496, 0.1503]",
      height_mm);
}

std::array<std::string, 6> steps_for(const std::string& down) {
  return {
      "Print page 1 at 100 % (\"actual size\"), not \"fit to page\", on matte white paper.\n"
      "Glossy paper reflects lamps, and tags under a reflection are not detected.",
      "Measure the ruler line at the bottom of page 1 with a good ruler or calipers,\n"
      "between its first and its last tick, to a tenth of a millimeter. It should be 150.0 mm.",
      "Write the measured length into the board file, in meters, for example:\n"
      "    ruler_measured_m = 0.1496\n"
      "An error of half a percent moves the effector by about 2 mm.\n" +
          down,
      "Glue the sheet, without bubbles, to something flat and stiff: glass, an aluminum\n"
      "plate, a thick board. Keep the white around the tags; do not cut into it.",
      "Check the file, then calibrate the camera with the board in your hands:\n"
      "    heft validate BOARD.toml\n"
      "    heft calibrate camera --camera camera:0 --board BOARD.toml --out camera.yaml",
      "Lay the board in front of the participant, with the marked edge towards them, and fix\n"
      "it: neither the board nor the camera may move during a session."};
}
}  // namespace

void write_board_sheet(const MarkerBody& board, Paper paper, const std::string& path) {
  const MarkerBody designed = as_designed(board);
  refuse_what_is_not_flat(designed);
  const PointMm sheet_mm = chosen_paper(designed, paper);
  const Eigen::AlignedBox2d extent = extent_mm(designed);
  const double free_mm = room_mm(sheet_mm, margin_mm(designed)).y() - extent.sizes().y();
  const PointMm size_mm = extent.sizes();
  const auto [left_mm, ruler_down] = left_edge(size_mm, sheet_mm, margin_mm(designed));
  const PointMm middle(left_mm + size_mm.x() / 2,
                       margin_mm(designed) + free_mm / 2 + size_mm.y() / 2);
  const auto on_paper = [&](const Eigen::Vector3d& point_m) -> PointMm {
    const PointMm from_middle = point_m.head<2>() * 1000 - extent.center();
    return middle + PointMm(from_middle.x(), -from_middle.y());  // y is down on paper
  };
  PdfSheet sheet(path, sheet_mm, "Board for Heft");
  for (const Tag& tag : designed.tags) {
    std::array<PointMm, 4> corners_mm;
    std::ranges::transform(tag.corners_m, corners_mm.begin(), on_paper);
    draw_tag(sheet, designed.family, tag.id, corners_mm);
  }
  draw_ruler_strip(sheet, sheet_mm, ruler_down, "This edge: towards the participant.");
  if (ruler_down) sheet.ruler_down({unprintable_mm + 0.4, unprintable_mm + 4}, 1.4, false);
  sheet.next_page();
  write_steps(sheet, "The board: print, measure, glue",
              steps_for(measured_down(ruler_down, size_mm.y())));
  sheet.finish();
}

}  // namespace heft
