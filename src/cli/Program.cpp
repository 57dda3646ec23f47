#include "base/Program.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <new>
#include <system_error>

#include "base/Error.h"
#include "cli/Commands.h"
#include "cli/console/Terminal.h"
#include "physics/DecouplingSimulator.h"

namespace heft::cli {

namespace {

// A library's exception as an error for users.
Error explained(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error)) return Error("out of memory");
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return Error(fmt::format("cannot use {}: {}", file->path1().string(), file->code().message()));
  if (const auto* system = dynamic_cast<const std::system_error*>(&error))
    return std::ferror(stdout) != 0 ? output_error(system->code().message())
                                    : Error(system->what());
  return Error(fmt::format("an error of heft itself, please report it: {}", error.what()));
}

int fail(const Error& error) {
  say("heft: {}\n", error.what());
  return static_cast<int>(error.exit_code());
}

// A closed pipe (SIGPIPE) and a file size limit (SIGXFSZ) become errors of the write, reported
// there. Programs started from here get the default handlers back, which they would not if the
// signals were ignored.
void survive_failed_writes() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, [](int) {});
}

int exit_code_of(const std::function<void()>& work) {
  survive_failed_writes();
  try {
    work();
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

// Printed only at a terminal; a script without a command gets an error.
void print_start_page() {
  const std::string quick =
      std::filesystem::proximate(installed_file("protocols/quick.toml")).string();
  print(
      "Heft runs experiments on perceived mass in augmented reality. What next?\n"
      "  see what it does          heft demo\n"
      "  be the participant        heft run {} --participant me --tracker mouse\n"
      "  write an experiment       heft new experiment NAME\n"
      "  check this machine        heft doctor\n"
      "  run a participant         heft run PROTOCOL.toml --participant 07\n"
      "  plan a study, follow it   heft validate STUDY.toml; heft run --plan STUDY.toml\n"
      "  look at the results       heft list; heft analyse\n"
      "  share the data            heft export --help\n"
      "All commands: heft --help. One of them, with examples: heft help COMMAND\n",
      shell_quoted(quick));
}

constexpr const char* how_to_get_bench =
    "In a checkout ./heft bench builds it; otherwise install heft-bench";

// Replaces this program by heft-bench, with the arguments from `first` on.
[[noreturn]] void become_bench(char** first, char** last) {
  const std::string program = bench_program();
  if (program.empty())
    throw Error(
        fmt::format("heft-bench, the program with the studies, is missing. {}", how_to_get_bench));
  std::vector<char*> arguments{const_cast<char*>(program.c_str())};
  arguments.insert(arguments.end(), first, last);
  arguments.push_back(nullptr);
  flush_output();
  execv(program.c_str(), arguments.data());
  throw Error(fmt::format("cannot start {}: {}", program, std::strerror(errno)));
}

void hand_over_to_bench(const OnlyForStudies& wanted, int argc, char** argv) {
  if (bench_program().empty())
    throw Error(fmt::format("{}. {}", wanted.what(), how_to_get_bench), wanted.exit_code());
  become_bench(argv + 1, argv + argc);
}

}  // namespace

void add_commands(Command& app) {
  add_demo(app);
  add_run(app);
  add_resume(app);
  add_list(app);
  add_show(app);
  add_simulate(app);
  add_merge(app);
  add_power(app);
  add_tune(app);
  add_fit_responder(app);
  add_replay(app);
  add_analyse(app);
  add_fit(app);
  add_validate(app);
  add_withdraw(app);
  add_new(app);
  add_procedure(app);
  add_scene(app);
  add_sheet(app);
  add_calibrate(app);
  add_track(app);
  add_doctor(app);
  add_export(app);
}

int run_program(const ProgramDescription& program, int argc, char** argv) {
  // Reports, exports, pictures and videos are personal data: readable by their owner only.
  umask(S_IRWXG | S_IRWXO);
  return exit_code_of([&] {
    if (program.name == "heft" && argc == 1 && isatty(STDOUT_FILENO) == 1)
      return print_start_page();
    if (program.name == "heft" && argc > 1 && std::strcmp(argv[1], "bench") == 0)
      become_bench(argv + 2, argv + argc);
    try {
      run_command_line(program, argc, argv);
    } catch (const OnlyForStudies& wanted) {
      hand_over_to_bench(wanted, argc, argv);
    }
  });
}

}  // namespace heft::cli
