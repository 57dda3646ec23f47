#include "tracking/sheets/PdfSheet.h"

#include <cairo-pdf.h>
#include <fmt/format.h>

#include <cmath>

#include "base/Error.h"
#include "base/files/TextFile.h"
#include "tracking/detection/MarkerBody.h"

namespace heft {

namespace {
constexpr double points_per_mm = 72 / 25.4;

// Existing sheets, perhaps printed and measured, are not overwritten.
const char* new_file(const std::string& path) {
  require_writable(path);
  if (!create_file(path, 0666))
    throw Error(
        fmt::format("{} already exists and would be overwritten; name another file, or remove "
                    "it first",
                    path));
  return path.c_str();
}
}  // namespace

PdfSheet::PdfSheet(const std::string& path, const PointMm& paper_mm, const std::string& title)
    : path_(path),
      surface_(cairo_pdf_surface_create(new_file(path), paper_mm.x() * points_per_mm,
                                        paper_mm.y() * points_per_mm),
               cairo_surface_destroy),
      pen_(cairo_create(surface_.get()), cairo_destroy) {
  cairo_scale(pen_.get(), points_per_mm, points_per_mm);
  cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
}

void PdfSheet::tag(const TagPattern& pattern, const std::array<PointMm, 4>& corners_mm) {
  const PointMm column = (corners_mm[1] - corners_mm[0]) / pattern.border_cells;
  const PointMm row = (corners_mm[3] - corners_mm[0]) / pattern.border_cells;
  const PointMm first = corners_mm[0] - (column + row) * pattern.margin_cells();
  cairo_new_path(pen_.get());  // all cells in one path: no hairlines between neighbors
  for (int y = 0; y < pattern.n_cells; ++y)
    for (int x = 0; x < pattern.n_cells; ++x) {
      if (pattern.is_white(x, y)) continue;
      const PointMm cell = first + x * column + y * row;
      cairo_new_sub_path(pen_.get());
      for (const PointMm& corner :
           {cell, PointMm(cell + column), PointMm(cell + column + row), PointMm(cell + row)})
        cairo_line_to(pen_.get(), corner.x(), corner.y());
      cairo_close_path(pen_.get());
    }
  set_gray(0);
  cairo_fill(pen_.get());
}

void PdfSheet::lines(std::span<const PointMm> points_mm, const Stroke& stroke) {
  cairo_new_path(pen_.get());
  for (const PointMm& point : points_mm) cairo_line_to(pen_.get(), point.x(), point.y());
  const std::array<double, 2> dashes_mm{2, 1.5};
  cairo_set_dash(pen_.get(), dashes_mm.data(), stroke.dashed ? 2 : 0, 0);
  cairo_set_line_width(pen_.get(), stroke.width_mm);
  set_gray(stroke.gray);
  cairo_stroke(pen_.get());
}

void PdfSheet::text(const PointMm& at_mm, const std::string& text, const Lettering& lettering) {
  cairo_select_font_face(pen_.get(), "sans", CAIRO_FONT_SLANT_NORMAL,
                         lettering.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(pen_.get(), lettering.size_mm);
  cairo_text_extents_t extents{};
  if (lettering.centered) cairo_text_extents(pen_.get(), text.c_str(), &extents);
  cairo_move_to(pen_.get(), at_mm.x() - extents.x_advance / 2, at_mm.y());
  set_gray(lettering.gray);
  cairo_show_text(pen_.get(), text.c_str());
}

void PdfSheet::line(const PointMm& from_mm, const PointMm& to_mm, const Stroke& stroke) {
  const std::array<PointMm, 2> ends{from_mm, to_mm};
  lines(ends, stroke);
}

void PdfSheet::arrow(const PointMm& from_mm, const PointMm& to_mm, const Stroke& stroke) {
  constexpr double head_mm = 2;
  const PointMm along = (to_mm - from_mm).normalized() * head_mm;
  const PointMm across = PointMm(-along.y(), along.x()) / 2;
  line(from_mm, to_mm, stroke);
  const std::array<PointMm, 3> head{to_mm - along + across, to_mm, to_mm - along - across};
  lines(head, stroke);
}

namespace {
constexpr int ruler_mm = static_cast<int>(ruler_m * 1000);

// Relative to the outermost ticks' length.
double tick_share(int mm) {
  return mm % ruler_mm == 0 ? 1 : mm % 50 == 0 ? 0.6 : 0.4;
}
constexpr Stroke thin{0.15};
}  // namespace

void PdfSheet::ruler(const PointMm& from_mm) {
  constexpr double tick_mm = 4;
  line(from_mm, from_mm + PointMm(ruler_mm, 0), thin);
  for (int mm = 0; mm <= ruler_mm; mm += 10) {
    const PointMm tick = from_mm + PointMm(mm, 0);
    line(tick, tick - PointMm(0, tick_mm * tick_share(mm)), thin);
    if (mm % 50 == 0) text(tick + PointMm(0, 2.8), fmt::format("{}", mm), {2.2, 0, false, true});
  }
}

void PdfSheet::ruler_down(const PointMm& from_mm, double tick_mm, bool numbers) {
  line(from_mm, from_mm + PointMm(0, ruler_mm), thin);
  for (int mm = 0; mm <= ruler_mm; mm += 10) {
    const PointMm tick = from_mm + PointMm(0, mm);
    line(tick, tick + PointMm(tick_mm * tick_share(mm), 0), thin);
    if (numbers && mm % 50 == 0)
      text(tick + PointMm(-2.6, 0.8), fmt::format("{}", mm), {2.2, 0, false, true});
  }
}

void PdfSheet::finish() {
  cairo_surface_finish(surface_.get());
  for (const cairo_status_t status :
       {cairo_status(pen_.get()), cairo_surface_status(surface_.get())})
    if (status != CAIRO_STATUS_SUCCESS && status != CAIRO_STATUS_SURFACE_FINISHED)
      throw Error(
          fmt::format("cannot write {}: {}; check that the folder exists and the disk is not full",
                      path_, cairo_status_to_string(status)));
}

void write_steps(PdfSheet& sheet, const std::string& heading, std::span<const std::string> steps) {
  constexpr double left_mm = 20, indent_mm = 8;
  double y_mm = 28;
  sheet.text({left_mm, y_mm}, heading, {6, 0, true});
  y_mm += 4;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    y_mm += 4;
    sheet.text({left_mm, y_mm + 6}, fmt::format("{}.", i + 1), {4.2, 0, true});
    for (const std::string_view line : lines_of(steps[i]))
      sheet.text({left_mm + indent_mm, y_mm += 6}, std::string(line), {4.2});
  }
}

PointMm paper_mm(Paper paper) {
  return paper == Paper::a4 ? PointMm(210, 297) : PointMm(215.9, 279.4);
}

void draw_ruler_strip(PdfSheet& sheet, const PointMm& paper_mm, bool both,
                      const std::string& note) {
  const double base_mm = paper_mm.y() - unprintable_mm - 4;
  sheet.ruler({unprintable_mm + 4, base_mm});
  const double beside_mm = unprintable_mm + 4 + ruler_m * 1000 + 4;
  const bool room_beside = paper_mm.x() - beside_mm > 100;
  const char* lines = both ? "Check that both lines are 150.0 mm long. "
                           : "Check that this line is 150.0 mm long. ";
  if (room_beside) {
    sheet.text({beside_mm, base_mm - 1.5}, "Print at 100 %. " + (lines + note), {2.6});
    sheet.text({beside_mm, base_mm + 2}, "Write down the measured length: see page 2.", {2.6});
  } else {
    sheet.text({beside_mm, base_mm - 1.5}, "Print at 100 %. Measure", {2.6});
    sheet.text({beside_mm, base_mm + 2},
               both ? "both lines; see page 2." : "this line; see page 2.", {2.6});
  }
}

void draw_tag(PdfSheet& sheet, const std::string& family, int id,
              const std::array<PointMm, 4>& corners_mm) {
  const TagPattern pattern = tag_pattern(family, id);
  sheet.tag(pattern, corners_mm);
  const PointMm down = (corners_mm[3] - corners_mm[0]).normalized();
  const double cell_mm = (corners_mm[3] - corners_mm[0]).norm() / pattern.border_cells;
  // Outside of the print, or in the outer half of a narrower white margin.
  const double away_mm =
      pattern.margin_cells() > 1 ? (pattern.margin_cells() + 0.3) * cell_mm : 0.55 * cell_mm;
  const double font_mm = std::min(2.0, 0.4 * cell_mm);
  const PointMm middle = (corners_mm[2] + corners_mm[3]) / 2;
  sheet.text(middle + down * (away_mm + 0.75 * font_mm), fmt::format("{}", id),
             {font_mm, 0.6, false, true});
}

}  // namespace heft
