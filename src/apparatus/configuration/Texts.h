// What participants read: the text file of a language, and the questionnaires below it.
#pragma once

#include <map>
#include <string>

#include "experiment/SessionConfig.h"

namespace heft {
struct Protocol;

/// A file of protocols/texts/ by its language, or any other by its path.
/// @throws Error (usage) naming the languages that there are
std::string texts_file(const std::string& language);

/// Puts the protocol's questionnaires below the texts, from NAME.LANGUAGE.toml beside the protocol
/// or in protocols/questionnaires. Those that the texts have already stay as they are.
/// @return the file that each questionnaire of these texts came from, by its name
/// @throws Error naming what is missing, or two files that have one of a name; InvalidFile where a
///   file has mistakes
std::map<std::string, std::string> add_questionnaires(ConfigFile& texts,
                                                      const std::string& protocol_file,
                                                      const Protocol& protocol);

}  // namespace heft
