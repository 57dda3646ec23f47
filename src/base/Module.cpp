#include "base/Module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "base/Error.h"

namespace heft {

const void* from_module(const char* module, const char* name, std::string_view what) {
  if (void* loaded = dlopen(module, RTLD_NOW | RTLD_LOCAL))
    if (const void* found = dlsym(loaded, name)) return found;
  throw Error(
      fmt::format("the part of heft that {} can't be loaded ({}); install or build heft "
                  "anew, so that {} fits the program",
                  what, dlerror(), module));
}

}  // namespace heft
