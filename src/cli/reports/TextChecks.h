// What is wrong with the words that people read: what heft validate tells before anybody sees them.
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
  std::vector<std::string> cautions;  ///< what would not be read well on the smallest screen
  std::vector<Mistake> mistakes;      ///< characters that no installed font has
};

/// Of a text file alone, as people read it and as those do who ask for large letters.
WordFaults faults_in_words(const ScreenTexts& texts, const std::string& file);

/// Of all that a session's person reads: the protocol's texts and the questionnaires that it asks,
/// in its letters. Each caution begins with its file. The texts that come with the program are
/// taken as sound, where neither a questionnaire nor larger letters are asked for.
/// @throws Error as add_questionnaires(); InvalidFile where a file has mistakes
WordFaults faults_in_words(const Protocol& protocol, const std::string& protocol_file,
                           const std::string& language);

}  // namespace heft::cli
