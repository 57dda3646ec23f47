// Parts of the program that are loaded by whoever asks first: libraries that bring many others
// along would otherwise be paid for at each start of a program that mostly does without them.
#pragma once

#include <string_view>

namespace heft {

/// What a module has under a name. It is looked for beside the programs, or where they were
/// installed to or built (CMakeLists.txt's RPATHs), and stays loaded, for other threads may be
/// inside.
/// @param what the module does, for people: "reads and writes pictures"
/// @throws Error naming the module and what is wrong with it, if it can't be loaded
const void* from_module(const char* module, const char* name, std::string_view what);

}  // namespace heft
