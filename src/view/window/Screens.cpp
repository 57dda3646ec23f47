#include "view/window/Screens.h"

#include <algorithm>

namespace heft {

// A trial after a trial has the same page; it is told by its cubes that are not there yet, or by
// its count of choices that begins anew.
bool Screens::is_new_page(const ScreenState& state, bool cubes_shown) const {
  if (!shown_ || text_page(state.screen, state.task) != text_page(state_.screen, state_.task))
    return true;
  if (state.screen != Screen::trial) return false;
  return (memory_.cubes_shown && !cubes_shown) || state.n_choices < state_.n_choices ||
         state.n_slots != state_.n_slots;
}

bool Screens::show(const ScreenState& state, bool cubes_shown) {
  const bool turned = is_new_page(state, cubes_shown);
  if (turned) memory_ = {};
  memory_.cubes_shown = cubes_shown;
  state_ = state;
  shown_ = true;
  return turned;
}

Page Screens::page(const Typeface& typeface, const Measures& measures) const {
  if (!shown_) return {};
  PageBuilder builder(texts_, typeface, measures, left_handed_);
  const auto trial = [&] {
    switch (state_.task) {
      case Task::introduction:
        return introduction_screen(builder, state_, memory_);
      case Task::sorting:
        return sorting_screen(builder, state_, memory_);
      case Task::comparison:
        return comparison_screen(builder, state_, memory_);
    }
  };
  const auto fill = [&] {
    switch (state_.screen) {
      case Screen::consent:
        return consent_screen(builder, memory_);
      case Screen::welcome:
        return welcome_screen(builder, state_, memory_);
      case Screen::about_you:
        return about_you_screen(builder, memory_);
      case Screen::demonstration:
        return demonstration_screen(builder, state_);
      case Screen::instructions:
        return instructions_screen(builder, state_, memory_);
      case Screen::trial:
        return trial();
      case Screen::rest:
        return rest_screen(builder, state_);
      case Screen::paused:
        return paused_screen(builder);
      case Screen::how_decided:
        return how_decided_screen(builder, memory_);
      case Screen::thanks:
        return thanks_screen(builder, state_, memory_);
    }
  };
  fill();
  return std::move(builder.page);
}

std::optional<Touch> Screens::tapped(const Control& control) {
  if (const auto* select = std::get_if<SelectCube>(&control.effect))
    memory_.selected = select->slot;
  if (const auto* turn = std::get_if<TurnPart>(&control.effect))
    memory_.part = std::max(0, memory_.part + turn->by);
  const auto* touch = std::get_if<Touch>(&control.effect);
  if (!touch) return std::nullopt;
  if (touch->kind == TouchKind::entry) memory_.entries[touch->key] = touch->value;
  return *touch;
}

}  // namespace heft
