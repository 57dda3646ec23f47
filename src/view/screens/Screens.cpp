#include "view/screens/Screens.h"

#include <algorithm>
#include <array>
#include <utility>

#include "tasks/Tasks.h"
#include "view/screens/ScreenPages.h"

namespace heft {

namespace {
float advance_px(const std::string& line, float size_px) {
  return Typeface::line_height_px(size_px) * (line.empty() ? 0.5f : 1.f);
}

void trial_screen(PageBuilder& builder) {
  Tasks::call(builder.state.task,
              [&]<typename Kind>() { Kind::screen(builder, offer_of<Kind>(builder.state.offer)); });
}

// In the order of Screen.
constexpr std::array<FillPage*, EnumNames<Screen>::names.size()> pages{
    consent_screen,      welcome_screen, about_you_screen, demonstration_screen,
    instructions_screen, trial_screen,   rest_screen,      paused_screen,
    how_decided_screen,  thanks_screen,  declined_screen,  setting_up_screen,
    questionnaire_screen};
}  // namespace

float PageBuilder::add_lines(const std::vector<std::string>& lines, const Rect& column, float y,
                             float size_px, Tone tone) {
  for (const std::string& line : lines) {
    if (!line.empty()) {
      const bool leftward = typeface.written(line, size_px).direction == Direction::right_to_left;
      const float x = leftward ? column.right() - typeface.width_px(line, size_px) : column.x;
      page.lines.push_back({line, x, y, size_px, tone});
    }
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

Rect PageBuilder::choice_button(int i) const {
  const Rect below = bottom_button(0), area = text_area();
  const float width = (area.width - measures.gap) / 2;
  const float x = (i == 0) == left_handed ? area.x : area.right() - width;
  return {x, below.y - measures.gap - measures.target, width, measures.target};
}

Rect PageBuilder::text_area(int n_rows) const {
  const float width = std::min(measures.width - 4 * measures.margin, 10.5f * measures.target);
  const float rows_px = static_cast<float>(n_rows) * (measures.target + measures.gap);
  const float bottom = measures.height - 2 * measures.margin - rows_px - measures.gap;
  const float top = 2 * measures.margin;
  return {(measures.width - width) / 2, top, width, bottom - top};
}

Control& PageBuilder::add_primary(std::string name, const Rect& area, std::string words,
                                  Effect effect) {
  Control& control =
      add_button(std::move(name), area, std::move(words), std::move(effect), key_enter);
  control.look = Look::primary;
  return control;
}

Touch entry_touch(std::string_view key, std::string_view value) {
  Touch touch = touch_of(TouchKind::entry);
  touch.key = key;
  touch.value = value;
  return touch;
}

Touch touch_of(TouchKind kind) {
  Touch touch;
  touch.kind = kind;
  return touch;
}

// The sentence "try again" is read first, like a separate page.
Turn Screens::turn_to(const ScreenState& state, bool cubes_shown) const {
  const bool again = state.try_again && state.n_choices != state_.n_choices;
  if (!shown_ || again || state.page() != state_.page()) return Turn::page;
  return cubes_shown && !memory_.cubes_shown ? Turn::cubes : Turn::none;
}

// A paused page returns in its former state.
void Screens::remember(const ScreenState& state) {
  if (state.page() == state_.page()) return;
  if (state.screen == Screen::paused && shown_) {
    paused_ = {state_.page(), std::exchange(memory_, {})};
    return;
  }
  std::string named = state.faded ? std::move(memory_.named) : "";
  if (paused_ && paused_->page == state.page()) {
    memory_ = std::move(paused_->memory);
  } else {
    memory_ = {};
    memory_.has_declined = state_.screen == Screen::declined;
    memory_.entries = state.entries;
    memory_.part = state.screen == Screen::questionnaire
                       ? first_open_question(texts_.questionnaires.at(state.form),
                                             state.form_prefix, state.entries)
                       : first_open_question(state);
    memory_.named = std::move(named);
  }
  paused_.reset();
}

Turn Screens::show(const ScreenState& state, bool cubes_shown) {
  const bool cubes = cubes_shown && !state.faded;  // fading cubes belong to the last trial
  const Turn turn = turn_to(state, cubes);
  if (turn == Turn::page) remember(state);
  memory_.cubes_shown = cubes;
  state_ = state;
  shown_ = true;
  return turn;
}

Page Screens::page(const Typeface& typeface, const Measures& measures, double up_s) const {
  if (!shown_) return {};
  ScreenMemory memory = memory_;
  memory.up_s = up_s;
  PageBuilder builder(state_, memory, texts_, typeface, measures, left_handed_);
  pages[static_cast<std::size_t>(state_.screen)](builder);
  return std::move(builder.page);
}

std::optional<Touch> Screens::tapped(const Control& control) {
  if (const auto* select = std::get_if<SelectCube>(&control.effect))
    memory_.selected = select->slot;
  if (const auto* turn = std::get_if<TurnPart>(&control.effect))
    memory_.part = std::max(0, memory_.part + turn->by);
  if (const auto* typed = std::get_if<Typed>(&control.effect))
    memory_.typed[typed->key] = typed->value;
  if (control.entered) memory_.entries[control.entered->key] = control.entered->value;
  const auto* touch = std::get_if<Touch>(&control.effect);
  if (!touch) return std::nullopt;
  if (touch->kind == TouchKind::entry) memory_.entries[touch->key] = touch->value;
  if (touch->kind == TouchKind::action) memory_.named = control.name;
  return *touch;
}

}  // namespace heft
