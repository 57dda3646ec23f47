// Every word that a participant reads, by page and key, in one language. The wording sets the
// criterion that people judge by, so it is data, and each page's text is logged with its hash.
#pragma once

#include <map>
#include <string>

namespace heft {

struct ScreenTexts {
  std::string language;                                             ///< "en", "fr"...
  std::map<std::string, std::map<std::string, std::string>> pages;  ///< page -> key -> text

  /// @throws std::out_of_range for a page or key that the file's reader did not demand
  const std::string& at(const std::string& page, const std::string& key) const {
    return pages.at(page).at(key);
  }
};

}  // namespace heft
