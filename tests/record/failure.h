// What a piece of work fails with.
#pragma once

#include <string>
#include <utility>

#include "base/Error.h"

namespace heft::test {

/// @return the error's words; empty if there was none
template <typename Work>
std::string failure(Work&& work) {
  try {
    std::forward<Work>(work)();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace heft::test
