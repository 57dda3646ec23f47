// Whole text files: reading, replacing, lines, comma-separated cells and digests.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace heft {

/// @throws Error with the file and the system's reason; also for files above 256 MB, and for pipes,
///   devices and sockets, where reading could block forever
std::string read_text_file(const std::string& path);

/// Replaces a file atomically. A copy of the old file remains as PATH.before, or as PATH.before2,
/// .before3... when that name is taken.
/// @return the path of that copy; empty when there was no old file
/// @throws Error as require_writable, or when the disk is full; the old file is then unchanged
std::string replace_text_file(const std::string& path, const std::string& text);

/// Checks that a file can be written there, before long work whose result it will hold.
/// @throws Error with the reason
void require_writable(const std::string& path);

/// Creates an empty file with the permissions `mode`, such as 0600.
/// @return false when the name is taken, possibly by a dangling link
/// @throws Error when the file can't be created
bool create_file(const std::string& path, unsigned mode);

/// Removes a UTF-8 byte-order mark.
std::string_view without_byte_order_mark(std::string_view text);

/// Lines without line ends (LF or CRLF) and byte-order mark. A final line end adds no empty line.
std::vector<std::string_view> lines_of(std::string_view text);

/// Comma-separated cells of a line that has no quotes, without surrounding spaces.
std::vector<std::string_view> cells_of(std::string_view line);

/// The finite number that a cell holds; none when there is anything else in it. Independent of the
/// locale.
std::optional<double> number_in(std::string_view cell);

/// SHA-256 (libmd) as 64 lowercase hexadecimal digits.
std::string sha256(std::string_view text);

}  // namespace heft
