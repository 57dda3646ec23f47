// The answers of one question within an area: choices, points of a scale, a slider, a keypad. On a
// form each tap is an answer; in the narrow column of a trial it is kept until it is validated.
#pragma once

#include <functional>
#include <string>

#include "view/screens/ScreenPages.h"

namespace heft {

enum class AskedIn { form, trial };

class AskedQuestion {
 public:
  /// @param answer so far; empty: none
  AskedQuestion(PageBuilder& on, const FormQuestion& asked, const std::string& answer, AskedIn in)
      : builder(on), question(asked), given(answer), in_trial(in == AskedIn::trial) {}

  void add_answers(const Rect& area);
  /// Height of the texts above the buttons, px.
  float above_px() const;
  /// Number of rows of buttons.
  int n_rows() const;

 private:
  int n_choices() const { return static_cast<int>(question.choices.size()); }
  int n_points() const { return question.to - question.from + 1; }
  int choices_beside() const;
  int points_beside() const;
  int keys_beside() const { return in_trial ? 3 : 6; }
  Rect cell(const Rect& area, int i, int n_beside, bool as_read) const;
  Effect entering(const std::string& value) const;
  Control& add_answer(const Rect& place, const std::string& words, const std::string& value);
  void add_choices(const Rect& area);
  float add_ends(const Rect& area);
  void add_points(const Rect& area);
  void add_slider(const Rect& area);
  float add_typed(const Rect& area);
  void add_keypad(const Rect& area);

  PageBuilder& builder;
  const FormQuestion& question;
  const std::string& given;
  bool in_trial;
};

/// The answers to a question beside the scene of a trial, and the button that confirms one.
/// @param action of an answer as entered
void add_question(PageBuilder& builder, const FormQuestion& question, const std::string& confirm,
                  const std::function<Action(const std::string& given)>& action);
/// That button, named after its action, beside the one that puts the cubes back.
void add_confirmation(PageBuilder& builder, const std::string& words, const Action& action,
                      bool enabled);

}  // namespace heft
