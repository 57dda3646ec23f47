#include "view/window/PageBuilder.h"

#include <utility>

namespace heft {

namespace {
float advance_px(const std::string& line, float size_px) {
  return Typeface::line_height_px(size_px) * (line.empty() ? 0.5f : 1.f);
}
}  // namespace

float PageBuilder::add_lines(const std::vector<std::string>& lines, float x, float y, float size_px,
                             Tone tone) {
  for (const std::string& line : lines) {
    if (!line.empty()) page.lines.push_back({line, x, y, size_px, tone});
    y += advance_px(line, size_px);
  }
  return y;
}

float PageBuilder::height_px(const std::vector<std::string>& lines, float size_px) const {
  float height = 0;
  for (const std::string& line : lines) height += advance_px(line, size_px);
  return height;
}

Control& PageBuilder::add_button(std::string name, const Rect& area, std::string words,
                                 Effect effect, char key) {
  Control control;
  control.name = std::move(name);
  control.area = area;
  control.text = std::move(words);
  control.effect = std::move(effect);
  control.key = key;
  return page.controls.emplace_back(std::move(control));
}

Rect PageBuilder::bottom_button(int i) const {
  const Rect area = text_area();
  const float width = (area.width - 2 * measures.gap) / 3;
  const float offset = static_cast<float>(i) * (width + measures.gap);
  return {left_handed ? area.x + offset : area.right() - width - offset,
          measures.height - 2 * measures.margin - measures.target, width, measures.target};
}

Rect PageBuilder::text_area() const {
  const float width = std::min(measures.width - 4 * measures.margin, 10.5f * measures.target);
  const float bottom = measures.height - 2 * measures.margin - measures.target - 2 * measures.gap;
  const float top = 2 * measures.margin;
  return {(measures.width - width) / 2, top, width, bottom - top};
}

Touch touch_of(TouchKind kind) {
  Touch touch;
  touch.kind = kind;
  return touch;
}

}  // namespace heft
