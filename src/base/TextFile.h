// Whole text files and their comma-separated cells.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace heft {

/// @throws Error naming the file and the system's reason
std::string read_text_file(const std::string& path);

/// Lines without their line ends (LF or CRLF) and without a UTF-8 byte-order mark; no empty last
/// line.
std::vector<std::string_view> lines_of(std::string_view text);

/// Cells of a line without quotes, spaces around them removed.
std::vector<std::string_view> cells_of(std::string_view line);

/// A whole cell as a finite number, whatever the locale.
std::optional<double> number_in(std::string_view cell);

}  // namespace heft
