// The command line as commands see it: each option, and the variable that it ends in. Only
// CommandLine.cpp knows the library that reads it (CLI11).
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace heft::cli {

/// What an option's text is given to where it is read at once; it may throw Error.
struct ReadsText {
  std::function<void(const std::string&)> read;
  bool several = false;  ///< texts after one option
};

/// Where an option's value goes. Optionals tell whether it was given; lists take several.
using Destination =
    std::variant<ReadsText, std::string*, std::optional<std::string>*, std::vector<std::string>*,
                 int*, double*, std::optional<double>*, std::optional<std::int64_t>*,
                 std::optional<std::uint64_t>*, std::vector<std::int64_t>*>;

/// An option that was just added, to say more of it.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(option) {}

  Option& required();
  /// --help shows what the variable holds.
  Option& shows_default();
  /// Decimal digits and nothing else, so that 010 is not read as octal 8, nor 1e3 as 1.
  Option& whole_number(std::uint64_t least, std::uint64_t most);
  /// A number from one to the other, both of them too.
  Option& between(double least, double most);
  Option& one_of(const std::vector<std::string>& names);

 private:
  CLI::Option& option_;
};

/// A command, or the program itself. A copy is the same command.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(app) {}

  /// A command of this one; its --help ends with examples, a line each.
  Command add_command(const std::string& name, const std::string& summary,
                      const std::vector<std::string>& examples = {});
  /// @param name "--db", or "PROTOCOL" for what is told by its place
  Option add_option(const std::string& name, Destination destination, const std::string& help);
  void add_flag(const std::string& name, bool& flag, const std::string& help);
  /// What is added from here on stands under this heading in --help.
  void group(const std::string& heading) { group_ = heading; }

  /// --session of a log.
  void add_session(std::optional<std::int64_t>& session, const std::string& without_it);
  void add_sessions(std::vector<std::int64_t>& sessions, const std::string& help);
  /// --seed.
  /// @param without_it what --help says of that
  void add_seed(std::optional<std::uint64_t>& seed,
                const std::string& without_it = "a fresh one is drawn, printed and logged");

  /// Ends --help with this.
  void add_to_help(const std::string& text);
  /// One of its commands has to be given.
  void needs_command();
  /// What the command does; it may throw Error.
  void does(std::function<void()> action);

 private:
  CLI::App& app_;
  std::string group_ = "Options";
};

/// A program's name, what it is for, and its commands.
struct ProgramDescription {
  std::string name, purpose, footer;
  void (*add_commands)(Command& program);
};

/// Finds the command in argv and does it. --help, --version and the command `completion`, which
/// every program has, print to stdout.
/// @throws Error (usage) for what can't be understood, with the nearest that can; what the command
///   throws
void run_command_line(const ProgramDescription& program, int argc, char** argv);

}  // namespace heft::cli
