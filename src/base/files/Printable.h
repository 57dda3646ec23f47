// Texts from elsewhere (file names, cells, ids, notes) as a terminal and a shell may have them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace heft {

/// A character, and how many bytes of UTF-8 it takes; 0: there is none.
struct Letter {
  char32_t code = 0;
  std::size_t n_bytes = 0;
};

/// The one that a text begins with, which must not be empty.
Letter first_letter(std::string_view text);

/// The bytes of each; of what is no UTF-8 each byte stands for itself.
std::vector<std::string_view> letters_of(std::string_view text);

bool is_control(char32_t code);

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
