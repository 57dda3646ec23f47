// Every word that a participant reads, by page and key, in one language. The wording sets the
// criterion that people judge by, so it is data, and each page's text is logged with its hash.
#pragma once

#include <map>
#include <string>

#include "experiment/Questionnaire.h"
#include "experiment/ScreenState.h"

namespace heft {

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
