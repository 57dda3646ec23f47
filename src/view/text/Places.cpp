#include "view/text/Places.h"

#include <algorithm>

namespace heft {

ControlWords words_on(const Control& control, const Typeface& typeface, const Measures& measures) {
  const float pad = 0.07f * measures.target;
  Rect inside{control.area.x + pad, control.area.y + pad, control.area.width - 2 * pad,
              control.area.height - 2 * pad};
  ControlWords words;
  if (!control.note.empty()) {
    inside.height /= 2;
    words.note_area = {inside.x, inside.bottom(), inside.width, inside.height};
    words.note = typeface.fitted(control.note, measures.body, words.note_area.width,
                                 words.note_area.height, measures.least_px(measures.body));
  }
  words.text_area = inside;
  words.text = typeface.fitted(control.text, measures.body, inside.width, inside.height,
                               measures.least_px(measures.body));
  return words;
}

NoticeWords words_of_notice(const std::string& notice, const Rect& scene, const Typeface& typeface,
                            const Measures& measures, bool at_top) {
  const float margin = measures.margin;
  NoticeWords words{typeface.fitted(notice, measures.body, scene.width - 4 * margin,
                                    0.25f * scene.height, measures.least_px(measures.body)),
                    {}};
  const auto& [size_px, lines] = words.text;
  float width = 0;
  for (const std::string& line : lines) width = std::max(width, typeface.width_px(line, size_px));
  width += 2 * margin;
  const float height =
      Typeface::line_height_px(size_px) * static_cast<float>(lines.size()) + 1.2f * margin;
  const float y = at_top ? scene.y + margin : scene.bottom() - margin - height;
  words.area = {scene.x + (scene.width - width) / 2, y, width, height};
  return words;
}

Rect place_of(const Patch& patch, const Measures& measures) {
  const float size = 2 * measures.margin;
  return {patch.left ? 0 : measures.width - size, measures.height - size, size, size};
}

}  // namespace heft
