// Questionnaires' files: where they are found, and how they come below the texts of a session.
#pragma once

#include <map>
#include <string>

namespace heft {
struct Protocol;
struct SessionConfig;
}  // namespace heft

namespace heft::cli {

/// Puts the protocol's questionnaires below the texts that the session's person reads, from
/// NAME.LANGUAGE.toml beside the protocol (SessionConfig::protocol_file) or in
/// protocols/questionnaires. Those that the texts have already stay as they are. A model, which
/// reads no other page, gets the texts for them.
/// @param texts_file of who has no texts yet
/// @return the file that each questionnaire of these texts came from, by its name
/// @throws Error naming what is not there, or two files that have one of a name; InvalidFile where
///   a file has mistakes
std::map<std::string, std::string> add_questionnaires(SessionConfig& setup,
                                                      const Protocol& protocol,
                                                      const std::string& texts_file);

}  // namespace heft::cli
