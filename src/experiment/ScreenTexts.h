// A questionnaire as plain data: what people are asked after a block or at the end, in the words of
// one language.
// Every word that a participant reads, by page and key, in one language. The wording sets the
// criterion that people judge by, so it is data, and each page's text is logged with its hash.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/Names.h"
#include "experiment/ScreenState.h"

namespace heft {

enum class QuestionKind {
  choice,  ///< one of several words
  likert,  ///< a whole number between two ends that have words
  slider,  ///< a place between two ends that have words, 0...100
  number,  ///< typed on buttons
  text     ///< told to the experimenter, who writes it down
};
template <>
struct EnumNames<QuestionKind> {
  static constexpr std::array<std::string_view, 5> names{"choice", "likert", "slider", "number",
                                                         "text"};
};

struct AnswerChoice {
  std::string value, text;  ///< what is logged; what people read
};

struct FormQuestion {
  std::string key;
  QuestionKind kind = QuestionKind::choice;
  std::string text;
  std::vector<AnswerChoice> choices;  ///< choice
  std::string low, high;              ///< likert, slider: the ends' words
  int from = 1, to = 7;               ///< likert
  double least = 0, most = 0;         ///< number
};

struct Questionnaire {
  std::string title;
  std::string source;  ///< where it comes from; nobody who takes part reads it
  std::vector<FormQuestion> questions;
};

/// Whether an answer is one that the question takes; people may be in the middle of typing it.
bool takes_answer(const FormQuestion& question, const std::string& value);

/// Of a number, in letters.
inline constexpr std::size_t longest_number = 9;

/// What a number that is being typed becomes with one more key: 0 before a point alone, and no 0
/// before another digit.
/// @param key a digit or "."
/// @return none: it would be no number, or none that could still come to lie in the question's
/// range
std::optional<std::string> typed_on(const FormQuestion& question, const std::string& typed,
                                    const std::string& key);

/// The page of texts that a questionnaire is.
inline std::string questionnaire_page(const std::string& name) {
  return "questionnaire_" + name;
}

struct ScreenTexts {
  std::string language;                                             ///< "en", "fr"...
  std::map<std::string, std::map<std::string, std::string>> pages;  ///< page -> key -> text
  std::map<std::string, Questionnaire> questionnaires =
      {};  ///< by name; their words are pages, too

  /// @throws std::out_of_range for a page or key that the file's reader did not demand
  const std::string& at(const std::string& page, const std::string& key) const {
    return pages.at(page).at(key);
  }
  /// Empty where the file has none: what came to the texts later than files that people keep.
  std::string if_any(const std::string& page, const std::string& key) const {
    const auto found = pages.find(page);
    if (found == pages.end()) return "";
    const auto text = found->second.find(key);
    return text == found->second.end() ? "" : text->second;
  }
};

/// The page of texts that a screen shows: its name, with the task's where there is a page for each
/// ("trial_sorting"). Buttons, places and a trial's hints are on pages of their own, and so is each
/// questionnaire.
inline std::string text_page(Screen screen, const Task& task) {
  const std::string name(name_of(screen));
  const bool by_task = screen == Screen::instructions || screen == Screen::trial;
  return by_task ? name + '_' + task : name;
}

inline std::string text_page(const ScreenState& state) {
  return state.screen == Screen::questionnaire ? questionnaire_page(state.form)
                                               : text_page(state.screen, state.task);
}

}  // namespace heft
