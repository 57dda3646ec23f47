// Draws a PDF in true millimeters: x right and y down from the paper's top left corner. Also the
// common parts of both sheets: paper, its printable area, tags, the strip at the bottom with the
// ruler.
#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tracking/detection/TagFamily.h"
#include "tracking/sheets/Sheet.h"

namespace heft {

using PointMm = Eigen::Vector2d;

struct Stroke {
  double width_mm = 0.2;
  double gray = 0;  ///< 0 black ... 1 white
  bool dashed = false;
};

struct Lettering {
  double size_mm = 3;  ///< of the font
  double gray = 0;
  bool bold = false;
  bool centered = false;  ///< about the given point, else starting at it
};

class PdfSheet {
 public:
  /// @throws Error if the file already exists or cannot be written
  PdfSheet(const std::string& path, const PointMm& paper_mm, const std::string& title);

  /// A whole tag. @param corners_mm places of the detected corners: the upright tag's top left, top
  /// right, bottom right, bottom left
  void tag(const TagPattern& pattern, const std::array<PointMm, 4>& corners_mm);
  void lines(std::span<const PointMm> points_mm, const Stroke& stroke);
  void line(const PointMm& from_mm, const PointMm& to_mm, const Stroke& stroke);
  /// @param at_mm on the base line
  void text(const PointMm& at_mm, const std::string& text, const Lettering& lettering);
  /// A line to `to_mm` with a head there.
  void arrow(const PointMm& from_mm, const PointMm& to_mm, const Stroke& stroke);
  /// The ruler line: heft::ruler_m long between its outermost ticks. One across the sheet has ticks
  /// above and numbers below.
  void ruler(const PointMm& from_mm);
  /// A ruler line down the sheet: ticks to its right, optional numbers to its left.
  /// @param tick_mm length of the outermost
  void ruler_down(const PointMm& from_mm, double tick_mm, bool numbers);

  void next_page() { cairo_show_page(pen_.get()); }
  /// @throws Error if the file cannot be written
  void finish();

 private:
  void set_gray(double gray) { cairo_set_source_rgb(pen_.get(), gray, gray, gray); }

  std::string path_;
  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
  std::unique_ptr<cairo_t, void (*)(cairo_t*)> pen_;
};

/// A page of text: a heading, then numbered steps, with line ends given as '\n'.
void write_steps(PdfSheet& sheet, const std::string& heading, std::span<const std::string> steps);

inline constexpr double unprintable_mm = 5;   ///< at each edge, of common printers
inline constexpr double ruler_strip_mm = 10;  ///< height, above the unprintable edge

/// Portrait.
PointMm paper_mm(Paper paper);

/// Draws the strip with the ruler at the left and printing instructions beside it.
/// @param both whether the sheet has a ruler down it, too
void draw_ruler_strip(PdfSheet& sheet, const PointMm& paper_mm, bool both, const std::string& note);

/// A tag with its id in small gray print below it, outside the area used for detection.
void draw_tag(PdfSheet& sheet, const std::string& family, int id,
              const std::array<PointMm, 4>& corners_mm);

}  // namespace heft
