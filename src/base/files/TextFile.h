// Whole text files, read and replaced, their comma-separated cells and digests.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace heft {

/// @throws Error naming the file and the system's reason; for a pipe, a device or a socket too,
///   which could keep a reader waiting forever
std::string read_text_file(const std::string& path);

/// Puts a whole file in place at once: at any time there is the old one or the new one. The old one
/// is kept beside it as PATH.before, or PATH.before2, .before3... where there are such already.
/// @return the kept file's path; empty where there was no old one
/// @throws Error as require_writable, or when the disk is full; the old file is then untouched
std::string replace_text_file(const std::string& path, const std::string& text);

/// To be asked before the work that ends in such a file.
/// @throws Error when no file can be made there, saying why
void require_writable(const std::string& path);

/// Makes an empty file for whoever opens it next by its name.
/// @param mode as in open(2); 0600: for nobody's eyes but its owner's
/// @return false: there is something of that name already, perhaps a link that leads nowhere
/// @throws Error when it can't be made
bool create_file(const std::string& path, unsigned mode);

/// A text without the UTF-8 byte-order mark that some programs begin it with.
std::string_view without_byte_order_mark(std::string_view text);

/// Lines without their line ends (LF or CRLF) and without a UTF-8 byte-order mark; no empty last
/// line.
std::vector<std::string_view> lines_of(std::string_view text);

/// Cells of a line without quotes, spaces around them removed.
std::vector<std::string_view> cells_of(std::string_view line);

/// A whole cell as a finite number, whatever the locale.
std::optional<double> number_in(std::string_view cell);

/// SHA-256 (libmd) as 64 lowercase hexadecimal digits.
std::string sha256(std::string_view text);

}  // namespace heft
