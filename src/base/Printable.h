// Texts from elsewhere (file names, cells, ids, notes) as a terminal and a shell may have them.
#pragma once

#include <string>
#include <string_view>

namespace heft {

/// What a terminal would obey instead of showing it stands there as \x1b or \u202e: control
/// characters but line ends and tabs, bytes that are no UTF-8, and marks that turn the direction of
/// writing.
std::string escaped(std::string_view text);

/// As escaped(), on one line.
std::string escaped_line(std::string_view text);

/// As a message quotes a value: short, on one line, without control characters.
std::string printable(std::string text);

/// A word as a shell takes it, to be put into a command that people copy.
std::string shell_quoted(const std::string& word);

}  // namespace heft
