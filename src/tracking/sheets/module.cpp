// heft-sheets.so: all that calls cairo by name for sheets.
#include <cairo-pdf.h>
#include <cairo.h>

#include "tracking/sheets/PdfPen.h"

namespace heft {

namespace {
constexpr double points_per_mm = 72 / 25.4;

class CairoPen final : public PdfPen {
 public:
  CairoPen(const std::string& path, const PointMm& paper_mm, const std::string& title)
      : surface_(cairo_pdf_surface_create(path.c_str(), paper_mm.x() * points_per_mm,
                                          paper_mm.y() * points_per_mm),
                 cairo_surface_destroy),
        owned_(cairo_create(surface_.get()), cairo_destroy),
        context_(owned_.get()) {
    cairo_scale(context_, points_per_mm, points_per_mm);
    cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
  }

  void areas(std::span<const std::array<PointMm, 4>> corners_mm) override {
    cairo_new_path(context_);
    for (const std::array<PointMm, 4>& area : corners_mm) {
      cairo_new_sub_path(context_);
      for (const PointMm& corner : area) cairo_line_to(context_, corner.x(), corner.y());
      cairo_close_path(context_);
    }
    set_gray(0);
    cairo_fill(context_);
  }

  void lines(std::span<const PointMm> points_mm, const Stroke& stroke) override {
    cairo_new_path(context_);
    for (const PointMm& point : points_mm) cairo_line_to(context_, point.x(), point.y());
    const std::array<double, 2> dashes_mm{2, 1.5};
    cairo_set_dash(context_, dashes_mm.data(), stroke.dashed ? 2 : 0, 0);
    cairo_set_line_width(context_, stroke.width_mm);
    set_gray(stroke.gray);
    cairo_stroke(context_);
  }

  void text(const PointMm& at_mm, const std::string& text, const Lettering& lettering) override {
    cairo_select_font_face(context_, "sans", CAIRO_FONT_SLANT_NORMAL,
                           lettering.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context_, lettering.size_mm);
    cairo_text_extents_t extents{};
    if (lettering.centered) cairo_text_extents(context_, text.c_str(), &extents);
    cairo_move_to(context_, at_mm.x() - extents.x_advance / 2, at_mm.y());
    set_gray(lettering.gray);
    cairo_show_text(context_, text.c_str());
  }

  void next_page() override { cairo_show_page(context_); }

  std::string finish() override {
    cairo_surface_finish(surface_.get());
    for (const cairo_status_t status :
         {cairo_status(context_), cairo_surface_status(surface_.get())})
      if (status != CAIRO_STATUS_SUCCESS && status != CAIRO_STATUS_SURFACE_FINISHED)
        return cairo_status_to_string(status);
    return "";
  }

 private:
  void set_gray(double gray) { cairo_set_source_rgb(context_, gray, gray, gray); }

  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
  std::unique_ptr<cairo_t, void (*)(cairo_t*)> owned_;
  cairo_t* context_;
};
}  // namespace

}  // namespace heft

extern "C" __attribute__((visibility("default")))
const heft::SheetsModule heft_sheets{[](const std::string& path, const heft::PointMm& paper_mm,
                                        const std::string& title) -> std::unique_ptr<heft::PdfPen> {
  return std::make_unique<heft::CairoPen>(path, paper_mm, title);
}};
