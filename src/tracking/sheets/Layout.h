// What both sheets have: paper, its printable part, and the strip at the bottom with the ruler.
#pragma once

#include "tracking/Sheet.h"
#include "tracking/sheets/PdfSheet.h"

namespace heft {

inline constexpr double unprintable_mm = 5;   ///< at each edge, of common printers
inline constexpr double ruler_strip_mm = 10;  ///< height, above the unprintable edge

/// Upright.
PointMm paper_mm(Paper paper);

/// The length of the strip's ruler starts at the left; beside it, how to print.
void draw_ruler_strip(PdfSheet& sheet, const PointMm& paper_mm, const std::string& note);

/// A tag with its id in small gray print below it, away from where the detector looks.
void draw_tag(PdfSheet& sheet, const std::string& family, int id,
              const std::array<PointMm, 4>& corners_mm);

/// Lengths as they were before the print was measured.
MarkerBody as_designed(const MarkerBody& body);

}  // namespace heft
