// What a command line tells of itself, made from one description: --help, completion in a shell and
// the manual page. Knows no library that reads command lines.
#pragma once

#include <string>
#include <vector>

namespace heft::cli {

struct OptionDescription {
  std::string names;  ///< "--db", "-h,--help"; of what is told by its place: "PROTOCOL"
  std::string value;  ///< what it takes: "TEXT"; empty: nothing
  std::string group;  ///< the heading that it stands under
  std::string help;   ///< line ends are kept
  bool by_place = false, required = false, repeats = false;
};

struct CommandDescription {
  std::string name;  ///< as it is typed: "heft calibrate camera"
  std::string summary, footer;
  std::vector<OptionDescription> options;
  std::vector<CommandDescription> commands;
};

/// @param width in characters, that no line of an option's help goes beyond, nor an example's that
///   can be broken between words
std::string help_of(const CommandDescription& command, std::size_t width);

/// Scripts to be sourced by a shell: commands and options; elsewhere files.
std::string bash_completion(const CommandDescription& program);
std::string zsh_completion(const CommandDescription& program);
std::string fish_completion(const CommandDescription& program);

/// A page of section 1, in man's macros.
std::string manual_page(const CommandDescription& program);

}  // namespace heft::cli
