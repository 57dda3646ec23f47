// Text files: every word that a participant reads, in one language. A file has the language's code
// and one table a page; which pages and keys there must be is listed once, in TextsFile.cpp.
#pragma once

#include <string>

#include "experiment/ScreenTexts.h"

namespace heft {

/// Line ends are LF, and spaces at a text's beginning and end are dropped.
/// @throws InvalidFile with every missing, unknown or empty page and key at its line and column
ScreenTexts parse_texts(const std::string& text, const std::string& file);

/// @throws Error when the file can't be read, InvalidFile as parse_texts
ScreenTexts load_texts(const std::string& path);

/// All that a page says, as the log keeps and hashes it: the language, then "key: text" for each
/// key in alphabetical order, an empty line between two. The same words give the same bytes,
/// wherever they stand in their file.
/// @throws std::out_of_range for an unknown page
std::string page_text(const ScreenTexts& texts, const std::string& page);

}  // namespace heft
