// One function per screen of the participant: fills a page with what the screen shows and offers,
// by a builder that looks words up and places text and buttons by the measures, on the side of the
// hand that taps.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiment/ScreenState.h"
#include "experiment/ScreenTexts.h"
#include "view/screens/Page.h"
#include "view/text/Typeface.h"

namespace heft {

/// What a screen remembers by itself between two touches; forgotten when the page turns, but for a
/// pause.
struct ScreenMemory {
  std::optional<int> selected;                 ///< sorting: the cube that the next label is for
  int part = 0;                                ///< of a long text, or question of a form; from 0
  std::map<std::string, std::string> entries;  ///< of a form, as chosen so far
  std::map<std::string, std::string> typed;    ///< numbers among them, that are no answers yet
  bool cubes_shown = false;                    ///< in the scene
  std::string named;                           ///< the button of the last choice, while it fades
  bool has_declined = false;                   ///< consent: and came back
  double up_s = 0;                             ///< how long the part or question has been there
};

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
  /// Empty where the file lacks it, as it may.
  std::string text_if_any(const std::string& of_page, const std::string& key) const {
    return texts_.if_any(of_page, key);
  }

  /// Lines below each other from y on, each at the side of the column where reading it begins; an
  /// empty one is half as high.
  /// @return the bottom of the last
  float add_lines(const std::vector<std::string>& lines, const Rect& column, float y, float size_px,
                  Tone tone = Tone::strong);
  float height_px(const std::vector<std::string>& lines, float size_px) const;

  Control& add_button(std::string name, const Rect& area, std::string words, Effect effect,
                      char key = 0);

  /// The one that leads on; the key is Enter.
  Control& add_primary(std::string name, const Rect& area, std::string words, Effect effect);

  /// The i-th of two wide buttons side by side above the lower edge's, from the side of the hand.
  Rect choice_button(int i) const;
  /// The i-th button of the row along the lower edge, counted from the side of the hand.
  Rect bottom_button(int i) const;
  /// Where text pages write: centered, of a width that reads well, above the rows of buttons.
  Rect text_area(int n_rows = 1) const;

  const Questionnaire& questionnaire() const { return texts_.questionnaires.at(state.form); }
  /// Of a questionnaire's entry, in the log.
  std::string entry_key(const std::string& question) const { return state.form_prefix + question; }
  Touch entry(const std::string& question, const std::string& value) const;

  Page page;
  const ScreenState& state;
  const ScreenMemory& memory;
  const Measures& measures;
  const Typeface& typeface;
  const bool left_handed;

 private:
  const ScreenTexts& texts_;
};

/// A touch that is no answer: it turns the page, or asks for something.
Touch touch_of(TouchKind kind);

inline constexpr char key_enter = '\r', key_backspace = '\b';

using FillPage = void(PageBuilder& builder);

// Text: TextScreens.cpp. A text too long for the screen comes in parts.
FillPage consent_screen, welcome_screen, instructions_screen, rest_screen, paused_screen,
    thanks_screen, declined_screen, setting_up_screen;
// Forms of one question at a time, each to be skipped at will: there, too.
FillPage about_you_screen, how_decided_screen;
/// Of a form, the first question without an answer, or its last; elsewhere 0.
int first_open_question(const ScreenState& state);
/// The button that leads on from the i-th of n questions, and the one that leads back.
void add_turning(PageBuilder& builder, int i, int n, bool answered);
// QuestionnaireScreen.cpp
FillPage questionnaire_screen;
int first_open_question(const Questionnaire& form, const std::string& prefix,
                        const std::map<std::string, std::string>& entries);
// Beside the scene: SceneParts.cpp. The screens of trials are their tasks' (src/tasks).
FillPage demonstration_screen;

}  // namespace heft
