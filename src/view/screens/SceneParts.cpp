#include <fmt/format.h>

#include <algorithm>

#include "view/screens/ScreenPages.h"

namespace heft {

Rect column_of(const PageBuilder& builder) {
  const Measures& m = builder.measures;
  const float width = 3.55f * m.target;
  return {builder.left_handed ? m.margin : m.width - m.margin - width, m.margin, width,
          m.height - 2 * m.margin};
}

void add_scene(PageBuilder& builder, const std::string& above,
               const std::vector<std::string>& later) {
  const Measures& m = builder.measures;
  const Rect column = column_of(builder);
  const float x = builder.left_handed ? column.right() + m.margin : m.margin;
  const float width = m.width - column.width - 3 * m.margin;
  const auto fitted = [&](const std::string& text) {
    return builder.typeface.fitted(text, m.body, width, 3 * m.body, m.least_px(m.body));
  };
  const FittedText words = fitted(above);
  float bottom = builder.add_lines(words.lines, {x, 0, width, 0}, m.margin, words.size_px);
  for (const std::string& text : later) {
    const FittedText other = fitted(text);
    bottom = std::max(bottom, m.margin + builder.height_px(other.lines, other.size_px));
  }
  const float y = bottom + m.gap;
  builder.page.scene = Rect{x, y, width, m.height - m.margin - y};
  builder.page.scene_opacity = static_cast<float>(1 - builder.state.faded.value_or(0));
}

Rect cell(const Rect& row, int i, int n, float gap) {
  const float width = (row.width - gap * static_cast<float>(n - 1)) / static_cast<float>(n);
  return {row.x + static_cast<float>(i) * (width + gap), row.y, width, row.height};
}

int in_a_row(int n) {
  return n <= 3 ? n : (n + 1) / 2;
}

Rect rows_below(const Rect& row, int n, float gap) {
  return {row.x, row.y + static_cast<float>(n) * (row.height + gap), row.width, row.height};
}

Rect bottom_row(const PageBuilder& builder) {
  const Rect column = column_of(builder);
  const float height = builder.measures.target;
  return {column.x, column.bottom() - height, column.width, height};
}

std::string slot_words(const PageBuilder& builder, int slot, int n_slots) {
  if (n_slots != 2 && n_slots != 3)  // numbers are ranks
    return std::string(1, static_cast<char>('A' + slot - 1));
  if (slot == 1) return builder.text("slots", "left");
  return builder.text("slots", slot == n_slots ? "right" : "middle");
}

void add_cubes(PageBuilder& builder, const Rect& row, const std::function<Effect(int)>& effect_of) {
  const int n_beside = in_a_row(builder.state.n_slots);
  for (int slot = 1; slot <= builder.state.n_slots; ++slot) {
    const Rect its_row = rows_below(row, (slot - 1) / n_beside, builder.measures.gap);
    Control& button =
        builder.add_button(fmt::format("cube_{}", slot),
                           cell(its_row, (slot - 1) % n_beside, n_beside, builder.measures.gap),
                           slot_words(builder, slot, builder.state.n_slots), effect_of(slot),
                           slot <= 9 ? static_cast<char>('0' + slot) : '\0');
    button.enabled = can_answer(builder);
    button.chosen = builder.memory.selected == slot;
  }
}

void add_put_back(PageBuilder& builder, const Rect& area) {
  builder
      .add_button("put_cubes_back", area, builder.text("buttons", "put_cubes_back"),
                  touch_of(TouchKind::put_cubes_back), key_backspace)
      .enabled = builder.memory.cubes_shown && !builder.state.is_check;
}

void add_hint(PageBuilder& builder) {
  if (builder.state.is_check)
    builder.page.notice = builder.text_if_any("setting_up", "title");
  else if (builder.state.feedback)
    builder.page.notice =
        builder.text("trial", *builder.state.feedback ? "correct" : "not_correct");
  else if (builder.state.faded)
    builder.page.notice = builder.text_if_any("trial", "next_cubes");
  else if (!builder.memory.cubes_shown)
    builder.page.notice = builder.text("trial", "wait_for_cubes");
  else if (builder.state.touch_first)
    builder.page.notice = builder.text("trial", "touch_every_cube");
}

void mark_named(PageBuilder& builder) {
  if (!builder.state.faded) return;
  for (Control& control : builder.page.controls)
    if (control.name == builder.memory.named) control.chosen = true;
}

void add_choice_of_cube(PageBuilder& builder) {
  add_scene(builder, builder.text(trial_page(builder), "question"));
  add_hint(builder);
  const Rect column = column_of(builder);
  add_cubes(builder, {column.x, column.y, column.width, 2 * builder.measures.target}, [](int slot) {
    return answer_touch({"select", slot});
  });
  add_put_back(builder, bottom_row(builder));
}

std::string trial_page(const PageBuilder& builder) {
  return text_page(Screen::trial, builder.state.task);
}

bool can_answer(const PageBuilder& builder) {
  return builder.state.can_answer && builder.memory.cubes_shown;
}

Touch answer_touch(Action action) {
  Touch touch;
  touch.action = std::move(action);
  return touch;
}

void demonstration_screen(PageBuilder& builder) {
  add_scene(builder, builder.text("demonstration", "title"));
  const Rect column = column_of(builder);
  const Rect button = bottom_row(builder);
  const Measures& m = builder.measures;
  const float y = builder.page.scene->y;
  const auto words =
      builder.typeface.fitted(builder.text("demonstration", "text"), m.body, column.width,
                              button.y - y - m.gap, m.least_px(m.body));
  builder.add_lines(words.lines, column, y, words.size_px, Tone::soft);
  if (builder.state.wait_s > 0) return;
  builder.add_primary("next", button, builder.text("buttons", "next"), touch_of(TouchKind::next));
}

}  // namespace heft
