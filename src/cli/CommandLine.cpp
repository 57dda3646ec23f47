#include "cli/CommandLine.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <concepts>
#include <limits>
#include <map>
#include <span>

#include "base/Error.h"
#include "base/Names.h"
#include "base/Parallel.h"
#include "base/files/TextFile.h"
#include "cli/Help.h"
#include "cli/console/Terminal.h"

namespace heft::cli {

namespace {

constexpr std::uint64_t most_sessions = std::numeric_limits<std::int64_t>::max();

bool is_whole_number(const std::string& text, std::uint64_t least, std::uint64_t most) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos) return false;
  if (text.size() > 1 && text.front() == '0') return false;
  std::uint64_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc() && value >= least && value <= most;
}

// Usually an unset shell variable: the option must not be treated as missing.
std::string refused_if_blank(const std::string& text) {
  if (text.find_first_not_of(" \t") != std::string::npos) return "";
  return "its value is empty; give one, or omit the option";
}

std::string nearest_hint(const std::string& wanted, const std::vector<std::string>& names) {
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  const auto nearest = nearest_name(wanted, candidates);
  return nearest ? fmt::format(" (did you mean {}?)", *nearest) : "";
}

// CLI11's own message would only be that a subcommand is required.
// @param name as typed, with the commands before it
void refuse_unknown_command(const CLI::App& app, const std::string& name,
                            std::span<const std::string> words) {
  std::vector<std::string> names;
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  if (words.empty() || names.empty() || words.front().starts_with('-')) return;
  const std::string& word = words.front();
  const auto found = std::ranges::find(names, word);
  if (found != names.end())
    return refuse_unknown_command(*commands[static_cast<std::size_t>(found - names.begin())],
                                  name + " " + word, words.subspan(1));
  throw Error(fmt::format("there is no command \"{}\"{}; {} --help lists all", word,
                          nearest_hint(word, names), name),
              ExitCode::usage);
}

// CLI11 lists unexpected words in reverse order.
std::string unexpected_words(const CLI::App& app, const CLI::App& command) {
  const std::vector<std::string> words = app.remaining(true);
  std::vector<std::string> options;
  for (const CLI::Option* option : command.get_options()) options.push_back(option->get_name());
  const auto option =
      std::ranges::find_if(words, [](const std::string& word) { return word.starts_with("--"); });
  if (option == words.end()) return fmt::format("too many arguments: {}", fmt::join(words, " "));
  return fmt::format("there is no option {}{}", *option, nearest_hint(*option, options));
}

// A misspelled option makes the intended one appear missing.
bool has_unexpected_option(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining(true);
  return std::ranges::any_of(words, [](const std::string& word) { return word.starts_with("--"); });
}

// A usage error found by CLI11, with a pointer to --help.
Error usage_error(const CLI::App& app, const CLI::ParseError& error) {
  const auto given = app.get_subcommands();
  const CLI::App& command = given.empty() ? app : *given.front();
  const std::string name = app.get_name() + (given.empty() ? "" : " " + command.get_name());
  std::string what = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) ||
      (!given.empty() && has_unexpected_option(app)))
    what = unexpected_words(app, command);
  else if (given.empty() && dynamic_cast<const CLI::RequiredError*>(&error))
    what = "a command is missing";
  return Error(fmt::format("{}; see {} --help", what, name), ExitCode::usage);
}

// What a text is; options of one name have the same in all commands.
std::string text_of(const std::string& option) {
  struct Text {
    std::string_view name;
    std::vector<std::string_view> options;
  };
  static const std::vector<Text> texts{
      {"COLUMN", {"--by", "--person"}},
      {"FILE",
       {"--board", "--camera-file", "--chart", "--db", "--display-file", "--effector", "--figures",
        "--key", "--plan", "--save", "--trajectory"}},
      {"FOLDER", {"--backup", "--record-camera", "--search"}},
      {"HEAD", {"--witness"}},
      {"I/N", {"--shard"}},
      {"ID", {"--participant"}},
      {"KEY=VALUE", {"--set"}},
      {"LOW..HIGH", {"--range", "--stiffness"}},
      {"NAME", {"--operator", "--simulator"}},
      {"NAME=LOW..HIGH", {"--free"}},
      {"NAME[:FILE]", {"--model", "--responder", "--tracker", "--view"}},
      {"PATH", {"--out"}},
      {"RATE", {"--guess", "--lapse"}},
      {"SIZES", {"--participants"}},
      {"SOURCE", {"--camera"}},
      {"TARGET", {"--events"}},
  };
  for (const Text& text : texts)
    if (std::ranges::find(text.options, option) != text.options.end())
      return std::string(text.name);
  return "TEXT";
}

std::string value_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0 || !option.nonpositional()) return "";
  const std::string type = option.get_type_name();
  if (type.starts_with("INT") || type.starts_with("UINT")) return "N";
  if (type.starts_with("FLOAT")) return "NUMBER";
  return type == "TEXT" ? text_of(option.get_name()) : type;
}

OptionDescription described(const CLI::Option& option) {
  OptionDescription description;
  description.by_place = !option.nonpositional();
  description.names = option.get_name(false, true);
  description.value = value_of(option);
  description.group = description.by_place ? "Arguments" : option.get_group();
  description.is_general = description.names == "-h,--help" || description.names == "--help-all" ||
                           description.names == "--version";
  description.required = option.get_required();
  description.repeats = option.get_items_expected_max() > 1;
  description.help = option.get_description();
  if (description.required && !description.by_place) description.help += " (required)";
  if (!option.get_default_str().empty())
    description.help += fmt::format(" (default: {})", option.get_default_str());
  return description;
}

constexpr auto minor_group = "minor";

// @param before the command names before this one, with a blank after each
CommandDescription described(const CLI::App& app, const std::string& before) {
  CommandDescription description{
      before + app.get_name(), app.get_description(), app.get_footer(), {}, {}};
  for (const CLI::Option* option : app.get_options())
    description.options.push_back(described(*option));
  // Required options first, options of all commands last.
  std::ranges::stable_sort(description.options, {}, [](const OptionDescription& option) {
    return option.by_place ? 0 : option.is_general ? 2 : 1;
  });
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    description.commands.push_back(described(*command, description.name + " "));
  description.is_minor = app.get_group() == minor_group;
  return description;
}

// Describes the innermost given command.
CommandDescription described_as_given(const CLI::App& app, const std::string& before = "") {
  const auto given = app.get_subcommands();
  if (given.empty()) return described(app, before);
  return described_as_given(*given.front(), before + app.get_name() + " ");
}

// Width of the terminal, within limits for legible lines.
std::size_t help_width() {
  constexpr int narrowest = 60, usual = 80, widest = 120;
  const int width = std::clamp(terminal_width(STDOUT_FILENO).value_or(usual), narrowest, widest);
  return static_cast<std::size_t>(width);
}

void add_completion(Command& program, const CLI::App& app) {
  Command command =
      program.add_command("completion", "print completion for a shell, or the manual page",
                          {"source <(heft completion bash)", "source <(heft completion zsh)",
                           "heft completion fish | source", "heft completion man > heft.1"});
  command.is_minor();
  const std::map<std::string, std::string (*)(const CommandDescription&)> makers{
      {"bash", bash_completion},
      {"zsh", zsh_completion},
      {"fish", fish_completion},
      {"man", manual_page}};
  const auto what = std::make_shared<std::string>();
  command.add_option("WHAT", what.get(), "bash, zsh or fish, or man for the manual page")
      .required()
      .one_of({"bash", "zsh", "fish", "man"});
  command.does([what, makers, &app] { fmt::print("{}", makers.at(*what)(described(app, ""))); });
}

}  // namespace

Option& Option::required() {
  option_.required();
  return *this;
}

Option& Option::shows_default() {
  option_.capture_default_str();
  return *this;
}

Option& Option::whole_number(std::uint64_t least, std::uint64_t most) {
  const auto refusal = [least, most](const std::string& text) {
    if (is_whole_number(text, least, most)) return std::string();
    return fmt::format("expected a whole number {}...{} in decimal digits, got \"{}\"", least, most,
                       text);
  };
  option_.check(CLI::Validator([refusal](std::string& text) { return refusal(text); }, ""));
  return *this;
}

Option& Option::between(double least, double most) {
  const auto refusal = [least, most](const std::string& text) {
    if (const auto number = number_in(text); number && *number >= least && *number <= most)
      return std::string();
    return fmt::format("expected a number {}...{}, got \"{}\"", least, most, text);
  };
  option_.check(CLI::Validator([refusal](std::string& text) { return refusal(text); }, ""));
  return *this;
}

Option& Option::one_of(const std::vector<std::string>& names) {
  option_.check(CLI::IsMember(names).description(""));
  option_.type_name(fmt::format("{}", fmt::join(names, "|")));
  return *this;
}

Command Command::add_command(const std::string& name, const std::string& summary,
                             const std::vector<std::string>& examples) {
  CLI::App& command = *app_.add_subcommand(name, summary);
  std::string footer = examples.empty() ? "" : "Examples:";
  for (const std::string& example : examples)
    footer += example.empty() ? "\n" : fmt::format("\n  {}", example);
  command.footer(footer);
  return Command(command);
}

Option Command::add_option(const std::string& name, Destination destination,
                           const std::string& help) {
  const auto add = [&](auto& value) -> CLI::Option* {
    if constexpr (std::same_as<std::decay_t<decltype(value)>, ReadsText>) {
      using Texts = std::vector<std::string>;
      if (!value.several) return app_.add_option_function<std::string>(name, value.read, help);
      const auto read_all = [read = value.read](const Texts& texts) {
        for (const std::string& text : texts) read(text);
      };
      return app_.add_option_function<Texts>(name, read_all, help);
    } else {
      return app_.add_option(name, *value, help);
    }
  };
  CLI::Option& option = *std::visit(add, destination)->group(group_);
  option.check(CLI::Validator([](std::string& text) { return refused_if_blank(text); }, ""));
  return Option(option);
}

void Command::add_flag(const std::string& name, bool& flag, const std::string& help) {
  app_.add_flag(name, flag, help)->group(group_);
}

void Command::add_log(std::string& db, const std::string& help) {
  db = usual_log;
  add_option("--db", &db, help).shows_default();
}

void Command::add_session(std::optional<std::int64_t>& session, const std::string& without_it) {
  add_option("--session", &session, "of the log (default: " + without_it + ")")
      .whole_number(1, most_sessions);
}

void Command::add_sessions(std::vector<std::int64_t>& sessions, const std::string& help) {
  add_option("--session", &sessions, help).whole_number(1, most_sessions);
}

void Command::add_seed(std::optional<std::uint64_t>& seed, const std::string& without_it) {
  add_option("--seed", &seed, fmt::format("0...2^63-1 (default: {})", without_it))
      .whole_number(0, (std::uint64_t{1} << 63) - 1);
}

void Command::add_jobs(int& jobs, const std::string& what) {
  jobs = n_processors();
  add_option("--jobs", &jobs,
             fmt::format("threads; {} not depend on them (default: one per core)", what))
      .whole_number(1, 1024);
}

void Command::is_minor() {
  app_.group(minor_group);
}

void Command::add_to_help(const std::string& text) {
  app_.footer(app_.get_footer() + text);
}

void Command::needs_command() {
  app_.require_subcommand(1);
}

void Command::does(std::function<void()> action) {
  app_.callback(std::move(action));
}

void run_command_line(const ProgramDescription& program, int argc, char** argv) {
  CLI::App app{program.purpose};
  app.name(program.name);
  app.set_help_flag("-h,--help", "print this help");
  app.set_help_all_flag("--help-all", "print the help on every option");
  app.set_version_flag("--version", program.name + " " + HEFT_VERSION, "print the version");
  app.require_subcommand(1);
  app.footer(program.footer);
  Command all(app);
  program.add_commands(all);
  add_completion(all, app);
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (!words.empty() && words.front() == "help") {  // "help COMMAND" is "COMMAND --help"
    std::rotate(words.begin(), words.begin() + 1, words.end());
    words.back() = "--help";
  }
  refuse_unknown_command(app, app.get_name(), words);
  std::ranges::reverse(words);  // as CLI11 expects
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw usage_error(app, error);
    if (dynamic_cast<const CLI::CallForVersion*>(&error))
      fmt::print("{} {}\n", program.name, HEFT_VERSION);
    else if (dynamic_cast<const CLI::CallForAllHelp*>(&error))
      fmt::print("{}", help_of(described_as_given(app), help_width()));
    else
      fmt::print("{}", first_help_of(described_as_given(app), help_width()));
  }
}

}  // namespace heft::cli
