// What the program says to people: stderr. A terminal that has gone, a reader that went away or a
// full disk behind it must not end a session, so nothing here fails.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "base/Printable.h"

namespace heft::cli {

/// As it stands, with what moves a terminal's cursor.
inline void draw(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

/// Whatever names, notes and cells are in it, a terminal only shows them.
template <typename... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  draw(escaped(fmt::format(format, std::forward<Args>(args)...)));
}

}  // namespace heft::cli
