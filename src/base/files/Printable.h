// Safe display of untrusted texts (file names, cells, ids, notes) in terminals, messages and
// shells.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace heft {

/// A Unicode character and its number of UTF-8 bytes; 0 bytes for invalid UTF-8.
struct Letter {
  char32_t code = 0;
  std::size_t n_bytes = 0;
};

/// The first character of a text that is not empty.
Letter first_letter(std::string_view text);

/// The bytes of each character; invalid UTF-8 is split into single bytes.
std::vector<std::string_view> letters_of(std::string_view text);

bool is_control(char32_t code);

/// Escapes as \x1b or \u202e what a terminal would interpret: control characters except line ends
/// and tabs, invalid UTF-8, line separators and marks that change the direction of writing.
std::string escaped(std::string_view text);

/// As escaped(), also escaping line ends and tabs.
std::string escaped_line(std::string_view text);

/// A value for quoting in a message: at most 200 bytes, on one line, without control characters.
std::string printable(std::string text);

/// Quotes a word for a shell command.
std::string shell_quoted(const std::string& word);

}  // namespace heft
