// Where this program's own files are.
#pragma once

#include <string>

namespace heft {

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

}  // namespace heft
