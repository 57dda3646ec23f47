#include "cli/Help.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace heft::cli {

std::string wrapped(const std::string& text, std::size_t column, std::size_t width,
                    std::size_t used) {
  if (text.empty()) return "\n";
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      const bool starts = used <= column;
      if (!starts && used + 1 + word.size() > width) result += '\n', used = 0;
      const std::size_t gap = used <= column ? column - used : 1;
      result += std::string(gap, ' ') + word;
      used += gap + word.size();
    }
    result += '\n';
    used = 0;
  }
  return result;
}

namespace {
constexpr std::size_t help_column = 28, command_column = 14;
constexpr std::ptrdiff_t screen_lines = 24;

bool parts_option_and_value(std::string_view before, std::string_view after) {
  return before.substr(before.rfind(' ') + 1).starts_with("--") && !after.starts_with('-');
}

// An example as lines that a shell joins: broken between words, but neither within quotes nor
// between an option and its value.
std::string continued(std::string_view example, std::size_t width) {
  std::string result;
  std::size_t line = 0, blank = 0;  // start of the line in the result, and the last place to break
  bool quoted = false;
  for (std::size_t i = 0; i < example.size(); ++i) {
    const char c = example[i];
    if (c == '\'' || c == '"') quoted = !quoted;
    const bool is_blank = c == ' ' && !quoted && result.size() > line + 6;
    if (is_blank && !parts_option_and_value(result, example.substr(i + 1))) blank = result.size();
    result += c;
    if (result.size() - line + 2 <= width || blank <= line) continue;
    result.replace(blank, 1, " \\\n      ");
    line = blank + 3;
    blank = 0;
  }
  return result;
}

bool is_prose(const std::string& line) {
  return line.starts_with("  ") && !line.starts_with("   ") && !line.starts_with("  heft ");
}

// The text below the options, with commands and sentences wrapped to the terminal's width. A
// sentence may be on several lines.
std::string with_examples(const std::string& footer, std::size_t width) {
  std::istringstream lines(footer);
  std::string result, prose;
  const auto end_prose = [&] {
    if (!prose.empty()) result += wrapped(prose, 2, width, 0);
    prose.clear();
  };
  for (std::string line; std::getline(lines, line);) {
    if (is_prose(line)) {
      prose += prose.empty() ? line : line.substr(1);
      if (line.ends_with('.') || line.ends_with(':') || line.ends_with('"')) end_prose();
      continue;
    }
    end_prose();
    result += (line.starts_with("  heft ") ? continued(line, width) : line) + '\n';
  }
  end_prose();
  return result;
}

std::string left_of(const OptionDescription& option) {
  std::string left = "  " + option.names;
  if (!option.value.empty()) left += " " + option.value;
  return left + (option.repeats ? " ..." : "");
}

std::string line_of(const std::string& left, const std::string& help, std::size_t width,
                    std::size_t column = help_column) {
  const bool too_long = left.size() + 2 > column;
  return left + (too_long ? "\n" : "") + wrapped(help, column, width, too_long ? 0 : left.size());
}

// Each group once, in the order of its first option.
std::vector<std::string> groups_of(const CommandDescription& command) {
  std::vector<std::string> groups;
  for (const OptionDescription& option : command.options)
    if (std::ranges::find(groups, option.group) == groups.end()) groups.push_back(option.group);
  return groups;
}

std::string usage_of(const CommandDescription& command) {
  std::string usage = command.name + " [OPTIONS]";
  for (const OptionDescription& option : command.options)
    if (option.by_place) {
      const std::string given = option.names + (option.repeats ? "..." : "");
      usage += option.required ? fmt::format(" {}", given) : fmt::format(" [{}]", given);
    }
  if (!command.commands.empty()) usage += " COMMAND";
  return usage;
}

std::string last_word(const std::string& name) {
  return name.substr(name.rfind(' ') + 1);
}

std::string long_name(const OptionDescription& option) {
  return option.names.substr(option.names.rfind(',') + 1);
}

// Names separated by blanks.
std::string options_in_a_row(const CommandDescription& command) {
  std::vector<std::string> names;
  for (const OptionDescription& option : command.options)
    if (!option.by_place) names.push_back(long_name(option));
  return fmt::format("{}", fmt::join(names, " "));
}

std::string commands_in_a_row(const CommandDescription& command) {
  std::vector<std::string> names;
  for (const CommandDescription& inner : command.commands) names.push_back(last_word(inner.name));
  return fmt::format("{}", fmt::join(names, " "));
}

// One line each; the minor ones in a row.
std::string commands_of(const CommandDescription& command, std::size_t width) {
  std::string text, minor;
  for (const CommandDescription& inner : command.commands)
    if (inner.is_minor)
      minor += fmt::format(" {}", last_word(inner.name));
    else
      text += line_of("  " + last_word(inner.name), inner.summary, width, command_column);
  if (!minor.empty()) text += "  also:" + minor + "\n";
  return text;
}

// The first three commands of the examples, without explanations.
std::string first_examples(const CommandDescription& command, std::size_t width) {
  std::istringstream lines(command.footer);
  std::string result;
  int n_commands = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line != "Examples:" && !line.starts_with("  ")) break;
    n_commands += line.starts_with("  heft ");
    if (n_commands > 3) break;
    result += line + '\n';
  }
  return with_examples(result, width);
}

// Arguments and the first options, names of the others, and examples.
std::string short_help_of(const CommandDescription& command, std::size_t width) {
  const std::string summary = wrapped(command.summary, 0, width, 0);
  if (!command.commands.empty())
    return fmt::format("{}{}\n{}", summary, command.footer, commands_of(command, width));
  std::string options;
  std::vector<std::string> others;
  for (const OptionDescription& option : command.options) {
    if (option.is_general) continue;
    const std::string line = line_of(left_of(option), option.help, width);
    const bool has_room = std::ranges::count(options + line, '\n') <= 9;
    if (others.empty() && (option.by_place || option.group == "Options") && has_room)
      options += line;
    else
      others.push_back(long_name(option));
  }
  return fmt::format(
      "{}\nUsage: {}\n\n{}\nMore: {} --help-all\n{}\n{}", summary, usage_of(command), options,
      command.name,
      others.empty() ? "" : wrapped(fmt::format("{}", fmt::join(others, " ")), 2, width, 0),
      first_examples(command, width));
}

void add_cases(const CommandDescription& command, const std::string& path, std::string& text) {
  text += fmt::format("    \"{}\") commands=\"{}\" options=\"{}\" ;;\n", path,
                      commands_in_a_row(command), options_in_a_row(command));
  for (const CommandDescription& inner : command.commands)
    add_cases(inner, fmt::format("{}/{}", path, last_word(inner.name)), text);
}

// Escapes for roff: no line starts with a request, no hyphen becomes a dash.
std::string roff(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if ((c == '.' || c == '\'') && (safe.empty() || safe.back() == '\n')) safe += "\\&";
    if (c == '\\')
      safe += "\\e";
    else if (c == '-')
      safe += "\\-";
    else
      safe += c;
  }
  return safe;
}

void add_section(const CommandDescription& command, std::string& page) {
  page += fmt::format(".SS {}\n{}\n", roff(usage_of(command)), roff(command.summary));
  for (const OptionDescription& option : command.options)
    page += fmt::format(".TP\n.B {}\n{}\n", roff(left_of(option).substr(2)), roff(option.help));
  if (!command.footer.empty()) page += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(command.footer));
  for (const CommandDescription& inner : command.commands) add_section(inner, page);
}
}  // namespace

std::string help_of(const CommandDescription& command, std::size_t width) {
  std::string text =
      fmt::format("{}\nUsage: {}\n", wrapped(command.summary, 0, width, 0), usage_of(command));
  for (const std::string& group : groups_of(command)) {
    text += fmt::format("\n{}:\n", group);
    for (const OptionDescription& option : command.options)
      if (option.group == group) text += line_of(left_of(option), option.help, width);
  }
  if (!command.commands.empty()) text += "\nCommands:\n" + commands_of(command, width);
  if (!command.footer.empty()) text += '\n' + with_examples(command.footer, width);
  return text;
}

std::string first_help_of(const CommandDescription& command, std::size_t width) {
  const std::string all = help_of(command, width);
  return std::ranges::count(all, '\n') < screen_lines ? all : short_help_of(command, width);
}

std::string bash_completion(const CommandDescription& program) {
  std::string cases;
  add_cases(program, "", cases);
  std::string function = program.name;
  std::ranges::replace(function, '-', '_');
  return fmt::format(R"(# Completion for bash. In ~/.bashrc: source <({0} completion bash)
_{1}_completion() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} path= commands= options= i
  for ((i = 0; i < COMP_CWORD; i++)); do
    if ((i > 0)); then
      [[ " $commands " == *" ${{COMP_WORDS[i]}} "* ]] || break
      path+="/${{COMP_WORDS[i]}}"
    fi
    case "$path" in
{2}    esac
  done
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  else
    COMPREPLY=($(compgen -W "$commands" -- "$word"))
  fi
}}
complete -o default -F _{1}_completion {0}
)",
                     program.name, function, cases);
}

std::string zsh_completion(const CommandDescription& program) {
  std::string cases;
  add_cases(program, "", cases);
  std::string function = program.name;
  std::ranges::replace(function, '-', '_');
  return fmt::format(R"(#compdef {0}
# Completion for zsh. In ~/.zshrc, after compinit: source <({0} completion zsh)
_{1}_completion() {{
  local given= commands= options= i
  for ((i = 1; i < CURRENT; i++)); do
    if ((i > 1)); then
      [[ " $commands " == *" ${{words[i]}} "* ]] || break
      given+="/${{words[i]}}"
    fi
    case "$given" in
{2}    esac
  done
  if [[ ${{words[CURRENT]}} == -* ]]; then
    compadd -- ${{=options}}
  else
    [[ -z $commands ]] || compadd -- ${{=commands}}
    _files
  fi
}}
compdef _{1}_completion {0}
[[ ${{funcstack[1]}} != _{0} ]] || _{1}_completion "$@"  # installed as an autoloaded function
)",
                     program.name, function, cases);
}

namespace {
// In single quotes, within which fish only interprets \\ and \'.
std::string fish_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\\' || c == '\'') quoted += '\\';
    quoted += c == '\n' ? ' ' : c;
  }
  return quoted + "'";
}

// @param seen fish's condition for offering a command's own words
void add_fish_lines(const CommandDescription& command, const std::string& program,
                    const std::string& seen, std::string& lines) {
  const std::string begin = fmt::format("complete -c {} -n {}", program, fish_quoted(seen));
  for (const OptionDescription& option : command.options) {
    const auto dashes = option.names.rfind("--");
    if (option.by_place || dashes == std::string::npos) continue;
    lines += fmt::format("{} -l {}{} -d {}\n", begin, option.names.substr(dashes + 2),
                         option.value.empty() ? "" : " -r", fish_quoted(option.help));
  }
  for (const CommandDescription& inner : command.commands) {
    const std::string name = last_word(inner.name);
    lines += fmt::format("complete -c {} -n {} -f -a {} -d {}\n", program,
                         fish_quoted(fmt::format("{}; and not __fish_seen_subcommand_from {}", seen,
                                                 commands_in_a_row(command))),
                         name, fish_quoted(inner.summary));
    add_fish_lines(inner, program,
                   fmt::format("{}; and __fish_seen_subcommand_from {}", seen, name), lines);
  }
}
}  // namespace

std::string fish_completion(const CommandDescription& program) {
  std::string lines = fmt::format(
      "# Completion for fish: {0} completion fish > ~/.config/fish/completions/{0}.fish\n",
      program.name);
  add_fish_lines(program, program.name, "true", lines);
  return lines;
}

std::string manual_page(const CommandDescription& program) {
  std::string page = fmt::format(
      ".TH HEFT 1 \"\" \"heft {}\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n.B {}\n.SH DESCRIPTION\n{}\n"
      ".SH COMMANDS\n",
      HEFT_VERSION, program.name, roff(program.summary), roff(usage_of(program)),
      roff(program.footer));
  for (const CommandDescription& command : program.commands) add_section(command, page);
  return page;
}

}  // namespace heft::cli
