// The running program: its build, its installed files and its loadable modules.
#pragma once

#include <string>
#include <string_view>

namespace heft {

/// Compiler, word size and the linker's build id. Programs with equal names compute equal bits.
std::string build_name();

/// Path of an installed file such as "protocols/paper.toml". Searches the checkout that holds the
/// build folder, ../share/heft and share/heft beside the program, heft in the folders of
/// XDG_DATA_DIRS, and last the checkout that the program was built in.
/// @throws Error with the searched folders
std::string installed_file(const std::string& name);

/// The same, or an empty string when the file is missing.
std::string installed_file_or_none(const std::string& name);

/// Path of the program heft-bench, beside this program, in ../libexec/heft or on PATH; empty when
/// it is missing.
std::string bench_program();

/// What programs and modules must have in common: a module exports it as NAME_edition. Increase the
/// number when a module's interface changes.
inline constexpr const char* module_edition = HEFT_VERSION " 1";

/// Loads a module on first use and returns the address of one of its symbols. Libraries that bring
/// many others with them are linked to modules, so that the program starts fast without them. A
/// module is searched beside the program and in the folder where it is installed, nowhere else. It
/// stays loaded, because other threads may be using it.
/// @param purpose of the module, for the message: "reads and writes pictures"
/// @throws Error naming the module and the reason: it is missing, or of another edition
const void* from_module(const char* module, const char* name, std::string_view purpose);

}  // namespace heft
