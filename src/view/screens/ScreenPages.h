// One function per screen of the participant: fills a page with the screen's content through a
// builder that looks up texts and places texts and buttons, mirrored for the tapping hand.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/ScreenState.h"
#include "experiment/ScreenTexts.h"
#include "view/screens/Page.h"
#include "view/text/Typeface.h"

namespace heft {

/// A screen's state between two touches; cleared when the page turns, but kept during a pause.
struct ScreenMemory {
  std::optional<int> selected;                 ///< sorting: the cube for the next label
  int part = 0;                                ///< of a long text, or question of a form; from 0
  std::map<std::string, std::string> entries;  ///< of a form, chosen so far
  std::map<std::string, std::string> typed;    ///< numbers among them that are still being typed
  bool cubes_shown = false;                    ///< in the scene
  std::string named;                           ///< the button of the last choice, while it fades
  bool has_declined = false;                   ///< consent: declined once, and came back
  double up_s = 0;                             ///< how long the part or question has been displayed
};

/// A touch without an answer: turns the page, or requests something.
Touch touch_of(TouchKind kind);
/// A touch that sets an entry of a form.
Touch entry_touch(std::string_view key, std::string_view value);

class PageBuilder {
 public:
  PageBuilder(const ScreenState& offered, const ScreenMemory& remembered, const ScreenTexts& texts,
              const Typeface& face, const Measures& sizes, bool left_hand)
      : state(offered),
        memory(remembered),
        measures(sizes),
        typeface(face),
        left_handed(left_hand),
        texts_(texts) {}

  const std::string& text(const std::string& of_page, const std::string& key) const {
    return texts_.at(of_page, key);
  }
  /// Empty if the file lacks it, which is allowed.
  std::string text_if_any(const std::string& of_page, const std::string& key) const {
    return texts_.if_any(of_page, key);
  }

  /// Writes lines below each other from y on, from the side of the column where reading begins; an
  /// empty line is half as high.
  /// @return the bottom of the last line
  float add_lines(const std::vector<std::string>& lines, const Rect& column, float y, float size_px,
                  Tone tone = Tone::strong);
  float height_px(const std::vector<std::string>& lines, float size_px) const;

  Control& add_button(std::string name, const Rect& area, std::string words, Effect effect,
                      char key = 0);

  /// The button that continues; its key is Enter.
  Control& add_primary(std::string name, const Rect& area, std::string words, Effect effect);

  /// The i-th of two wide buttons side by side above the bottom row, from the side of the hand.
  Rect choice_button(int i) const;
  /// The i-th button of the bottom row, from the side of the hand.
  Rect bottom_button(int i) const;
  /// The area of a page's text: centered, of legible width, above the rows of buttons.
  Rect text_area(int n_rows = 1) const;

  const Questionnaire& questionnaire() const { return texts_.questionnaires.at(state.form); }
  /// Key of a questionnaire's entry in the log.
  std::string entry_key(const std::string& question) const { return state.form_prefix + question; }
  Touch entry(const std::string& question, const std::string& value) const {
    return entry_touch(entry_key(question), value);
  }

  Page page;
  const ScreenState& state;
  const ScreenMemory& memory;
  const Measures& measures;
  const Typeface& typeface;
  const bool left_handed;

 private:
  const ScreenTexts& texts_;
};

inline constexpr char key_enter = '\r', key_backspace = '\b';

using FillPage = void(PageBuilder& builder);

// TextScreens.cpp. A text too long for the screen is shown in parts.
FillPage consent_screen, welcome_screen, instructions_screen, rest_screen, paused_screen,
    thanks_screen, declined_screen, setting_up_screen;
// Also there: forms with one question at a time, each of which can be skipped.
FillPage about_you_screen, how_decided_screen;
/// A form's first unanswered question, or its last; 0 for other screens.
int first_open_question(const ScreenState& state);
/// The buttons to the question after and before the i-th of n.
void add_turning(PageBuilder& builder, int i, int n, bool answered);
// QuestionnaireScreen.cpp
FillPage questionnaire_screen;
int first_open_question(const Questionnaire& form, const std::string& prefix,
                        const std::map<std::string, std::string>& entries);
// SceneParts.cpp. The screens of trials are declared by their tasks (src/tasks).
FillPage demonstration_screen;

// Also there: parts of trial screens, with the scene and its question beside a column of controls.
// Each task's screen has a separate file.

/// The column of controls, on the side of the tapping hand; the question is above the scene.
Rect column_of(const PageBuilder& builder);
/// @param later texts that will take the place of the one above, without moving the scene
void add_scene(PageBuilder& builder, const std::string& above,
               const std::vector<std::string>& later = {});

/// The i-th of n equal cells of a row.
Rect cell(const Rect& row, int i, int n, float gap);
/// Number of buttons in a row that are large enough to be touched.
int in_a_row(int n);
Rect rows_below(const Rect& row, int n, float gap);
Rect bottom_row(const PageBuilder& builder);

/// A cube's place in words; letters where ranks are numbers.
std::string slot_words(const PageBuilder& builder, int slot, int n_slots);

/// Buttons for the cubes, in the cubes' order for either hand; in two rows if necessary.
void add_cubes(PageBuilder& builder, const Rect& row, const std::function<Effect(int)>& effect_of);
/// Two cubes below the task's question; one tap chooses one.
void add_choice_of_cube(PageBuilder& builder);
void add_put_back(PageBuilder& builder, const Rect& area);
/// The hint on what must be done before an answer is possible.
void add_hint(PageBuilder& builder);
/// Marks the last answer until its cubes disappear, as a confirmation.
void mark_named(PageBuilder& builder);

/// The page of texts of the trial's task.
std::string trial_page(const PageBuilder& builder);
/// Whether an answer can be given: the cubes are visible.
bool can_answer(const PageBuilder& builder);
/// The effect of a tap that is an answer.
Touch answer_touch(Action action);

}  // namespace heft
