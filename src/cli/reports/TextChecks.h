// Checks of the participant's texts, for heft validate.
#pragma once

#include <string>
#include <vector>

#include "base/Error.h"
#include "experiment/ScreenTexts.h"

namespace heft {
struct Protocol;
}

namespace heft::cli {

struct WordFaults {
  std::vector<std::string> cautions;  ///< texts that are hard to read on the smallest screen
  std::vector<Mistake> mistakes;      ///< characters that no installed font has
};

/// Of a text file alone, at normal and at large text size.
WordFaults faults_in_words(const ScreenTexts& texts, const std::string& file);

/// Of all texts in a participant's session: the protocol's texts and questionnaires at the
/// protocol's text size. Each caution begins with its file. The program's own texts are assumed to
/// be valid, unless questionnaires or larger letters are used.
/// @throws Error as add_questionnaires(); InvalidFile if a file has mistakes
WordFaults faults_in_words(const Protocol& protocol, const std::string& protocol_file,
                           const std::string& language);

}  // namespace heft::cli
