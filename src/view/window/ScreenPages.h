// One function per screen of the participant: fills a page with what the screen shows and offers.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "experiment/ScreenState.h"
#include "view/window/PageBuilder.h"

namespace heft {

/// What a screen remembers by itself between two touches; forgotten when the page turns.
struct ScreenMemory {
  std::optional<int> selected;                 ///< sorting: the cube that the next label is for
  int part = 0;                                ///< of a long text, or question of a form; from 0
  std::map<std::string, std::string> entries;  ///< of a form, as chosen so far
  bool cubes_shown = false;                    ///< in the scene
};

// Text: TextScreens.cpp. A text too long for the screen comes in parts.
void consent_screen(PageBuilder& builder, const ScreenMemory& memory);
void welcome_screen(PageBuilder& builder, const ScreenState& state, const ScreenMemory& memory);
void instructions_screen(PageBuilder& builder, const ScreenState& state,
                         const ScreenMemory& memory);
void rest_screen(PageBuilder& builder, const ScreenState& state);
void paused_screen(PageBuilder& builder);
void thanks_screen(PageBuilder& builder, const ScreenState& state, const ScreenMemory& memory);

// Forms of one question at a time, each to be skipped at will: FormScreens.cpp.
void about_you_screen(PageBuilder& builder, const ScreenMemory& memory);
void how_decided_screen(PageBuilder& builder, const ScreenMemory& memory);

// Beside the scene: SceneScreens.cpp.
void demonstration_screen(PageBuilder& builder, const ScreenState& state);
void introduction_screen(PageBuilder& builder, const ScreenState& state,
                         const ScreenMemory& memory);
void sorting_screen(PageBuilder& builder, const ScreenState& state, const ScreenMemory& memory);
void comparison_screen(PageBuilder& builder, const ScreenState& state, const ScreenMemory& memory);

}  // namespace heft
