// Every text that a participant reads, by page and key, in one language: screens and
// questionnaires. Wording affects the participant's criterion, so each page's text is logged with
// its hash.
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
  likert,  ///< a whole number between two labeled ends
  slider,  ///< a position between two labeled ends, 0...100
  number,  ///< typed on buttons
  text     ///< said to the experimenter, who types it
};
template <>
struct EnumNames<QuestionKind> {
  static constexpr std::array<std::string_view, 5> names{"choice", "likert", "slider", "number",
                                                         "text"};
};

struct AnswerChoice {
  std::string value, text;  ///< as logged; as displayed
};

struct FormQuestion {
  std::string key;
  QuestionKind kind = QuestionKind::choice;
  std::string text;
  std::vector<AnswerChoice> choices;  ///< choice
  std::string low, high;              ///< likert, slider: labels of the ends
  int from = 1, to = 7;               ///< likert
  double least = 0, most = 0;         ///< number
};

struct Questionnaire {
  std::string title;
  std::string source;  ///< its reference; not shown to participants
  std::vector<FormQuestion> questions;
};

/// Whether the question accepts the answer.
bool takes_answer(const FormQuestion& question, const std::string& value);

/// Length of a typed number, characters.
inline constexpr std::size_t longest_number = 9;

/// Appends a key to a number that is being typed. A leading 0 is added before a point and removed
/// before another digit.
/// @param key a digit or "."
/// @return none: the result is no number, or could not be completed to one in the question's range
std::optional<std::string> typed_on(const FormQuestion& question, const std::string& typed,
                                    const std::string& key);

/// Name of a questionnaire's page of texts.
inline std::string questionnaire_page(const std::string& name) {
  return "questionnaire_" + name;
}

struct ScreenTexts {
  std::string language;                                             ///< "en", "fr"...
  std::map<std::string, std::map<std::string, std::string>> pages;  ///< page -> key -> text
  std::map<std::string, Questionnaire> questionnaires =
      {};  ///< by name; their words are pages, too

  /// @throws std::out_of_range for a page or key that the reader does not require
  const std::string& at(const std::string& page, const std::string& key) const {
    return pages.at(page).at(key);
  }
  /// Empty if the file has none: the key may be newer than the file.
  std::string if_any(const std::string& page, const std::string& key) const {
    const auto found = pages.find(page);
    if (found == pages.end()) return "";
    const auto text = found->second.find(key);
    return text == found->second.end() ? "" : text->second;
  }
};

/// Name of a screen's page of texts: the screen's name, with the task's for instructions and trials
/// ("trial_sorting").
inline std::string text_page(Screen screen, const Task& task) {
  const std::string name(name_of(screen));
  const bool by_task = screen == Screen::instructions || screen == Screen::trial;
  return by_task ? name + '_' + task : name;
}

/// Key of a wording's instructions on that page; the usual ones are "text".
inline std::string instructions_key(std::string_view wording) {
  return wording.empty() ? "text" : "text_" + std::string(wording);
}

inline std::string text_page(const ScreenState& state) {
  return state.screen == Screen::questionnaire ? questionnaire_page(state.form)
                                               : text_page(state.screen, state.task);
}

}  // namespace heft
