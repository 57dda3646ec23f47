// Where this program's own files are.
#pragma once

#include <string>

namespace heft::cli {

/// Path of a file of the checkout, such as "protocols/paper.toml".
/// @throws Error when it is not there
std::string installed_file(const std::string& name);

}  // namespace heft::cli
