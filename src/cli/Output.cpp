#include "cli/Output.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace heft::cli {

void flush_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw output_error(errno != 0 ? std::strerror(errno) : "an earlier write failed");
}

Error output_error(const std::string& reason) {
  return Error(fmt::format("can't write to the standard output: {}. What it holds is not complete.",
                           reason));
}

}  // namespace heft::cli
