// The command line: each option and the variable that receives it. Only CommandLine.cpp uses the
// library that reads it (CLI11).
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

/// The log of commands without --db.
inline constexpr const char* usual_log = "heft.db";

/// Reads an option's text during parsing; may throw Error.
struct ReadsText {
  std::function<void(const std::string&)> read;
  bool several = false;  ///< texts after one option
};

/// Receives an option's value. An optional stays empty if the option is missing; lists take several
/// values.
using Destination =
    std::variant<ReadsText, std::string*, std::optional<std::string>*, std::vector<std::string>*,
                 int*, double*, std::optional<double>*, std::optional<std::int64_t>*,
                 std::optional<std::uint64_t>*, std::vector<std::int64_t>*>;

/// A newly added option, for further settings.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(option) {}

  Option& required();
  /// --help shows the variable's value.
  Option& shows_default();
  /// Decimal digits only, so that 010 is not read as octal 8, nor 1e3 as 1.
  Option& whole_number(std::uint64_t least, std::uint64_t most);
  /// A number in [least, most].
  Option& between(double least, double most);
  Option& one_of(const std::vector<std::string>& names);

 private:
  CLI::Option& option_;
};

/// A command, or the program itself. Copies refer to the same command.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(app) {}

  /// Adds a subcommand; its --help ends with examples, one per line.
  Command add_command(const std::string& name, const std::string& summary,
                      const std::vector<std::string>& examples = {});
  /// @param name "--db", or "PROTOCOL" for a positional argument
  Option add_option(const std::string& name, Destination destination, const std::string& help);
  void add_flag(const std::string& name, bool& flag, const std::string& help);
  /// Starts a group: options added from here on are under this heading in --help.
  void group(const std::string& heading) { group_ = heading; }

  /// Adds --db. @param db set to usual_log
  void add_log(std::string& db, const std::string& help = "the log");
  /// Adds --session of a log.
  void add_session(std::optional<std::int64_t>& session, const std::string& without_it);
  void add_sessions(std::vector<std::int64_t>& sessions, const std::string& help);
  /// Adds --jobs, a number of threads. @param jobs set to one per core
  /// @param what and a verb: "the result does"
  void add_jobs(int& jobs, const std::string& what);
  /// Adds --seed.
  /// @param without_it its default, for --help
  void add_seed(std::optional<std::uint64_t>& seed,
                const std::string& without_it = "drawn, printed and logged");

  /// Lists the command by its name alone in its program's --help.
  void is_minor();
  /// Appends text to --help.
  void add_to_help(const std::string& text);
  /// Requires one of its subcommands.
  void needs_command();
  /// Sets the command's action; it may throw Error.
  void does(std::function<void()> action);

 private:
  CLI::App& app_;
  std::string group_ = "Options";
};

/// A program's name, purpose and commands.
struct ProgramDescription {
  std::string name, purpose, footer;
  void (*add_commands)(Command& program);
};

/// Runs the command in argv. --help, --version and the command `completion`, which every program
/// has, print to stdout.
/// @throws Error (usage) for invalid arguments, with the most similar valid one; the command's
///   errors throws
void run_command_line(const ProgramDescription& program, int argc, char** argv);

}  // namespace heft::cli
