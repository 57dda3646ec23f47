// The running program: its build, its installed files and its loadable modules.
#pragma once

#include <string>
#include <string_view>

namespace heft {

/// Compiler, machine and the linker's build id: equal names, equal bits.
std::string build_name();

/// Path of a file that comes with the program, such as "protocols/paper.toml": of the checkout that
/// the program was built in, of ../share/heft beside an installed one, of share/heft below a folder
/// of XDG_DATA_DIRS for a copied one.
/// @throws Error naming the places where it was looked for
std::string installed_file(const std::string& name);

/// The same, or empty.
std::string installed_file_or_none(const std::string& name);

/// The program heft-bench: beside this one, in ../libexec/heft, or on PATH. Empty where there is
/// none.
std::string bench_program();

/// What a module has under a name. It is looked for beside the programs, or where they were
/// installed to or built (CMakeLists.txt's RPATHs), and stays loaded, for other threads may be
/// inside.
/// @param what the module does, for people: "reads and writes pictures"
/// @throws Error naming the module and what is wrong with it, if it can't be loaded
const void* from_module(const char* module, const char* name, std::string_view what);

}  // namespace heft
