#include "tracking/sheets/Layout.h"

#include <fmt/format.h>

namespace heft {

PointMm paper_mm(Paper paper) {
  return paper == Paper::a4 ? PointMm(210, 297) : PointMm(215.9, 279.4);
}

void draw_ruler_strip(PdfSheet& sheet, const PointMm& paper_mm, const std::string& note) {
  const double base_mm = paper_mm.y() - unprintable_mm - 4;
  sheet.ruler({unprintable_mm + 4, base_mm});
  const double beside_mm = unprintable_mm + 4 + ruler_m * 1000 + 4;
  const bool room_beside = paper_mm.x() - beside_mm > 100;
  if (room_beside) {
    sheet.text({beside_mm, base_mm - 1.5}, "Print at 100 %. Is this line 150.0 mm long? " + note,
               {2.6});
    sheet.text({beside_mm, base_mm + 2}, "Write down its length: page 2.", {2.6});
  } else {
    sheet.text({beside_mm, base_mm - 1.5}, "Print at 100 %. Measure", {2.6});
    sheet.text({beside_mm, base_mm + 2}, "this line; see page 2.", {2.6});
  }
}

void draw_tag(PdfSheet& sheet, const std::string& family, int id,
              const std::array<PointMm, 4>& corners_mm) {
  const TagPattern pattern = tag_pattern(family, id);
  sheet.tag(pattern, corners_mm);
  const PointMm down = (corners_mm[3] - corners_mm[0]).normalized();
  const double cell_mm = (corners_mm[3] - corners_mm[0]).norm() / pattern.border_cells;
  // Outside of the print, or in the outer half of its white margin where that is narrow.
  const double away_mm =
      pattern.margin_cells() > 1 ? (pattern.margin_cells() + 0.3) * cell_mm : 0.55 * cell_mm;
  const double font_mm = std::min(2.0, 0.4 * cell_mm);
  const PointMm middle = (corners_mm[2] + corners_mm[3]) / 2;
  sheet.text(middle + down * (away_mm + 0.75 * font_mm), fmt::format("{}", id),
             {font_mm, 0.6, false, true});
}

MarkerBody as_designed(const MarkerBody& body) {
  MarkerBody designed = body;
  const double factor = ruler_m / body.measured_ruler_m.value_or(ruler_m);
  designed.size_m *= factor;
  for (Tag& tag : designed.tags)
    for (Eigen::Vector3d& corner_m : tag.corners_m) corner_m *= factor;
  return designed;
}

}  // namespace heft
