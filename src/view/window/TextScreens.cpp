#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "view/window/ScreenPages.h"

namespace heft {

namespace {
using Lines = std::vector<std::string>;

// As many lines a part as fit below each other; no part begins with an empty line.
std::vector<Lines> in_parts(const PageBuilder& builder, const Lines& lines, float height_px) {
  std::vector<Lines> parts(1);
  for (const std::string& line : lines) {
    Lines longer = parts.back();
    longer.push_back(line);
    if (!parts.back().empty() && builder.height_px(longer, builder.measures.body) > height_px)
      parts.emplace_back();
    if (!line.empty() || !parts.back().empty()) parts.back().push_back(line);
  }
  return parts;
}

// Writes the title and the text's part in the middle of the space above the buttons.
// @return whether it was the last part
bool add_text(PageBuilder& builder, const std::string& page, int wished_part) {
  const Measures& m = builder.measures;
  const Rect area = builder.text_area();
  const Lines title = builder.typeface.wrapped(builder.text(page, "title"), m.title, area.width);
  const float title_px = builder.height_px(title, m.title) + m.margin;
  const auto parts =
      in_parts(builder, builder.typeface.wrapped(builder.text(page, "text"), m.body, area.width),
               area.height - title_px);
  const int n_parts = static_cast<int>(parts.size());
  const int part = std::min(wished_part, n_parts - 1);
  const Lines& lines = parts[static_cast<std::size_t>(part)];
  const float free_px = area.height - title_px - builder.height_px(lines, m.body);
  const float y = n_parts > 1 ? area.y : area.y + std::max(0.f, 0.4f * free_px);
  builder.add_lines(title, area.x, y, m.title);
  builder.add_lines(lines, area.x, y + title_px, m.body, Tone::soft);
  if (part > 0)
    builder.add_button("back", builder.bottom_button(2), builder.text("buttons", "back"),
                       TurnPart{-1}, key_backspace);
  if (part + 1 == n_parts) return true;
  builder
      .add_button("more", builder.bottom_button(0), builder.text("buttons", "more"), TurnPart{1},
                  key_enter)
      .look = Look::primary;
  return false;
}

void add_next(PageBuilder& builder, const std::string& word) {
  builder
      .add_button("next", builder.bottom_button(0), builder.text("buttons", word),
                  touch_of(TouchKind::next), key_enter)
      .look = Look::primary;
}

void text_screen(PageBuilder& builder, const std::string& page, const ScreenState& state,
                 const ScreenMemory& memory, const std::string& next_word) {
  if (add_text(builder, page, memory.part) && state.wait_s <= 0) add_next(builder, next_word);
}
}  // namespace

void consent_screen(PageBuilder& builder, const ScreenMemory& memory) {
  if (!add_text(builder, "consent", memory.part)) return;
  builder
      .add_button("next", builder.bottom_button(0), builder.text("consent", "agree"),
                  touch_of(TouchKind::next), key_enter)
      .look = Look::primary;
  builder.add_button("decline", builder.bottom_button(1), builder.text("consent", "decline"),
                     touch_of(TouchKind::decline), 'n');
}

void welcome_screen(PageBuilder& builder, const ScreenState& state, const ScreenMemory& memory) {
  text_screen(builder, "welcome", state, memory, "start");
}

void instructions_screen(PageBuilder& builder, const ScreenState& state,
                         const ScreenMemory& memory) {
  text_screen(builder, text_page(Screen::instructions, state.task), state, memory, "next");
}

void rest_screen(PageBuilder& builder, const ScreenState& state) {
  add_text(builder, "rest", 0);
  if (state.wait_s <= 0) return add_next(builder, "next");
  const Rect area = builder.bottom_button(0);
  const auto left_s = static_cast<int>(std::ceil(state.wait_s));
  const float x = builder.text_area().x;
  const float y = builder.add_lines({builder.text("rest", "time_left")}, x, area.y,
                                    builder.measures.body, Tone::soft);
  builder.add_lines({fmt::format("{}:{:02}", left_s / 60, left_s % 60)}, x, y,
                    builder.measures.title);
}

void paused_screen(PageBuilder& builder) {
  add_text(builder, "paused", 0);
}

void thanks_screen(PageBuilder& builder, const ScreenState& state, const ScreenMemory& memory) {
  text_screen(builder, "thanks", state, memory, "finish");
}

}  // namespace heft
