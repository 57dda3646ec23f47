// Whole text files, read and replaced, and their comma-separated cells.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace heft {

/// @throws Error naming the file and the system's reason
std::string read_text_file(const std::string& path);

/// Puts a whole file in place at once: at any time there is the old one or the new one. The old one
/// is kept beside it as PATH.before, or PATH.before2, .before3... where there are such already.
/// @return the kept file's path; empty where there was no old one
/// @throws Error as require_writable, or when the disk is full; the old file is then untouched
std::string replace_text_file(const std::string& path, const std::string& text);

/// To be asked before the work that ends in such a file.
/// @throws Error when no file can be made there, saying why
void require_writable(const std::string& path);

/// Lines without their line ends (LF or CRLF) and without a UTF-8 byte-order mark; no empty last
/// line.
std::vector<std::string_view> lines_of(std::string_view text);

/// Cells of a line without quotes, spaces around them removed.
std::vector<std::string_view> cells_of(std::string_view line);

/// A whole cell as a finite number, whatever the locale.
std::optional<double> number_in(std::string_view cell);

}  // namespace heft
