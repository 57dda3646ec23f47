#include "tracking/codecs/Codecs.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "base/Error.h"

namespace heft {

namespace {
const Codecs& loaded() {
  // Beside the programs, or where they were installed to or built: see CMakeLists.txt's RPATHs. It
  // stays loaded, for other threads may be inside.
  constexpr const char* name = "heft-codecs.so";
  if (void* module = dlopen(name, RTLD_NOW | RTLD_LOCAL))
    if (const void* codecs = dlsym(module, "heft_codecs"))
      return *static_cast<const Codecs*>(codecs);
  throw Error(
      fmt::format("the part of heft that reads and writes pictures can't be loaded ({}); "
                  "install or build heft anew, so that {} fits the program",
                  dlerror(), name));
}
}  // namespace

const Codecs& codecs() {
  static const Codecs& module = loaded();
  return module;
}

}  // namespace heft
