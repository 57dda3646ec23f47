// The commands of heft, one file each, and the common part of heft and heft-bench. A command writes
// data to stdout and messages to stderr, and throws Error to end with a message and an exit code.
#pragma once

#include "cli/CommandLine.h"

namespace heft::cli {

void add_analyse(Command& app);
void add_calibrate(Command& app);
void add_calibrate_display(Command& calibrate);
void add_demo(Command& app);
void add_doctor(Command& app);
void add_export(Command& app);
void add_fit(Command& app);
void add_list(Command& app);
void add_merge(Command& app);
void add_new(Command& app);
void add_procedure(Command& app);
void add_replay(Command& app);
void add_resume(Command& app);
void add_run(Command& app);
void add_scene(Command& app);
void add_sheet(Command& app);
void add_show(Command& app);
void add_simulate(Command& app);
void add_power(Command& app);
void add_tune(Command& app);
void add_fit_responder(Command& app);
void add_track(Command& app);
void add_validate(Command& app);
void add_withdraw(Command& app);

/// All commands above.
void add_commands(Command& app);

/// @return the exit code. heft starts heft-bench with the same arguments for `bench`, and for a
///   simulator that only heft-bench has.
int run_program(const ProgramDescription& program, int argc, char** argv);

}  // namespace heft::cli
