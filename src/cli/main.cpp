// The program: subcommands, --version, and errors as messages with exit codes.
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>
#include <sstream>
#include <system_error>

#include "base/Error.h"
#include "base/Names.h"
#include "cli/Commands.h"
#include "cli/Output.h"
#include "cli/Talk.h"
#include "cli/WholeNumber.h"

namespace heft::cli {

CLI::App* add_command(CLI::App& app, const char* name, const char* summary,
                      std::initializer_list<const char*> examples) {
  CLI::App* command = app.add_subcommand(name, summary);
  std::string footer = "Examples:";
  for (const char* example : examples) footer += fmt::format("\n  {}", example);
  command->footer(footer);
  return command;
}

void add_seed(CLI::App* command, std::optional<std::uint64_t>& seed,
              const std::string& without_it) {
  command->add_option("--seed", seed, "0...2^63-1; without it " + without_it)
      ->check(whole_number(0, (std::uint64_t{1} << 63) - 1));
}

namespace {

void add_commands(CLI::App& app) {
  add_demo(app);
  add_run(app);
  add_resume(app);
  add_simulate(app);
  add_replay(app);
  add_analyse(app);
  add_validate(app);
  add_procedure(app);
  add_scene(app);
  add_sheet(app);
  add_calibrate(app);
  add_track(app);
  add_bench(app);
  add_doctor(app);
}

std::string nearest_hint(const std::string& wanted, const std::vector<std::string>& names) {
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  const auto nearest = nearest_name(wanted, candidates);
  return nearest ? fmt::format(" (did you mean {}?)", *nearest) : "";
}

// CLI11 would only say that a subcommand is required.
void refuse_unknown_command(const CLI::App& app, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  if (word.starts_with('-') || std::ranges::find(names, word) != names.end()) return;
  throw Error(fmt::format("there is no command \"{}\"{}; heft --help lists all", word,
                          nearest_hint(word, names)),
              ExitCode::usage);
}

// CLI11 lists what it could not use backwards.
std::string unexpected_words(const CLI::App& app, const CLI::App& command) {
  const std::vector<std::string> words = app.remaining(true);
  std::vector<std::string> options;
  for (const CLI::Option* option : command.get_options()) options.push_back(option->get_name());
  const auto option =
      std::ranges::find_if(words, [](const std::string& word) { return word.starts_with("--"); });
  return fmt::format("unexpected: {}{}", fmt::join(words, " "),
                     option == words.end() ? "" : nearest_hint(*option, options));
}

// A usage mistake as CLI11 found it, with where to read on.
Error usage_error(const CLI::App& app, const CLI::ParseError& error) {
  const auto given = app.get_subcommands();
  const CLI::App& command = given.empty() ? app : *given.front();
  const std::string name = given.empty() ? "heft" : "heft " + command.get_name();
  std::string what = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error))
    what = unexpected_words(app, command);
  else if (given.empty() && dynamic_cast<const CLI::RequiredError*>(&error))
    what = "a command is missing";
  return Error(fmt::format("{}; see {} --help", what, name), ExitCode::usage);
}

void run_command(int argc, char** argv) {
  CLI::App app{"Heft runs psychophysics experiments on perceived mass in augmented reality."};
  app.name("heft");
  app.set_help_flag("-h,--help", "print this help");
  app.set_version_flag("--version", std::string("heft ") + HEFT_VERSION, "print the version");
  app.require_subcommand(1);
  app.footer("Start with: heft demo. Each command explains itself: heft COMMAND --help");
  add_commands(app);
  if (argc > 1) refuse_unknown_command(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw usage_error(app, error);
    std::ostringstream text;  // --help and --version
    app.exit(error, text);
    fmt::print("{}", text.str());
  }
}

// What a library threw, as an error for people.
Error explained(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error)) return Error("out of memory");
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return Error(fmt::format("can't use {}: {}", file->path1().string(), file->code().message()));
  if (const auto* system = dynamic_cast<const std::system_error*>(&error))
    return std::ferror(stdout) != 0 ? output_error(system->code().message())
                                    : Error(system->what());
  return Error(fmt::format("unexpected: {}", error.what()));
}

int fail(const Error& error) {
  say("heft: {}\n", error.what());
  return static_cast<int>(error.exit_code());
}

// A reader that goes away (SIGPIPE) and a file that may not grow (SIGXFSZ) are errors of a write,
// told where the write is. Programs started from here get back what is usual, which they would not
// if the signals were ignored.
void survive_failed_writes() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, [](int) {});
}

int run_program(int argc, char** argv) {
  survive_failed_writes();
  try {
    run_command(argc, argv);
    flush_output();
    return static_cast<int>(ExitCode::ok);
  } catch (const InvalidFile& error) {
    say("{}\n", error.what());  // each line starts with file:line:column
    return static_cast<int>(error.exit_code());
  } catch (const Error& error) {
    return fail(error);
  } catch (const std::exception& error) {
    return fail(explained(error));
  }
}

}  // namespace
}  // namespace heft::cli

int main(int argc, char** argv) {
  return heft::cli::run_program(argc, argv);
}
