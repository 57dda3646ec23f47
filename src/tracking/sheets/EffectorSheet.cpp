// The effector's sheet: its net with the tags.
#include <fmt/format.h>

#include <algorithm>

#include "base/Error.h"
#include "tracking/sheets/PdfSheet.h"
#include "tracking/sheets/Sheet.h"

namespace heft {

namespace {
constexpr Stroke cut{0.15, 0.3}, fold{0.15, 0.6, true}, pointer{0.4, 0.3};

// Converts the net's meters, y up, to the paper's millimeters, y down.
struct OnPaper {
  PointMm low_left;
  PointMm operator()(const NetPoint& point_m) const {
    return low_left + PointMm(point_m.x(), -point_m.y()) * 1000;
  }
};

void draw_lines(PdfSheet& sheet, const EffectorNet& net, const OnPaper& on_paper) {
  for (const auto& [from, to] : net.folds_m) sheet.line(on_paper(from), on_paper(to), fold);
  for (const auto& [from, to] : net.cuts_m) sheet.line(on_paper(from), on_paper(to), cut);
}

void draw_tags(PdfSheet& sheet, const MarkerBody& effector, const EffectorNet& net,
               const OnPaper& on_paper) {
  for (const Tag& tag : effector.tags) {
    const NetFace& face = net.at(face_of(effector.box(), tag));
    std::array<PointMm, 4> corners_mm;
    std::ranges::transform(tag.corners_m, corners_mm.begin(),
                           [&](const Eigen::Vector3d& c) { return on_paper(face.on_net(c)); });
    draw_tag(sheet, effector.family, tag.id, corners_mm);
  }
}

// The lowest point of the prints on a face.
double lowest_tag_m(const MarkerBody& effector, const NetFace& face) {
  double lowest_m = face.frame.size_m.y() / 2;
  for (const Tag& tag : effector.tags) {
    if (face_of(effector.box(), tag) != face.face) continue;
    const double side_m = (tag.corners_m[1] - tag.corners_m[0]).norm();
    const double margin_m = tag_pattern(effector.family, tag.id).margin_m(side_m);
    for (const Eigen::Vector3d& corner_m : tag.corners_m)
      lowest_m = std::min(lowest_m, face.frame.flat(corner_m).y() - margin_m);
  }
  return lowest_m;
}

std::string name_in_words(BoxFace face) {
  std::string name(name_of(face));
  std::ranges::replace(name, '_', ' ');
  return name;
}

// The face's name and an arrow to the tip, if there is space below its tags.
void label(PdfSheet& sheet, const MarkerBody& effector, const NetFace& face,
           const OnPaper& on_paper) {
  constexpr double needed_m = 0.014;
  const double bottom_m = -face.frame.size_m.y() / 2;
  if (lowest_tag_m(effector, face) - bottom_m < needed_m) return;
  const PointMm foot = on_paper(face.center_m + NetPoint(0, bottom_m)) - PointMm(0, 2);
  sheet.text(foot, name_in_words(face.face), {3.5, 0.3, false, true});
  if (face.face == BoxFace::back) return;
  sheet.arrow(foot - PointMm(0, 4), foot - PointMm(0, 10), pointer);
}

// Space beside the two rulers.
PointMm room_mm(const PointMm& sheet_mm) {
  return sheet_mm - PointMm::Constant(2 * unprintable_mm + ruler_strip_mm);
}

// Portrait, or landscape if the net only fits so.
PointMm chosen_paper(const PointMm& net_mm, Paper paper) {
  const PointMm upright = paper_mm(paper), across(upright.y(), upright.x());
  for (const PointMm& sheet_mm : {upright, across})
    if ((net_mm.array() <= room_mm(sheet_mm).array()).all()) return sheet_mm;
  const PointMm room = room_mm(upright);
  throw Error(
      fmt::format("the effector's net is {:.4g} x {:.4g} mm, but a sheet of {} has space for "
                  "{:.4g} x {:.4g}; make the box smaller, or use other paper (--paper)",
                  net_mm.x(), net_mm.y(), name_of(paper), room.x(), room.y()));
}

const std::array<std::string, 6> steps{
    "Print page 1 at 100 % (\"actual size\"), not \"fit to page\", on matte white card\n"
    "(160 g or more).",
    "Measure both ruler lines of page 1, at the bottom and at the left, between their first\n"
    "and last ticks: printers stretch paper more in one direction. Write the lengths into\n"
    "the effector file, in meters, the bottom one first, for example:\n"
    "    ruler_measured_m = [0.1496, 0.1499]",
    "Cut along the full lines. Score the dashed lines with the back of a knife and fold\n"
    "them away from you, so that the tags are outside.",
    "Glue the long side first, then the tip with its flaps inside. A block of wood or\n"
    "foam inside keeps the box in shape. Close the back.",
    "Arrows point to the tip. Hold the effector at its back, so that no finger covers a tag,\n"
    "with the face \"top\" up.",
    "Measure the positions of the tags (folded boxes are a millimeter off):\n"
    "    heft calibrate effector --camera camera:0 --camera-file camera.yaml \\\n"
    "        --effector EFFECTOR.toml --out MEASURED.toml"};
}  // namespace

void write_effector_sheet(const MarkerBody& effector, Paper paper, const std::string& path) {
  const MarkerBody designed = as_designed(effector);
  const EffectorNet net = effector_net(designed.box());
  const PointMm net_mm = net.size_m * 1000, sheet_mm = chosen_paper(net_mm, paper);
  const double free_mm = sheet_mm.y() - ruler_strip_mm - net_mm.y();
  const double middle_mm = (sheet_mm.x() + ruler_strip_mm) / 2;
  const OnPaper on_paper{{middle_mm - net_mm.x() / 2, free_mm / 2 + net_mm.y()}};
  for (const Tag& tag : designed.tags)
    face_of(designed.box(), tag);  // reports a misplaced tag before the file is
  PdfSheet sheet(path, sheet_mm, "Effector for Heft");
  draw_lines(sheet, net, on_paper);
  draw_tags(sheet, designed, net, on_paper);
  for (const NetFace& face : net.faces) label(sheet, designed, face, on_paper);
  draw_ruler_strip(sheet, sheet_mm, true, "");
  sheet.ruler_down({unprintable_mm + 5.5, unprintable_mm + 4}, 4, true);
  sheet.next_page();
  write_steps(sheet, "The effector: print, measure, cut, fold", steps);
  sheet.finish();
}

}  // namespace heft
