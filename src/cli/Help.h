// --help, shell completion and the manual page, generated from one description of the commands.
// Independent of the library that reads command lines.
#pragma once

#include <string>
#include <vector>

namespace heft::cli {

struct OptionDescription {
  std::string names;  ///< "--db", "-h,--help"; "PROTOCOL" for a positional argument
  std::string value;  ///< type of its value: "TEXT"; empty: none
  std::string group;  ///< heading in --help
  std::string help;   ///< line ends are kept
  bool by_place = false, required = false, repeats = false;
  bool is_general = false;  ///< --help, --help-all, --version
};

struct CommandDescription {
  std::string name;  ///< as typed: "heft calibrate camera"
  std::string summary, footer;
  std::vector<OptionDescription> options;
  std::vector<CommandDescription> commands;
  bool is_minor = false;  ///< listed by its name alone
};

/// Words wrapped to lines of that width that begin at a column, each with a line end.
/// @param used characters that are already in the first line
std::string wrapped(const std::string& text, std::size_t column, std::size_t width,
                    std::size_t used = 0);

/// Everything about a command: --help-all.
/// @param width in characters; words and quoted texts are not broken
std::string help_of(const CommandDescription& command, std::size_t width);

/// The same if it fits one terminal screen, else its most important part: --help.
std::string first_help_of(const CommandDescription& command, std::size_t width);

/// Scripts for a shell to source: commands and options; files elsewhere.
std::string bash_completion(const CommandDescription& program);
std::string zsh_completion(const CommandDescription& program);
std::string fish_completion(const CommandDescription& program);

/// A page of section 1, in man's macros.
std::string manual_page(const CommandDescription& program);

}  // namespace heft::cli
